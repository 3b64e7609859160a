// Compares the files of assets/truths with their computation, and the oracles with each other.
#include "study/truths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>

#include "support/closed_forms.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using nlohmann::json;

// The same double, or its neighbour: rounding from quadruple precision may meet a tie.
void expectSame(double file, double computed, const std::string& where) {
  const double one = std::nextafter(std::fabs(computed), 1e308) - std::fabs(computed);
  EXPECT_LE(std::fabs(file - computed), one) << where;
}

void expectSameNumbers(const json& file, const json& computed, const std::string& where) {
  if (file.is_structured()) {
    ASSERT_EQ(file.size(), computed.size()) << where;
    auto other = computed.begin();
    for (const json& each : file) {
      expectSameNumbers(each, *other++, where);
    }
  } else if (file.is_number()) {
    expectSame(file.get<double>(), computed.get<double>(), where);
  } else {
    EXPECT_EQ(file, computed) << where;
  }
}

void expectTheFiles(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    expectSameNumbers(oracle::jsonIn(truthPath(name)), json::parse(toText(computeTruth(name))), name);
  }
}

TEST(Truths, ofTumblingAreThoseOfTheFiles) {
  expectTheFiles({"tumble-generic", "tumble-middle-axis", "separatrix-1e-3", "separatrix-1e-6",
                  "separatrix-1e-9", "plate", "free-fall"});
}

TEST(Truths, ofTheNeedleIsThatOfTheFile) { expectTheFiles({"needle"}); }

// Only so many times of a file are computed again.
void expectTheStartOfTheFile(const std::string& name, std::size_t count) {
  json file = oracle::jsonIn(truthPath(name));
  ASSERT_GT(file["times"].size(), count);
  const auto shorten = [&](json& list) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(count), list.end());
  };
  shorten(file["times"]);
  for (json& box : file["boxes"]) {
    shorten(box["positions"]);
    shorten(box["orientations"]);
  }
  expectSameNumbers(file, json::parse(toText(computeTruth(name, count))), name);
}

// Ten thousand radians in quadruple precision take half a minute. OwnMethodsOnHardCases holds all of the file
// to 6.9e-13.
TEST(Truths, ofTheFastSpinStartsAsThatOfTheFile) { expectTheStartOfTheFile("fast-spin", 2); }

TEST(Truths, ofJointsAreThoseOfTheFiles) {
  expectTheFiles({"pendulum", "parallelogram", "weld", "rope-taut", "limit-half", "cart-pole", "slide-pd",
                  "double-pendulum", "triple-pendulum", "heavy-top"});
}

// All of these takes minutes.
TEST(Truths, ofChainsOfTenStartAsThoseOfTheFiles) {
  for (const char* const name : {"chain-heavy-100", "chain-heavy-1e4", "chain-free"}) {
    expectTheStartOfTheFile(name, 1);
  }
}

TEST(Truths, ofBouncingAndLandingAreThoseOfTheFiles) {
  expectTheFiles({"bounce-1000", "zeno-half", "zeno-nine", "landing-flat", "landing-edge",
                  "landing-room-corner", "near-simultaneous-1e-3", "near-simultaneous-1e-6",
                  "near-simultaneous-1e-9", "near-simultaneous-1e-12"});
}

TEST(Truths, ofImpactsOnACornerAreThoseOfTheFiles) {
  expectTheFiles({"corner-impact", "scaled", "millimetre", "kilometre", "far-away", "thin-wall"});
}

TEST(Truths, ofGrazingAreThoseOfTheFiles) {
  expectTheFiles({"grazing-hit", "grazing-miss", "grazing-hit-tumbling", "grazing-miss-tumbling"});
}

TEST(Truths, ofRoomsAndBilliardAreThoseOfTheFiles) {
  expectTheFiles({"room-million", "room-minute", "reversal", "galperin"});
}

TEST(Truths, ofSlidingAndSpinningAreThoseOfTheFiles) {
  expectTheFiles({"sliding-azimuths", "sliding-spinning", "spinning-stop"});
}

TEST(Truths, ofContactAreThoseOfTheFiles) {
  expectTheFiles({"incline-slide", "incline-hold", "rocking-block", "rocking-measured", "tip-or-slide",
                  "stack-10", "stack-heavy-100", "stack-heavy-1e6", "row-of-boxes", "overhang", "belt",
                  "turntable", "braked", "shaking-table", "lift-stops", "pusher"});
}

TEST(Truths, ofPublishedScenesAreThoseOfTheFiles) {
  const std::vector<std::string> published = {
      "friction-threshold", "cube-1000-on-1", "land-corner-corner", "land-edge-edge",    "land-crossed-edges",
      "land-corner-face",   "tent",           "card-house-2",       "card-house-3",      "card-house-4",
      "bernoulli",          "cradle-two",     "painleve-rod",       "omnibench-incline", "omnibench-stack",
      "omnibench-spin",     "kapla-tower"};
  expectTheFiles(published);
  for (const std::string& name : truthNames()) {
    const bool isOne = std::find(published.begin(), published.end(), name) != published.end();
    EXPECT_EQ(oracle::jsonIn(truthPath(name)).contains("published"), isOne) << name;
  }
}

std::set<std::string> namesIn(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_EQ(entry.path().extension(), ".json") << entry.path();
    names.insert(entry.path().stem().string());
  }
  return names;
}

TEST(Truths, everyHardSceneHasOneAndNoOtherHas) {
  const std::vector<std::string> list = truthNames();
  const std::set<std::string> names(list.begin(), list.end());
  EXPECT_EQ(names.size(), list.size());
  EXPECT_EQ(namesIn(scenePath("x").parent_path()), names);
  EXPECT_EQ(namesIn(truthPath("x").parent_path()), names);
}

// The words of the comments before the scene's first brace.
std::string commentOf(const std::string& scene) {
  std::istringstream text(scene.substr(0, scene.find("\n{")));
  std::string comment;
  for (std::string word; text >> word;) {
    if (word != "//") {
      comment += (comment.empty() ? "" : " ") + word;
    }
  }
  return comment;
}

TEST(Truths, sayWhyTheirCasesAreHardAsTheScenesDo) {
  std::set<std::string> titles;
  for (const std::string& name : truthNames()) {
    const json truth = oracle::jsonIn(truthPath(name));
    EXPECT_EQ(truth.at("scene"), "hard/" + name + ".json");
    EXPECT_TRUE(titles.insert(truth.at("title").get<std::string>()).second) << name;
    const auto why = truth.at("why_hard").get<std::string>();
    EXPECT_EQ(why, commentOf(oracle::textOf(scenePath(name))));
    EXPECT_TRUE(why.ends_with('.')) << name;
    const auto source = truth.at("source").get<std::string>();
    EXPECT_TRUE(source.starts_with("closed form: ") || source.starts_with("quadruple precision")) << name;
  }
}

TEST(Truths, lookAtEqualPartsOfTheDurationUpToItsEnd) {
  for (const std::string& name : truthNames()) {
    const json truth = oracle::jsonIn(truthPath(name));
    if (truth.at("measure") == "scaled") {
      continue;
    }
    const double duration = oracle::jsonIn(scenePath(name)).at("duration").get<double>();
    const auto times = truth.at("times").get<std::vector<double>>();
    for (std::size_t k = 0; k < times.size(); ++k) {
      EXPECT_EQ(times[k], duration * static_cast<double>(k + 1) / static_cast<double>(times.size())) << name;
    }
    EXPECT_EQ(times.back(), duration) << name;
  }
}

TEST(Truths, sayWhereEveryMovableBoxIsAndNoOther) {
  for (const std::string& name : truthNames()) {
    const json truth = oracle::jsonIn(truthPath(name));
    EXPECT_EQ(truth.contains("boxes"), truth.at("measure") == "poses") << name;
    if (!truth.contains("boxes")) {
      continue;
    }
    std::size_t movable = 0;
    for (const oracle::QuadBox& box : oracle::sceneIn(scenePath(name)).boxes) {
      if (box.fixed) {
        continue;
      }
      const json& entry = truth["boxes"].at(movable++);
      EXPECT_EQ(entry.at("name"), box.name);
      EXPECT_EQ(entry.at("positions").size(), truth["times"].size()) << name;
      EXPECT_EQ(entry.at("orientations").size(), truth["times"].size()) << name;
      for (const json& each : entry["orientations"]) {
        const auto q = each.get<std::vector<double>>();
        const auto first = std::find_if(q.begin(), q.end(), [](double part) { return part != 0; });
        EXPECT_GT(*first, 0) << name;
        EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-15) << name;
      }
    }
    EXPECT_EQ(truth["boxes"].size(), movable) << name;
  }
}

// The scaled scene is the other scene in other units, to the bit.
TEST(Truths, theScaledSceneIsTheOtherInUnitsThatArePowersOfTwo) {
  const json truth = oracle::jsonIn(truthPath("scaled"));
  EXPECT_EQ(truth.at("of"), "hard/corner-impact.json");
  const double lengths = truth.at("lengths").get<double>();
  const double times = truth.at("times").get<double>();
  const json one = oracle::jsonIn(scenePath("corner-impact"));
  const json other = oracle::jsonIn(scenePath("scaled"));
  const auto scaled = [](const json& numbers, double by) {
    auto values = numbers.get<std::vector<double>>();
    for (double& value : values) {
      value *= by;
    }
    return values;
  };
  EXPECT_EQ(other.at("duration").get<double>(), times * one.at("duration").get<double>());
  EXPECT_EQ(other.at("dt").get<double>(), times * one.at("dt").get<double>());
  EXPECT_EQ(scaled(other.at("gravity"), 1), scaled(one.at("gravity"), lengths / (times * times)));
  for (const char* side : {"min", "max"}) {
    EXPECT_EQ(scaled(other["room"][side], 1), scaled(one["room"][side], lengths));
  }
  const json& box = one["boxes"].at(0);
  const json& otherBox = other["boxes"].at(0);
  EXPECT_EQ(scaled(otherBox["half_extents"], 1), scaled(box["half_extents"], lengths));
  EXPECT_EQ(scaled(otherBox["position"], 1), scaled(box["position"], lengths));
  EXPECT_EQ(otherBox["orientation"], box["orientation"]);
  EXPECT_EQ(scaled(otherBox["velocity"], 1), scaled(box["velocity"], lengths / times));
  EXPECT_EQ(scaled(otherBox["angular_velocity"], 1), scaled(box["angular_velocity"], 1 / times));
}

}  // namespace
}  // namespace careen::study
