#include "question/until.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "audit/audit.h"
#include "physics/world/method.h"
#include "question/moments.h"
#include "support/asked_runs.h"
#include "support/exact_runs.h"
#include "support/input_error.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

using test::kG;

RunSetup setupFor(const World& world, double duration, Method method = Method::kExact,
                  CrowdSettings crowds = {}) {
  RunSetup setup{.sceneText = "{}",
                 .settings = {.method = method, .duration = duration, .crowds = crowds},
                 .world = world,
                 .stage = {},
                 .plan = {}};
  setup.stage.colors.resize(world.bodies.size());
  return setup;
}
RunUntil endedBy(const RunSetup& setup, const std::string& question) {
  return recordUntil(setup, readQuestion(question, setup.world));
}

// A cube falls 0.45 m onto the floor, e = 0.6.
World bouncing() {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  world.bodies = {box("a", Vec3::Constant(0.05), 1, Vec3(0, 0, 0.5), Vec3::Zero(), Vec3::Zero(), 0.6)};
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  return world;
}

World pile(int boxes) {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.5;
  for (int i = 0; i < boxes; ++i) {
    Body each = box("b" + std::to_string(i), Vec3::Constant(0.1), 1,
                    Vec3(0.02 * (i % 2), 0.01 * i, 0.12 + 0.25 * i), Vec3::Zero(), Vec3(0.5, 0, 0), 0);
    each.material.friction = 0.5;
    world.bodies.push_back(each);
  }
  return world;
}

TEST(Until, aRunEndsWhenItIsTrue) {
  const RunUntil until = endedBy(setupFor(bouncing(), 5), "a touches floor");
  ASSERT_TRUE(until.time);
  EXPECT_NEAR(*until.time, std::sqrt(0.9 / kG), 1e-14);
  const Trajectory& run = until.run;
  EXPECT_EQ(run.settings.duration, *until.time);
  EXPECT_NEAR(run.state(0, *until.time).pose.position.z(), 0.05, 1e-12);
  EXPECT_GT(run.state(0, *until.time).velocity.z(), 0);  // after the impact, which belongs to it
  ASSERT_FALSE(run.impacts.empty());
  EXPECT_EQ(run.impacts.back().time, *until.time);
  EXPECT_TRUE(audit(run, AuditDepth::kFull).breaches.empty());
  // As anybody reads it.
  const Trajectory read = decodeTrajectory(encodeTrajectory(run), "run");
  EXPECT_EQ(read.stateHash(), run.stateHash());
  EXPECT_EQ(moments(read, readQuestion("a touches floor", read.world)).back().time, *until.time);
  // And as a run that was asked to last so long.
  RunSetup same = setupFor(bouncing(), *until.time);
  EXPECT_EQ(record(same).stateHash(), run.stateHash());
}

TEST(Until, whatNeverIsTrueEndsNothing) {
  const RunUntil until = endedBy(setupFor(bouncing(), 2), "height(a) > 1");
  EXPECT_FALSE(until.time);
  EXPECT_EQ(until.run.stateHash(), record(setupFor(bouncing(), 2)).stateHash());
  // Nor does what is true from the start.
  EXPECT_FALSE(endedBy(setupFor(bouncing(), 0.5), "height(a) > 0.01").time);
}

// A million seconds are not simulated, nor are those after the limit of records.
TEST(Until, aLongRunIsCutShort) {
  World world = bouncing();
  world.bodies[0].material.restitution = 1;
  const RunSetup setup = setupFor(world, 1e6);
  const Question question = readQuestion("speed(a) > 2.5", world);
  EXPECT_NE(inputErrorOf([&] { record(setup, {}, 20'000); }), "no error");
  const RunUntil until = recordUntil(setup, question, {}, 20'000);
  ASSERT_TRUE(until.time);
  EXPECT_NEAR(*until.time, 2.5 / kG, 1e-12);
}

// Rest is where it is in the whole run, whichever way bodies go on; and the run still keeps its promises.
TEST(Until, restIsThatOfTheWholeRun) {
  for (const CrowdSettings crowds :
       {CrowdSettings{}, CrowdSettings{.when = CrowdSettings::When::kAbove, .above = 1}}) {
    const RunSetup setup = setupFor(pile(4), 10, Method::kExact, crowds);
    const Trajectory whole = record(setup);
    EXPECT_EQ(whole.figures.boundedFrom.has_value(), crowds.above > 0);
    const std::vector<Moment> rest = moments(whole, readQuestion("rest", whole.world));
    ASSERT_FALSE(rest.empty());
    const RunUntil until = endedBy(setup, "rest");
    ASSERT_TRUE(until.time);
    EXPECT_EQ(*until.time, rest.front().time);
    for (std::size_t body = 0; body < whole.tracks.size(); ++body) {
      EXPECT_TRUE(std::holds_alternative<Rest>(until.run.tracks[body].segments.back().motion));
      EXPECT_EQ(until.run.state(body, *until.time).pose.position,
                whole.state(body, *until.time).pose.position);
    }
    const Audit audited = audit(until.run, AuditDepth::kFull);
    EXPECT_TRUE(audited.breaches.empty()) << inWords(audited);
    EXPECT_EQ(decodeTrajectory(encodeTrajectory(until.run), "run").stateHash(), until.run.stateHash());
  }
}

// Within steps of a crowd, too.
TEST(Until, aCrowdEndsWithinAStep) {
  const RunSetup setup =
      setupFor(pile(4), 10, Method::kExact, {.when = CrowdSettings::When::kAbove, .above = 1});
  const Trajectory whole = record(setup);
  for (const char* const question :
       {"b3 touches b2", "height(b2) < 0.505", "speed(b3) > 2", "tilt(b1) > 1"}) {
    const std::vector<Moment> expected = moments(whole, readQuestion(question, whole.world));
    const RunUntil until = endedBy(setup, question);
    ASSERT_EQ(until.time.has_value(), !expected.empty()) << question;
    if (until.time) {
      EXPECT_NEAR(*until.time, expected.front().time, 2e-3) << question;
      const Audit audited = audit(until.run, AuditDepth::kFull);
      EXPECT_TRUE(audited.breaches.empty()) << question << ' ' << inWords(audited);
    }
  }
}

// Where it ends is a moment of the run that has ended, too.
TEST(Until, theMomentIsInTheRunThatEndsThere) {
  for (const char* const question : {"height(a) < 0.3", "speed(a) > 2", "energy(a) > 3", "a leaves floor",
                                     "a touches floor", "energy(a) < 2"}) {
    const RunUntil until = endedBy(setupFor(bouncing(), 5), question);
    ASSERT_TRUE(until.time) << question;
    const std::vector<Moment> found = moments(until.run, readQuestion(question, until.run.world));
    ASSERT_FALSE(found.empty()) << question;
    EXPECT_EQ(found.back().time, *until.time) << question;
  }
}

TEST(Until, otherMethodsLeaveOutWhatIsBeyond) {
  for (const Method method : {Method::kListing1, Method::kTaylor8}) {
    const RunUntil until = endedBy(setupFor(bouncing(), 1, method), "height(a) < 0.2");
    ASSERT_TRUE(until.time);
    EXPECT_NEAR(*until.time, std::sqrt(0.6 / kG), method == Method::kListing1 ? 5e-3 : 1e-12);
    EXPECT_EQ(until.run.settings.duration, *until.time);
    EXPECT_LE(until.run.tracks[0].segments.back().start, *until.time);
    EXPECT_TRUE(audit(until.run, AuditDepth::kFull).breaches.empty());
  }
}

TEST(Until, endAtLeavesOutWhatIsLater) {
  Trajectory run = record(setupFor(bouncing(), 2));
  run.figures.horizon = 1.5;
  run.jointEfforts = {{.time = 0.1}, {.time = 0.9}};
  const std::size_t segments = run.tracks[0].segments.size();
  const BodyState there = run.state(0, 0.5);
  endAt(run, 0.5);
  EXPECT_EQ(run.settings.duration, 0.5);
  EXPECT_LT(run.tracks[0].segments.size(), segments);
  EXPECT_EQ(run.state(0, 0.5).pose.position, there.pose.position);
  EXPECT_LE(run.impacts.back().time, 0.5);
  EXPECT_EQ(run.jointEfforts.size(), 1U);
  EXPECT_FALSE(run.figures.horizon);
}

}  // namespace
}  // namespace careen
