#include "page/run_page.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/plan.h"
#include "scene/scene.h"
#include "support/process.h"

namespace careen {
namespace {

using Json = nlohmann::json;

Trajectory bouncing(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.gravity = Vec3(0, 0, -10);
  scene.settings.duration = 2;
  scene.walls = {{.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = {}}};
  SceneBox& box = scene.boxes.emplace_back();
  box.name = "box";
  box.halfExtents = Vec3(0.5, 0.2, 0.1);
  box.mass = 2;
  box.pose.position = Vec3(0, 0, 1.1);
  box.material.restitution = 0.5;
  scene.timeMap.keys = {{0, 0}, {4, 2}};
  return record(setupOf(scene));
}

std::string pageOf(const Trajectory& run) {
  return runPage(run, audit(run, AuditDepth::kUsual), {.bytes = "film", .type = "video/mp4"}, "careen 1.2.3");
}

Json dataOf(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="data">)";
  const std::size_t at = page.find(begin) + begin.size();
  return Json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(RunPage, isMadeOfTheFilesThatAreBuiltIn) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAREEN_SOURCE_DIR "/assets/page")) {
    EXPECT_EQ(embeddedRunPage(entry.path().filename().string()), textOf(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 4);
  const std::string page = pageOf(bouncing("page"));
  for (const char* const part : {"base.css", "run.css", "run.js"}) {
    EXPECT_NE(page.find(embeddedRunPage(part)), std::string::npos) << part;
  }
  EXPECT_EQ(embeddedRunPage("none.js"), "");
}

// 2 kg fall by 1 m to 0.4472 s: 20 J, of which a quarter is left.
TEST(RunPage, tellsEnergiesAndImpacts) {
  const Trajectory run = bouncing("drop");
  const Json data = dataOf(pageOf(run));
  EXPECT_EQ(data["name"], "drop");
  EXPECT_EQ(data["boxes"], 1);
  EXPECT_EQ(data["clock"], Json::parse("[[0.0, 0.0], [4.0, 2.0]]"));
  EXPECT_EQ(data["impact_count"], run.impacts.size());
  ASSERT_EQ(data["impacts"].size(), run.impacts.size());
  EXPECT_NEAR(data["impacts"][0][0].get<double>(), std::sqrt(0.2), 1e-12);
  EXPECT_EQ(data["impacts"][0][1], "box");
  EXPECT_EQ(data["impacts"][0][2], "floor");
  const Json& energies = data["energies"];
  double before = 0;
  double after = 0;
  for (std::size_t k = 0; k < energies["time"].size(); ++k) {
    const double time = energies["time"][k];
    before = time < std::sqrt(0.2) ? energies["translation"][k].get<double>() : before;
    after = time <= std::sqrt(0.2) + 1e-9 ? energies["translation"][k].get<double>() : after;
  }
  EXPECT_NEAR(before, 20, 1e-6);
  EXPECT_NEAR(after, 5, 1e-6);
  EXPECT_EQ(data["audit"]["breaches"].size(), 0U);
}

TEST(RunPage, hasItsFilmInIt) {
  EXPECT_NE(pageOf(bouncing("drop")).find("src=\"data:video/mp4;base64,ZmlsbQ==\""), std::string::npos);
}

TEST(RunPage, namesCannotEndItsScript) {
  const std::string page = pageOf(bouncing("</script><b>&{{FILM}}"));
  EXPECT_EQ(dataOf(page)["name"].get<std::string>().substr(0, 12), "</script><b>");
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
}

TEST(RunPage, ofTooManyImpactsHasTheHardest) {
  Trajectory run = bouncing("drop");
  const Impact first = run.impacts[0];
  run.impacts.clear();
  for (int k = 0; k < 3000; ++k) {
    run.impacts.push_back(first);
    run.impacts.back().time = 0.1 + 1e-4 * k;
    run.impacts.back().impulse = 1 + k * 7 % 3000;
  }
  const Json data = dataOf(runPage(run, {}, {}, "careen"));
  ASSERT_EQ(data["impacts"].size(), kMostImpactsOnPage);
  EXPECT_EQ(data["impact_count"], 3000);
  double last = 0;
  for (const Json& impact : data["impacts"]) {
    EXPECT_GT(impact[4].get<double>(), 1000);
    EXPECT_GT(impact[0].get<double>(), last);
    last = impact[0];
  }
}

}  // namespace
}  // namespace careen
