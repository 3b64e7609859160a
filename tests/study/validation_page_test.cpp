#include "study/validation_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/system/scratch_folder.h"

namespace careen {
namespace {

Toss toss(const std::string& name, double place, const std::string& simulated) {
  Toss toss;
  toss.name = name;
  toss.times = {0, 0.1, 0.2};
  toss.place = {0, place, 2 * place};
  toss.attitude = {0, 0.1, 0.2};
  toss.meanPlace = place;
  toss.largestPlace = 2 * place;
  toss.meanAttitude = 0.1;
  toss.measuredFace = "+x";
  toss.simulatedFace = simulated;
  return toss;
}

Validation found() {
  return {
      .program = "careen 1.2.3",
      .scene = "cube",
      .size = 0.1,
      .tosses = {toss("a<b.csv", 0.01, "+x"), toss("c.csv", 0.02, "-z")},
      .swept = Parameter::kFriction,
      .sweep = {{.value = 0.1, .place = 0.03}, {.value = 0.2, .place = 0.01}, {.value = 0.3, .place = 0.02}},
      .sceneValue = 0.15};
}

TEST(ValidationPage, theSummaryHasTheMeansAndTheMinimum) {
  const std::vector<std::string> lines = summaryOf(found());
  EXPECT_EQ(lines[0], "place        mean 15 ± 7.07 % of the size, 0.1 m; largest 30 ± 14.1 %");
  EXPECT_EQ(lines[4], "faces        1 of 2 right");
  EXPECT_EQ(
      lines[5],
      "sweep        the least error of place, 10 %, is at friction 0.2; the parabola there has its minimum "
      "at 0.217; the scene's 0.15 has 20 %");
}

TEST(ValidationPage, jsonHasAllOfIt) {
  const nlohmann::json report = nlohmann::json::parse(validationJson(found()));
  EXPECT_EQ(report["faces_right"], 1);
  EXPECT_EQ(report["program"], "careen 1.2.3");
  EXPECT_EQ(report["tosses"][1]["simulated_face"], "-z");
  EXPECT_DOUBLE_EQ(report["place"]["mean"], 0.015);
  EXPECT_EQ(report["sweep"]["parameter"], "friction");
  EXPECT_EQ(report["sweep"]["points"].size(), 3U);
  EXPECT_EQ(report["sweep"]["scene"], 0.15);
}

TEST(ValidationPage, plotsAreDrawnAndNamesEscaped) {
  const ScratchFolder folder;
  const std::vector<std::string> plots = drawValidation(found(), folder / "plots");
  ASSERT_EQ(plots.size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(folder / "plots/errors.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "plots/sweep.svg"));
  const std::string page = validationPage(found(), plots);
  EXPECT_NE(page.find("a&lt;b.csv"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos);
}

}  // namespace
}  // namespace careen
