#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "physics/geometry/separation.h"
#include "support/crowd_scenes.h"
#include "support/tumbling_box.h"

// How deep members of crowds get into each other and into others, at moments that no step chooses.

namespace careen {
namespace {

using namespace test;

// [m] By geometry that shares nothing with the crowd's.
double deepestOverlap(const World& world, const Recorded& run, double until, double every) {
  double deepest = 0;
  std::vector<Pose> poses(world.bodies.size());
  for (double time = 0.22 * every; time < until; time += every) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i] = run.at(world, i, time).pose;
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3& first = world.bodies[i].halfExtents;
        const Vec3& second = world.bodies[j].halfExtents;
        if ((poses[i].position - poses[j].position).norm() < first.norm() + second.norm()) {
          deepest = std::max(deepest, -BoxAxes({poses[i], first}, {poses[j], second}).gap());
        }
      }
    }
  }
  return deepest;
}

TEST(ExactWorldCrowdOverlap, keepsApartToItsToleranceBetweenStepsToo) {
  const World world = layers();
  for (const double tolerance : {3e-4, 3e-5}) {
    const double deepest = deepestOverlap(world, crowdRun(world, 2, tolerance), 2, 0.00618);
    EXPECT_LT(deepest, 3 * tolerance);
    EXPECT_GT(deepest, 0);
  }
}

// Boxes that fall onto each other and turn meet within a step with other features than those that are near at
// its ends. Steps that only those were looked at let 1 scene in 300 go deeper than three tolerances.
TEST(ExactWorldCrowdOverlap, keepsApartWithinStepsInWhichFeaturesPass) {
  for (int scene = 0; scene < 1600; ++scene) {
    test::Dice dice(static_cast<std::uint64_t>(scene));
    World world = onARoughFloor(0.3);
    for (int k = 0; k < 2 + scene % 2; ++k) {
      const Vec3 size{dice.between(0.15, 0.3), dice.between(0.15, 0.3), dice.between(0.15, 0.3)};
      const Vec3 place = 0.3 * dice.vector(1) + Vec3(0, 0, 0.9 + 1.4 * k);
      const double mass = dice.between(0.5, 5);
      Body body =
          ofMaterial(box("box-" + std::to_string(k), size, mass, place, Vec3(0, 0, -6 * (0.5 + k))), 0.3);
      body.initial.pose.worldFromBody = dice.orientation();
      body.initial.angularMomentum =
          angularMomentum(body.mass, body.initial.pose.worldFromBody, dice.vector(4));
      world.bodies.push_back(body);
    }
    EXPECT_LT(deepestOverlap(world, crowdRun(world, 0.35), 0.35, 0.0003), 3 * kTolerance) << scene;
  }
}

// Paths were looked at only at the joints of steps themselves: 2 of 5,600 scenes went 1.0 to 1.2 mm deep
// beside them, these and one like them; then at three moments, between which edges of what spins fast passed
// each other 1.46 mm deep, in the last, one of 6,000.
TEST(ExactWorldCrowdOverlap, keepsApartBesideJoints) {
  struct Falling {
    int boxes = 0;
    std::uint64_t seed = 0;
    double speed = 0;  // [m/s]
    double spin = 4;   // [rad/s]
  };
  for (const Falling falling : {Falling{3, 487, 6}, {3, 10861, 6}, {4, 10383, 3}, {3, 35689, 9, 40}}) {
    test::Dice dice(falling.seed);
    World world = onARoughFloor(0.3);
    for (int k = 0; k < falling.boxes; ++k) {
      const Vec3 size{dice.between(0.15, 0.3), dice.between(0.15, 0.3), dice.between(0.15, 0.3)};
      const double y = dice.between(-0.3, 0.3);
      const Vec3 place(dice.between(-0.3, 0.3), y, 0.6 + 1.05 * k);
      dice.vector(3);
      const double mass = dice.between(0.5, 5);
      Body body = ofMaterial(
          box("box-" + std::to_string(k), size, mass, place, Vec3(0, 0, -falling.speed * (0.5 + k))), 0.3);
      Quat attitude;
      for (const int i : {2, 1, 0, 3}) {
        attitude.coeffs()[i] = dice.between(-1, 1);
      }
      body.initial.pose.worldFromBody = attitude.normalized().toRotationMatrix();
      body.initial.angularMomentum =
          angularMomentum(body.mass, body.initial.pose.worldFromBody, dice.vector(falling.spin));
      world.bodies.push_back(body);
    }
    EXPECT_LT(deepestOverlap(world, crowdRun(world, 0.5), 0.5, 0.0002), 3 * kTolerance)
        << falling.seed;  // measured 4.3e-4
  }
}

// What falls after a member that is stopped within a step meets it within that step.
TEST(ExactWorldCrowdOverlap, keepsApartFromWhoArrivesWithinAStep) {
  test::Dice dice(11);
  for (int scene = 0; scene < 300; ++scene) {
    World world = onARoughFloor(0.7, 0.3);
    double height = 0;
    for (int k = 0; k < 5; ++k) {
      const Vec3 size{dice.between(0.1, 0.2), dice.between(0.1, 0.2), dice.between(0.06, 0.12)};
      height += size.z() + dice.between(0.002, 0.03);
      const Vec3 place(0.02 * k, -0.01 * k, height);
      const Vec3 velocity(0, 0, dice.between(-1, -0.5));
      const double mass = dice.between(0.2, 5);
      world.bodies.push_back(ofMaterial(
          box("box-" + std::to_string(k), size, mass, place, velocity, dice.vector(1), 0), 0.7, 0.3));
      height += size.z();
    }
    EXPECT_LT(deepestOverlap(world, crowdRun(world, 0.3), 0.3, 0.0013), 3 * kTolerance) << scene;
  }
}

// What slides to a stop before a crowd, in the middle of a step, looks for nothing from then on: the crowd's
// members must, for the rest of that step. They went on through it, up to 4.5 mm deep.
TEST(ExactWorldCrowdOverlap, keepsApartFromWhatComesToRestWithinAStep) {
  constexpr double kFriction = 0.5;
  constexpr double kSliding = 1;  // [m/s]
  constexpr double kSpeed = 3;    // [m/s]
  const double stops = kSliding / (kFriction * 9.81);
  double deepest = 0;
  for (int scene = 0; scene < 60; ++scene) {
    World world = onARoughFloor(kFriction);
    const double gap = 0.0005 * (1 + scene % 20);  // [m] when it stops
    const double front = 0.5 * kSliding * stops - kSpeed * stops - gap - 0.0004 * scene;
    for (int k = 0; k < 2; ++k) {
      world.bodies.push_back(ofMaterial(box("slides-" + std::to_string(k), Vec3(0.2, 0.2, 0.2), 1,
                                            Vec3(front - 0.2, 0, 0.2 + 0.4 * k), Vec3(kSpeed, 0, 0)),
                                        0));
    }
    world.bodies.push_back(
        ofMaterial(box("stops", Vec3(0.2, 0.3, 0.1), 1, Vec3(0.2, 0, 0.1), Vec3(kSliding, 0, 0)), kFriction));
    deepest = std::max(deepest, deepestOverlap(world, crowdRun(world, 0.3, kTolerance, 1), 0.3, 0.0002));
  }
  RecordProperty("deepest", std::to_string(deepest));
  EXPECT_LT(deepest, 3 * kTolerance);  // measured 1.1e-4
}

// Two stacks, of which the rear strikes the front one as that strikes what slides in exact contact.
World stacksBeforeASlide(test::Dice dice) {
  World world = onARoughFloor(0.5);
  const double time = dice.between(0.03, 0.08);  // when they meet, about
  const double slides = dice.between(0.5, 2);
  const double way = slides * time - 0.5 * 0.5 * 9.81 * time * time;
  const auto add = [&](const std::string& name, double x, int layer, double speed, double friction) {
    world.bodies.push_back(
        ofMaterial(box(name + std::to_string(layer), Vec3(0.2, 0.2, 0.2), dice.between(0.5, 5),
                       Vec3(x, dice.between(-0.1, 0.1), 0.2 + 0.4 * layer), Vec3(speed, 0, 0)),
                   friction));
  };
  for (int layer = 0; layer < 3; ++layer) {
    add("front", 0, layer, 4, 0);
    add("rear", -0.4 - 5 * time + dice.between(-0.008, 0.008), layer, 9, 0);
  }
  for (int layer = 0; layer < 2; ++layer) {
    add("slides", 0.4 + 4 * time - way + dice.between(0, 0.002), layer, slides, 0.5);
  }
  return world;
}

// The paths of a crowd's members bend from half a step before they are struck on; what comes from exact
// contact, by short steps, had no such step to bend in, so that the others bent into it: by 1.23 mm in the
// second of these, the only one of 2,000.
TEST(ExactWorldCrowdOverlap, keepsApartFromWhatSlidesBeforeIt) {
  double deepest = 0;
  for (int scene = 1861; scene < 1900; ++scene) {
    const World world = stacksBeforeASlide(test::Dice(static_cast<std::uint64_t>(scene)));
    deepest = std::max(deepest, deepestOverlap(world, crowdRun(world, 0.2, kTolerance, 2), 0.2, 0.0002));
  }
  RecordProperty("deepest", std::to_string(deepest));
  EXPECT_LT(deepest, 3 * kTolerance);  // measured 3.0e-4
}

// It joins at the begin of the step in which it is met: were that taken again, up to where they meet, members
// would go another way in it. Its path as a member begins half a step before it joins: up to 14 mm before
// they meet, if it joins then.
TEST(ExactWorldCrowdOverlap, takesInWhatSlidesBeforeTheyMeet) {
  constexpr std::size_t kSlides = 2;
  constexpr double kHalfAStep = 0.015;  // [m]
  int before = 0;
  for (int scene = 0; scene < 40; ++scene) {
    World world = onARoughFloor(0.5);
    for (int layer = 0; layer < 2; ++layer) {
      world.bodies.push_back(ofMaterial(box("front" + std::to_string(layer), Vec3(0.2, 0.2, 0.2), 1,
                                            Vec3(0, 0, 0.2 + 0.4 * layer), Vec3(5, 0, 0)),
                                        0));
    }
    world.bodies.push_back(ofMaterial(
        box("slides", Vec3(0.2, 0.2, 0.2), 1, Vec3(0.6 + 0.0007 * scene, 0, 0.2), Vec3(1, 0, 0)), 0.5));
    const Recorded run = crowdRun(world, 0.2, kTolerance, 1);
    const auto& motions = run.motions[kSlides];
    const auto joins = std::find_if(motions.begin(), motions.end(), [](const auto& each) {
      return std::holds_alternative<CrowdStep>(each.second);
    });
    ASSERT_NE(joins, motions.end());
    const Pose slides = run.at(world, kSlides, joins->first).pose;  // a BoxAt only refers to its pose
    const Pose front = run.at(world, 0, joins->first).pose;
    const double gap =
        BoxAxes({slides, world.bodies[kSlides].halfExtents}, {front, world.bodies[0].halfExtents}).gap();
    before += gap > kHalfAStep ? 1 : 0;
  }
  EXPECT_GE(before, 30);  // measured 35
}

}  // namespace
}  // namespace careen
