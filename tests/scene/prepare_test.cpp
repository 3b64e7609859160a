#include "scene/prepare.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "physics/world/method.h"
#include "scene/scene_reader.h"
#include "scene/starts.h"
#include "support/input_error.h"

namespace careen {
namespace {

// A box of 2 m, and one 1 m beside it: in each other where boxes collide.
Scene scene(double apart = 3, Starts starts = Starts::kApart, const char* method = "exact") {
  const std::string box = R"({"half_extents": [1, 1, 1], "mass": 1, "position": [)";
  return parseScene(R"({"careen": 1, "duration": 2, "dt": 0.01, "method": ")" + std::string(method) +
                        R"(", "boxes": [)" + box + "0, 0, 0]}, " + box + std::to_string(apart) + ", 0, 0]}]}",
                    "s", starts);
}

TEST(Prepare, overridesReplaceTheScenesOwnAndAreTold) {
  std::vector<std::string> told;
  const PreparedRun run =
      prepare(scene(), {.method = Method::kListing1, .dt = 0.02, .duration = 2, .threads = 3},
              [&told](const char* name, const std::string& given, const std::string& inScene) {
                told.push_back(std::string(name) + " " + given + " " + inScene);
              });
  EXPECT_EQ(told, (std::vector<std::string>{"method listing1 exact", "dt 0.02 0.01"}));
  EXPECT_EQ(run.setup.settings.method, Method::kListing1);
  EXPECT_EQ(run.setup.settings.dt, 0.02);
  EXPECT_EQ(run.setup.settings.duration, 2);
  EXPECT_EQ(run.setup.settings.threads, 3);
}

TEST(Prepare, withoutOverridesARunIsAsTheSceneSays) {
  const Scene read = scene();
  const PreparedRun run = prepare(read, {});
  EXPECT_EQ(run.setup.settings.method, read.settings.method);
  EXPECT_EQ(run.setup.settings.tolerance, read.settings.tolerance);
  EXPECT_EQ(run.setup.settings.duration, read.settings.duration);
  EXPECT_GE(run.setup.settings.threads, 1);
  EXPECT_EQ(run.setup.world.bodies.size(), 2U);
}

TEST(Prepare, refusesWhatTheMethodDoesNotUseAndWhatIsNoPositiveNumber) {
  const auto said = [](const RunOverrides& overrides) {
    return inputErrorOf([&] { prepare(scene(), overrides); });
  };
  EXPECT_EQ(said({.dt = 0.1, .sign = "--"}),
            "--dt: found 0.1, but method exact does not use it; expected no --dt");
  EXPECT_EQ(said({.method = Method::kListing1, .tolerance = 1e-3}),
            "tolerance: found 0.001, but method listing1 does not use it; expected no tolerance");
  for (const double number : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(said({.duration = number}).find("expected a positive number"), std::string::npos) << number;
  }
  EXPECT_NE(said({.threads = 0}).find("expected 1 to 64"), std::string::npos);
  EXPECT_NE(said({.threads = 65}).find("expected 1 to 64"), std::string::npos);
}

// 2 s in steps of 0.01 s of two boxes: 400, and 200 for each record.
TEST(Prepare, boundsTheStepsByTheRecords) {
  RunOverrides overrides{.method = Method::kListing1, .most = 2};
  EXPECT_NO_THROW(prepare(scene(), overrides));
  overrides.most = 1;
  EXPECT_NE(
      inputErrorOf([&] { prepare(scene(), overrides); }).find("400 steps of boxes, expected at most 200"),
      std::string::npos);
  overrides.method = Method::kExact;
  EXPECT_NO_THROW(prepare(scene(), overrides));
}

TEST(Prepare, overlapsAreRefusedForAnotherMethodOrMovedApart) {
  const char* const steps = "strang";
  EXPECT_NO_THROW(prepare(scene(1, Starts::kApart, steps), {}));
  EXPECT_NE(inputErrorOf([&] {
              prepare(scene(1, Starts::kApart, steps), {.method = Method::kExact});
            }).find("expected boxes apart"),
            std::string::npos);
  const PreparedRun run = prepare(scene(1, Starts::kMayOverlap), {.allowOverlap = true});
  EXPECT_EQ(run.parted.pairs, 1U);
  EXPECT_GE(
      (run.setup.world.bodies[1].initial.pose.position - run.setup.world.bodies[0].initial.pose.position)
          .norm(),
      2 * (1 - kGapAllowance));
}

}  // namespace
}  // namespace careen
