#include "audit/audit.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <variant>

#include "scene/plan.h"
#include "scene/scene_reader.h"

namespace careen {
namespace {

Trajectory runOf(const std::string& scene) { return record(setupOf(parseScene(scene, "test"))); }

// Two boxes that meet in the middle of a room without gravity, and one that flies by itself.
const char* const kThree = R"({"careen": 1, "duration": 2, "boxes": [
  {"name": "left", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [-1, 0, 0], "velocity": [1, 0, 0],
   "angular_velocity": [1, 2, 3], "restitution": 1},
  {"name": "right", "half_extents": [0.1, 0.2, 0.1], "mass": 2, "position": [1, 0.05, 0], "velocity": [-1, 0, 0],
   "restitution": 1},
  {"name": "loner", "half_extents": [0.1, 0.2, 0.3], "mass": 1, "position": [0, 3, 0], "velocity": [0, 0.1, 0],
   "angular_velocity": [3, 2, 1]}]})";

// One box that bounces on a floor.
const char* const kBouncing = R"({"careen": 1, "duration": 2, "gravity": [0, 0, -9.81],
  "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 1}],
  "boxes": [{"name": "ball", "half_extents": [0.1, 0.2, 0.3], "mass": 2, "position": [0, 0, 1],
             "angular_velocity": [1, 2, 3], "velocity": [1, 0, 0], "restitution": 1}]})";

// One that slides to rest, and one on a spring in air.
const char* const kSliding = R"({"careen": 1, "duration": 2, "gravity": [0, 0, -9.81],
  "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.5}],
  "boxes": [{"name": "slider", "half_extents": [0.3, 0.2, 0.1], "mass": 2, "position": [0, 0, 0.1],
             "velocity": [2, 0, 0], "friction": 0.5}]})";
const char* const kSpring = R"({"careen": 1, "duration": 2, "gravity": [0, 0, -9.81],
  "drag": {"linear": 0.1, "angular": 0.001},
  "springs": [{"from": ["bob", [0.1, 0, 0]], "to": [0, 0, 2], "stiffness": 30, "rest_length": 0.5}],
  "boxes": [{"name": "bob", "half_extents": [0.1, 0.2, 0.1], "mass": 1, "position": [0.4, 0, 0.5]}]})";

const AuditBreach* breachOf(const Audit& audit, AuditKind kind) {
  for (const AuditBreach& breach : audit.breaches) {
    if (breach.kind == kind) {
      return &breach;
    }
  }
  return nullptr;
}

std::string textOf(const Audit& audit, const Trajectory& run) {
  std::string text;
  for (const AuditBreach& breach : audit.breaches) {
    text += describe(breach, run) + "\n";
  }
  return text;
}

TEST(Audit, soundRunsBreakNothingAtAnyDepth) {
  for (const char* const scene : {kThree, kBouncing, kSliding, kSpring}) {
    const Trajectory run = runOf(scene);
    for (const AuditDepth depth : {AuditDepth::kUsual, AuditDepth::kFull}) {
      const Audit found = audit(run, depth);
      EXPECT_EQ(textOf(found, run), "");
      EXPECT_GT(found.looks, 100U);
    }
  }
}

TEST(Audit, noneLooksAtNothing) {
  Trajectory run = runOf(kThree);
  run.tracks[0].segments.open().front().motion = Rest{};
  const Audit found = audit(run, AuditDepth::kNone);
  EXPECT_EQ(found.looks, 0U);
  EXPECT_TRUE(found.breaches.empty());
}

TEST(Audit, isToldInWordsWhatIsPromisedFirst) {
  Audit found;
  EXPECT_EQ(inWords(found), "nothing found");
  found.figures[indexOf(AuditKind::kImpulse)].size = 0.84;
  EXPECT_EQ(inWords(found), "no promise concerns impulse 0.84");
  found.figures[indexOf(AuditKind::kEnergyRise)] = {.size = 0.002, .time = 1, .bodies = {}, .promised = true};
  found.figures[indexOf(AuditKind::kBoxOverlap)] = {.size = 0.092, .time = 1, .bodies = {}, .promised = true};
  EXPECT_EQ(inWords(found), "box_overlap 0.092 m, energy_rise 0.002; no promise concerns impulse 0.84");
  found.breaches.emplace_back();
  EXPECT_TRUE(inWords(found).starts_with("BROKEN: box_overlap "));
}

TEST(Audit, givesTheSameTwice) {
  const Trajectory run = runOf(kSpring);
  const Audit first = audit(run, AuditDepth::kUsual);
  const Audit second = audit(run, AuditDepth::kUsual);
  EXPECT_EQ(first.looks, second.looks);
  for (std::size_t kind = 0; kind < kAuditKindCount; ++kind) {
    EXPECT_EQ(first.figures[kind].size, second.figures[kind].size);
    EXPECT_EQ(first.figures[kind].time, second.figures[kind].time);
  }
}

/// A run made wrong, and what must be found.
struct Wrong {
  const char* scene;
  std::function<void(Trajectory&)> change;
  AuditKind kind;
  std::vector<std::string> bodies;
  double from;  ///< [s] when the breach may begin
  double to;
};

void expectFound(const Wrong& wrong) {
  Trajectory run = runOf(wrong.scene);
  wrong.change(run);
  const Audit found = audit(run, AuditDepth::kUsual);
  const AuditBreach* const breach = breachOf(found, wrong.kind);
  ASSERT_NE(breach, nullptr) << traitsOf(wrong.kind).name << " not among:\n" << textOf(found, run);
  EXPECT_EQ(breach->bodies, wrong.bodies) << describe(*breach, run);
  EXPECT_GE(breach->time, wrong.from);
  EXPECT_LE(breach->time, wrong.to);
  EXPECT_GT(breach->size, breach->allowed);
  EXPECT_GE(found.figure(wrong.kind).size, breach->size);
}

Flight& flight(Trajectory& run, std::size_t body, std::size_t segment) {
  return std::get<Flight>(run.tracks[body].segments.open().at(segment).motion);
}
double startOf(const Trajectory& run, std::size_t body, std::size_t segment) {
  return run.tracks[body].segments[segment].start;
}

TEST(Audit, findsStatesThatAreNotFinite) {
  expectFound({kThree,
               [](Trajectory& run) {
                 flight(run, 2, 0).angularMomentum.x() = std::numeric_limits<double>::quiet_NaN();
               },
               AuditKind::kNotFinite,
               {"loner"},
               0,
               0});
}

TEST(Audit, findsAnAttitudeThatIsNoRotation) {
  expectFound({kSliding,
               [](Trajectory& run) {
                 std::get<Rest>(run.tracks[0].segments.open().back().motion).pose.worldFromBody *= 1.001;
               },
               AuditKind::kOrthogonality,
               {"slider"},
               0.3,
               0.5});
}

TEST(Audit, findsAJumpOfAPlace) {
  const double met = startOf(runOf(kThree), 0, 1);
  expectFound({kThree,
               [](Trajectory& run) { flight(run, 0, 1).position.z() += 1e-4; },
               AuditKind::kContinuity,
               {"left"},
               met,
               met});
}

TEST(Audit, findsAJumpOfAnAttitude) {
  const double met = startOf(runOf(kThree), 0, 1);
  expectFound({kThree,
               [](Trajectory& run) {
                 Quat& turn = flight(run, 0, 1).worldFromBody;
                 turn = (Quat(Eigen::AngleAxisd(1e-3, Vec3::UnitX())) * turn).normalized();
               },
               AuditKind::kContinuity,
               {"left"},
               met,
               met});
}

TEST(Audit, findsAnImpactThatIsNotRecorded) {
  const double met = startOf(runOf(kThree), 0, 1);
  expectFound(
      {kThree, [](Trajectory& run) { run.impacts.clear(); }, AuditKind::kImpulse, {"left"}, met, met});
  expectFound(
      {kThree, [](Trajectory& run) { run.impacts.clear(); }, AuditKind::kLinearMomentum, {"left"}, met, 2});
}

TEST(Audit, findsAWallImpactOfAWrongSize) {
  const double met = startOf(runOf(kBouncing), 0, 1);
  const auto halve = [](Trajectory& run) { run.impacts.front().impulse /= 2; };
  expectFound({kBouncing, halve, AuditKind::kImpulse, {"ball"}, met, met});
  expectFound({kBouncing, halve, AuditKind::kLinearMomentum, {"ball"}, met, 2});
}

// The two come as near as 0.3 m in flight, so a step aside and back lies between two seams.
TEST(Audit, findsAnOverlapThatIsSeenOnlyBetweenSeams) {
  const auto visit = [](Trajectory& run) {
    // The loner goes to where "right" starts, stays a moment, and comes back along the same way.
    Rest there;
    there.pose.position = run.state(1, 0.25).pose.position;
    std::vector<Segment>& segments = run.tracks[2].segments.open();
    const Motion usual = segments.front().motion;
    segments.push_back({.start = 0.25, .motion = there});
    Flight later = std::get<Flight>(usual);
    later.position = later.positionAt(0.30);
    segments.push_back({.start = 0.30, .motion = later});
  };
  expectFound({kThree, visit, AuditKind::kBoxOverlap, {"right", "loner"}, 0.25, 0.30});
}

TEST(Audit, findsBoxesThatPassThroughEachOther) {
  const double met = startOf(runOf(kThree), 0, 1);
  expectFound({kThree,
               [](Trajectory& run) {
                 run.impacts.clear();
                 run.tracks[0].segments.open().resize(1);
                 run.tracks[1].segments.open().resize(1);
               },
               AuditKind::kBoxOverlap,
               {"left", "right"},
               met,
               met + 0.01});
}

TEST(Audit, boxesThatMayPassThroughEachOtherDoNotOverlap) {
  Trajectory run = runOf(kThree);
  run.impacts.clear();
  run.tracks[0].segments.open().resize(1);
  run.tracks[1].segments.open().resize(1);
  run.world.apart = {{0, 1}};
  EXPECT_EQ(textOf(audit(run, AuditDepth::kFull), run), "");
}

// The loner goes 0.1 m/s along y, from (0, 3, 0).
Joint& leash(Trajectory& run) {
  run.world.joints = {{.name = "leash",
                       .kind = Joint::Kind::kRope,
                       .from = {.body = 2},
                       .to = {.body = {}, .point = {0, 3, 0}},
                       .length = 0.15}};
  return run.world.joints[0];
}

TEST(Audit, findsAJointThatIsOpen) {
  expectFound(
      {kThree, [](Trajectory& run) { leash(run); }, AuditKind::kJointGap, {"loner", "leash"}, 1.5, 1.51});
  Trajectory run = runOf(kThree);
  leash(run).until = 1.5;  // then it lets go
  EXPECT_EQ(textOf(audit(run, AuditDepth::kFull), run), "");
}

TEST(Audit, findsAJointBeyondItsLimits) {
  const auto slide = [](Trajectory& run) {
    Joint& slider = leash(run);
    slider.kind = Joint::Kind::kSlider;
    slider.highest = 0.15;
    slider.to.axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // along y
  };
  expectFound({kThree, slide, AuditKind::kJointLimit, {"loner", "leash"}, 1.5, 1.51});
}

TEST(Audit, findsABoxThatFallsThroughAFloor) {
  const double met = startOf(runOf(kBouncing), 0, 1);
  expectFound({kBouncing,
               [](Trajectory& run) {
                 run.impacts.clear();
                 run.tracks[0].segments.open().resize(1);
               },
               AuditKind::kWallOverlap,
               {"ball", "floor"},
               met,
               met + 0.01});
}

// A wall of 0.5 m/s takes a box along from 1.8 s on; one of 0.625 m/s would be 0.25 m past its face at 2 s.
TEST(Audit, findsABoxBehindAWallThatMoves) {
  Trajectory run = runOf(R"({"careen": 1, "duration": 2,
    "walls": [{"name": "press", "point": [-1, 0, 0], "normal": [1, 0, 0], "motion": {"velocity": [0.5, 0, 0]}}],
    "boxes": [{"name": "box", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [0, 0, 0]}]})");
  EXPECT_TRUE(audit(run, AuditDepth::kFull).breaches.empty());
  for (CoursePart& part : run.world.walls[0].course) {
    part.motion.velocity *= 1.25;
  }
  const Audit found = audit(run, AuditDepth::kFull);
  const AuditBreach* const behind = breachOf(found, AuditKind::kWallOverlap);
  ASSERT_NE(behind, nullptr) << textOf(found, run);
  EXPECT_NEAR(behind->largest, 0.25, 1e-9);
}

TEST(Audit, findsMomentumThatNothingGave) {
  expectFound({kThree,
               [](Trajectory& run) { flight(run, 2, 0).acceleration = Vec3(1e-7, 0, 0); },
               AuditKind::kLinearMomentum,
               {"loner"},
               0,
               2});
  // A wall pushes; it does not pull, and without friction it does not drag.
  expectFound({kSliding,
               [](Trajectory& run) { run.world.walls[0].material.friction = 0; },
               AuditKind::kLinearMomentum,
               {"slider"},
               0,
               0.1});
}

TEST(Audit, findsAngularMomentumThatNothingGave) {
  const double met = startOf(runOf(kThree), 0, 1);
  expectFound({kThree,
               [](Trajectory& run) { flight(run, 0, 1).angularMomentum *= 1.2; },
               AuditKind::kAngularMomentum,
               {"left", "right"},
               met,
               2});
}

TEST(Audit, findsABoxThatRestsInTheAir) {
  expectFound({kBouncing,
               [](Trajectory& run) {
                 Rest rest;
                 rest.pose = run.state(0, 0).pose;
                 run.tracks[0].segments = {{.start = 0, .motion = rest}};
                 run.impacts.clear();
               },
               AuditKind::kLinearMomentum,
               {"ball"},
               0,
               0.1});
}

TEST(Audit, findsEnergyThatNothingGave) {
  const double met = startOf(runOf(kBouncing), 0, 1);
  expectFound({kBouncing,
               [](Trajectory& run) { flight(run, 0, 1).angularMomentum *= 1.01; },
               AuditKind::kEnergyRise,
               {"ball"},
               met,
               2});
}

TEST(Audit, findsEnergyThatNothingTook) {
  const double met = startOf(runOf(kBouncing), 0, 1);
  expectFound({kBouncing,
               [](Trajectory& run) { flight(run, 0, 1).angularMomentum *= 0.99; },
               AuditKind::kEnergyLoss,
               {"ball"},
               met,
               2});
}

TEST(Audit, mayLoseEnergyWhereSomethingTakesIt) {
  Trajectory run = runOf(kBouncing);
  flight(run, 0, 1).angularMomentum *= 0.99;
  run.world.walls[0].material.restitution = run.world.bodies[0].material.restitution = 0.9;
  EXPECT_EQ(breachOf(audit(run, AuditDepth::kUsual), AuditKind::kEnergyLoss), nullptr);
}

// A restitution that never acts takes nothing: two boxes on a spring, which never touch, in contact steps.
TEST(Audit, energyThatASpringLosesIsFoundWhateverTheMaterials) {
  const std::string scene = R"({"careen": 1, "duration": 1, "boxes": [
    {"name": "a", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [-0.6, 0, 0], "friction": 0.5},
    {"name": "b", "half_extents": [0.1, 0.1, 0.1], "mass": 3, "position": [0.5, 0, 0], "friction": 0.5}],
    "springs": [{"from": ["a", [0, 0, 0]], "to": ["b", [0, 0, 0]], "stiffness": 100, "rest_length": 1}]})";
  Trajectory run = runOf(scene);
  EXPECT_EQ(textOf(audit(run, AuditDepth::kUsual), run), "");
  // From the middle on, both move about the centre of mass by 1 % less.
  for (Track& track : run.tracks) {
    const Vec3 middle(0.225, 0, 0);
    for (Segment& segment : track.segments.open()) {
      if (ContactStep* const step = std::get_if<ContactStep>(&segment.motion);
          step != nullptr && segment.start > 0.5) {
        step->position[0] = middle + 0.99 * (step->position[0] - middle);
        for (std::size_t k = 1; k < step->position.size(); ++k) {
          step->position[k] *= 0.99;
        }
      }
    }
  }
  EXPECT_NE(breachOf(audit(run, AuditDepth::kUsual), AuditKind::kEnergyLoss), nullptr);
}

// A crowd promises places only to its own tolerance; what is found is named.
TEST(Audit, judgesTheMembersOfACrowdByItsTolerance) {
  Trajectory run = runOf(kThree);
  run.impacts.clear();
  for (std::size_t body = 0; body < 2; ++body) {
    const BodyState start = run.state(body, 0);
    run.world.bodies[body].initial.angularMomentum.setZero();  // it does not turn in this step
    CrowdStep still{.duration = run.settings.duration};
    still.position.fill(Vec3::Zero());
    still.worldFromBody.fill(Vec4::Zero());
    still.position[0] = start.pose.position;
    still.position[1] = run.settings.duration * start.velocity;
    still.worldFromBody[0] = Quat(start.pose.worldFromBody).coeffs();
    run.tracks[body].segments.open().resize(1);
    run.tracks[body].segments.open()[0].motion = still;
  }
  run.settings.crowds.tolerance = 1;
  const Audit lax = audit(run, AuditDepth::kUsual);
  EXPECT_EQ(textOf(lax, run), "");
  EXPECT_GT(lax.figure(AuditKind::kBoxOverlap).size, 0.05);
  run.settings.crowds.tolerance = 1e-3;
  EXPECT_NE(breachOf(audit(run, AuditDepth::kUsual), AuditKind::kBoxOverlap), nullptr);
}

TEST(Audit, fullLooksAtEverySegment) {
  const Trajectory run = runOf(kSliding);
  EXPECT_GT(audit(run, AuditDepth::kFull).looks, audit(run, AuditDepth::kUsual).looks);
}

}  // namespace
}  // namespace careen
