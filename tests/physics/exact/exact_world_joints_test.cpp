// Joints against closed forms, extended precision, and one whole box: errors beside what was measured.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "support/jointed.h"

namespace careen {
namespace {

using test::bar;
using test::energyIn;
using test::join;
using test::largestGapIn;
using test::parallelogram;
using test::pendulumAfter;
using test::squaredFrequencyOf;
using test::tie;
using Kind = Joint::Kind;

constexpr double kEarthsGravity = 9.81;

World swinging() {
  World world;
  world.gravity = Vec3(0, 0, -kEarthsGravity);
  return world;
}

// 2 rad from hanging: 8.1e-8 m off after 10 s, joint open by 5e-9 m.
TEST(ExactWorldJoints, aBarOnAHingeIsAPendulum) {
  World world = swinging();
  world.bodies = {bar("bar", 2)};
  join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
  const Recorded run = runFor(world, 10);
  const double angle = pendulumAfter(10, 2, 0, squaredFrequencyOf(world.bodies[0], kEarthsGravity))[0];
  const Vec3 truth(-0.5 * std::sin(angle), 0, -0.5 * std::cos(angle));
  EXPECT_LE((run.last(world, 0, 10).pose.position - truth).norm(), 3e-7);
  EXPECT_LE(largestGapIn(world, run, 10), 1e-8);
}

// 7.6e-9 m off after 20 s.
TEST(ExactWorldJoints, aParallelogramOfHingesIsAPendulum) {
  const double start = 0.9;
  const World world = parallelogram(start, swinging().gravity);
  const Recorded run = runFor(world, 20);
  // (2 I + m) θ'' = −(2 · ½ + 2) g sin θ, with I of a bar about its end and the bridge's m = 2.
  const long double inertia = 2 * (world.bodies[0].mass.inertiaBody[1] + 0.25L) + 2;
  const double angle = pendulumAfter(20, start, 0, 3 * kEarthsGravity / inertia)[0];
  const Vec3 truth(-std::sin(angle), 0, -std::cos(angle));
  EXPECT_LE((run.last(world, 2, 20).pose.position - truth).norm(), 3e-8);
  EXPECT_LE(largestGapIn(world, run, 20), 1e-8);
}

// On two rods of 1 m a box goes round without turning: 6.8e-7 m off after 20 s.
TEST(ExactWorldJoints, aBoxOnTwoRodsIsAPendulum) {
  World world = swinging();
  world.bodies = {box("box", Vec3(0.3, 0.1, 0.1), 1, Vec3(0.6, 0, -0.8))};
  tie(world, Kind::kRod, 0, Vec3(-0.3, 0, 0), Vec3(-0.3, 0, 0), 1);
  tie(world, Kind::kRod, 0, Vec3(0.3, 0, 0), Vec3(0.3, 0, 0), 1);
  const Recorded run = runFor(world, 20);
  const double angle = pendulumAfter(20, std::asin(0.6), 0, kEarthsGravity)[0];
  const Vec3 truth(std::sin(angle), 0, -std::cos(angle));
  EXPECT_LE((run.last(world, 0, 20).pose.position - truth).norm(), 2e-6);
}

// A box in halves, and whole.
World thrown(bool whole, const std::vector<Wall>& walls) {
  World world = swinging();
  world.walls = walls;
  const Mat3 attitude = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 middle(0, 0, 1.2);
  const Vec3 spin(3, -2, 4);
  const auto add = [&](const std::string& name, double halfLength, double mass, double at) {
    const Vec3 offset = attitude * Vec3(at, 0, 0);
    Body body = box(name, Vec3(halfLength, 0.2, 0.1), mass, middle + offset,
                    Vec3(1, 0.5, 2) + spin.cross(offset), Vec3::Zero(), 0.5);
    body.initial.pose.worldFromBody = attitude;
    body.initial.angularMomentum = angularMomentum(body.mass, attitude, spin);
    body.material.friction = 0.4;
    world.bodies.push_back(body);
  };
  if (whole) {
    add("whole", 0.4, 2, 0);
  } else {
    add("left", 0.2, 1, -0.2);
    add("right", 0.2, 1, 0.2);
    join(world, Kind::kFixed, 0, 1, middle);
  }
  return world;
}

// [m] The largest distance of the ends' corners at 101 moments.
double largestDifference(const std::vector<Wall>& walls, double duration) {
  const World one = thrown(true, walls);
  const World two = thrown(false, walls);
  const Recorded whole = runFor(one, duration);
  const Recorded halves = runFor(two, duration);
  double largest = 0;
  for (int k = 0; k <= 101; ++k) {
    const double time = duration * k / 101;
    const Pose pose = whole.at(one, 0, time).pose;
    for (const std::size_t half : {0U, 1U}) {
      const double sign = half == 0 ? -1 : 1;
      const Vec3 corner = halves.at(two, half, time).pose.worldPoint(Vec3(sign * 0.2, 0.2, 0.1));
      largest = std::max(largest, (pose.worldPoint(Vec3(sign * 0.4, 0.2, 0.1)) - corner).norm());
    }
  }
  return largest;
}

// 5.1e-8 m: what the free box does in closed form.
TEST(ExactWorldJoints, twoWeldedHalvesFlyAsOneBox) { EXPECT_LE(largestDifference({}, 1.5), 2e-7); }

// Nine rough impacts on the floor: 1.4e-7 m. Later halves have more points on an edge that lands than one
// box.
TEST(ExactWorldJoints, twoWeldedHalvesBounceAsOneBox) {
  Wall floor = wall("floor", Vec3::UnitZ(), 0, 0.5);
  floor.material.friction = 0.4;
  EXPECT_LE(largestDifference({floor}, 1.02), 5e-7);
}

// Ten links with a spin of their own, in flight: momenta and energy against those at the start.
TEST(ExactWorldJoints, aFreeChainKeepsItsMomentaAndItsEnergy) {
  World world = swinging();
  for (int i = 0; i < 10; ++i) {
    const Vec3 place(0.2 * i, 0, 0);
    const Vec3 spin(i % 2 == 0 ? 1 : -1, 2, 1);
    world.bodies.push_back(box(std::string("link ") + std::to_string(i), Vec3(0.1, 0.03, 0.03), 1, place,
                               Vec3(0, 0, 3) + Vec3(0, 2, 1).cross(place), spin));
  }
  for (int i = 0; i < 9; ++i) {
    join(world, Kind::kBall, i, i + 1, Vec3(0.2 * i + 0.1, 0, 0));
  }
  const double duration = 3;
  const Recorded run = runFor(world, duration);
  struct Sum {
    Vec3 momentum = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
  };
  const auto sumAt = [&](double time) {
    Sum sum;
    for (std::size_t i = 0; i < 10; ++i) {
      const BodyState state = run.at(world, i, time);
      // About the middle that the chain has at that moment.
      const Vec3 middle = Vec3(0.9, 0, 0) + time * Vec3(0, 0.9, 3 - 1.8) + 0.5 * time * time * world.gravity;
      sum.momentum += state.velocity - time * world.gravity;
      sum.angular += state.angularMomentum + (state.pose.position - middle).cross(state.velocity);
    }
    return sum;
  };
  const Sum start = sumAt(0);
  double momentum = 0;
  double angular = 0;
  double energy = 0;
  for (int k = 1; k <= 997; ++k) {
    const double time = duration * k / 997;
    const Sum now = sumAt(time);
    momentum = std::max(momentum, (now.momentum - start.momentum).norm());
    angular = std::max(angular, (now.angular - start.angular).norm());
    energy = std::max(energy, std::fabs(energyIn(world, run, time) - energyIn(world, run, 0)));
  }
  EXPECT_LE(momentum, 5e-11);                            // 6.2e-12
  EXPECT_LE(angular, 1e-8);                              // 2.6e-9
  EXPECT_LE(energy, 2e-8);                               // 5.1e-9
  EXPECT_LE(largestGapIn(world, run, duration), 1e-10);  // 1.6e-11
}

// A box falls until its rope of 1 m is taut, loses what it has along it, and swings on: 6.2e-8 m off 2.1 s
// later.
TEST(ExactWorldJoints, aRopeBecomesTautWhereItsLengthSays) {
  World world = swinging();
  world.bodies = {box("box", Vec3(0.1, 0.1, 0.1), 1, Vec3(0.5, 0, -0.3), Vec3::Zero(), Vec3::Zero(), 0)};
  tie(world, Kind::kRope, 0, Vec3::Zero(), Vec3::Zero(), 1);
  const double taut = std::sqrt(2 * (std::sqrt(0.75) - 0.3) / kEarthsGravity);
  const Recorded run = runFor(world, 2.5);
  ASSERT_EQ(run.passed.size(), 1U);
  EXPECT_NEAR(run.passed[0].time, taut, 1e-12);
  // Along the rope: (−½, 0, √¾) times what the fall has of it.
  const double impulse = kEarthsGravity * taut * std::sqrt(0.75);
  EXPECT_LE((run.passed[0].linear - impulse * Vec3(-0.5, 0, std::sqrt(0.75))).norm(), 1e-11);
  EXPECT_TRUE(run.passed[0].angular.isZero(1e-15));
  const double angle =
      pendulumAfter(2.5 - taut, std::asin(0.5L), -kEarthsGravity * taut * 0.5L, kEarthsGravity)[0];
  const Vec3 truth(std::sin(angle), 0, -std::cos(angle));
  EXPECT_LE((run.last(world, 0, 2.5).pose.position - truth).norm(), 2e-7);
}

// Hops, each half as high in speed as the last, that end at a moment: to the last, then rest.
TEST(ExactWorldJoints, aBoxDroppedOnItsRopeComesToRest) {
  World world = swinging();
  world.bodies = {box("box", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, -0.3))};
  tie(world, Kind::kRope, 0, Vec3(0, 0, 0.1), Vec3::Zero(), 0.5).restitution = 0.5;
  const Recorded run = runFor(world, 2);
  const double fall = std::sqrt(2 * 0.3 / kEarthsGravity);
  EXPECT_NEAR(run.motions[0].back().first, 3 * fall, 1e-6);  // 5.2e-7: hops lower than rounding are left out
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.z(), -0.6, 1e-12);
}

// Down its rail to an end with e = ½, like a ball on a floor.
TEST(ExactWorldJoints, aSliderBouncesAtItsEnd) {
  World world = swinging();
  const Vec3 axis(std::cos(0.5), 0, std::sin(0.5));
  world.bodies = {box("slide", Vec3(0.1, 0.1, 0.1), 1, Vec3::Zero())};
  Joint& rail = join(world, Kind::kSlider, 0, {}, Vec3(0, 0, 0.1), axis);
  rail.lowest = -1;
  rail.restitution = 0.5;
  const double pull = kEarthsGravity * std::sin(0.5);
  const double fall = std::sqrt(2 / pull);
  const Recorded run = runFor(world, 3);
  const double hop = fall + 0.3 * fall;  // of the first hop's ½ · 2 fall
  const double way = -1 + 0.5 * pull * fall * (hop - fall) - 0.5 * pull * (hop - fall) * (hop - fall);
  EXPECT_LE((run.at(world, 0, hop).pose.position - way * axis).norm(), 1e-7);  // 1.6e-8
  EXPECT_LE((run.last(world, 0, 3).pose.position + axis).norm(), 1e-9);
  EXPECT_LE(largestGapIn(world, run, 3), 5e-9);  // 1.0e-9
}

// A bar whose limit is where it would hang: it strikes it first after a quarter of a swing.
TEST(ExactWorldJoints, aHingeBouncesAtItsLimit) {
  World world = swinging();
  world.bodies = {bar("bar", -1.5)};
  Joint& hinge = join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
  hinge.highest = 1.5;
  hinge.restitution = 0.5;
  const Recorded run = runFor(world, 1);
  ASSERT_GE(run.passed.size(), 1U);
  const double first = run.passed[0].time;
  const auto [angle, rate] =
      pendulumAfter(first, 1.5, 0, squaredFrequencyOf(world.bodies[0], kEarthsGravity));
  EXPECT_NEAR(angle, 0, 1e-7);  // 2.1e-8
  const double after =
      pendulumAfter(1 - first, 0, -0.5L * rate, squaredFrequencyOf(world.bodies[0], kEarthsGravity))[0];
  const Vec3 truth(0.5 * std::sin(after), 0, -0.5 * std::cos(after));
  EXPECT_LE((run.last(world, 0, 1).pose.position - truth).norm(), 5e-8);  // 8.6e-9
}

// A box that hangs at rest falls from the moment at which its rope lets go.
TEST(ExactWorldJoints, aRopeLetsGo) {
  World world = swinging();
  world.bodies = {box("box", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, -1))};
  tie(world, Kind::kRope, 0, Vec3::Zero(), Vec3::Zero(), 1).until = 0.75;
  const Recorded run = runFor(world, 2);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0][1].second));
  EXPECT_EQ(run.at(world, 0, 0.75).pose.position.z(), -1);
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.z(), -1 - 0.5 * kEarthsGravity * 1.25 * 1.25, 1e-12);
}

// Five cubes on ten strings: the first transfers its swing to the last, and back, twice in 4.2 s.
TEST(ExactWorldJoints, aCradleOnStringsPassesItsSwingOn) {
  World world = swinging();
  for (int i = 0; i < 5; ++i) {
    const Vec3 from(0.1 * i, 0, 0);
    Body cube = box(std::string("cube ") + std::to_string(i), Vec3::Constant(0.05), 1, from + Vec3(0, 0, -1));
    if (i == 0) {
      cube.initial.pose.position = Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix() * Vec3(0, 0, -1);
    }
    world.bodies.push_back(cube);
    for (const double y : {-0.05, 0.05}) {
      tie(world, Kind::kRope, i, Vec3(0, y, 0), from + Vec3(0, y, 0), 1);
    }
  }
  const Recorded run = runFor(world, 4.2);
  std::set<double> strikes;  // what is left of joints' errors strikes in between, with 1e-9 N s
  for (const Impact& impact : run.impacts) {
    if (impact.impulse > 1e-6) {
      strikes.insert(impact.time);
    }
  }
  EXPECT_GE(strikes.size(), 4U);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_LE((run.last(world, i, 4.2).pose.position - Vec3(0.1 * static_cast<double>(i), 0, -1)).norm(),
              5e-9);  // 4.5e-10
  }
  EXPECT_NEAR(energyIn(world, run, 4.2), energyIn(world, run, 0), 1e-7);  // 2.6e-8
}

// The last of ten links 100 times as heavy as the others: open by 6.6e-8 m at most.
TEST(ExactWorldJoints, aHeavyEndDoesNotPullJointsOpen) {
  World world = swinging();
  for (int i = 0; i < 10; ++i) {
    world.bodies.push_back(box(std::string("link ") + std::to_string(i), Vec3(0.1, 0.03, 0.03),
                               i == 9 ? 100 : 1, Vec3(0.2 * i + 0.1, 0, 0)));
    join(world, Kind::kBall, i, i == 0 ? std::optional<int>() : i - 1, Vec3(0.2 * i, 0, 0));
  }
  const Recorded run = runFor(world, 1.5);
  EXPECT_LE(largestGapIn(world, run, 1.5), 2e-7);
  EXPECT_NEAR(energyIn(world, run, 1.5), energyIn(world, run, 0), 2e-5);  // 4.6e-6
}

// A chain of six drops on the floor.
World chainAbove(double (*mirror)(double) = [](double x) { return x; }) {
  World world = swinging();
  Wall floor = wall("floor", Vec3::UnitZ(), 0, 0);
  floor.material.friction = 0.5;
  world.walls = {floor};
  const Mat3 turned = Eigen::AngleAxisd(mirror(-0.5), Vec3::UnitY()).toRotationMatrix();
  for (int i = 0; i < 6; ++i) {
    Body link = box(std::string("link ") + std::to_string(i), Vec3(0.1, 0.03, 0.03), 1,
                    Vec3(0, 0, 0.3) + turned * Vec3(mirror(0.2 * i), 0, 0), Vec3::Zero(), Vec3::Zero(), 0);
    link.initial.pose.worldFromBody = turned;
    link.material.friction = 0.5;
    world.bodies.push_back(link);
  }
  for (int i = 0; i < 5; ++i) {
    join(world, Kind::kBall, i, i + 1, Vec3(0, 0, 0.3) + turned * Vec3(mirror(0.2 * i + 0.1), 0, 0));
  }
  return world;
}

TEST(ExactWorldJoints, aChainFallsOnTheFloorAndStaysWhole) {
  const World world = chainAbove();
  const Recorded run = runFor(world, 1);
  double deepest = 0;
  for (int k = 0; k <= 997; ++k) {
    for (std::size_t i = 0; i < 6; ++i) {
      for (int c = 0; c < kCorners; ++c) {
        const Vec3 at = run.at(world, i, k / 997.0).pose.worldPoint(corner(world.bodies[i].halfExtents, c));
        deepest = std::max(deepest, -at.z());
      }
    }
  }
  EXPECT_LE(deepest, 1e-7);                      // 2.1e-8
  EXPECT_LE(largestGapIn(world, run, 1), 5e-7);  // 1.3e-7
  EXPECT_LT(energyIn(world, run, 1), 0.5 * energyIn(world, run, 0));
}

TEST(ExactWorldJoints, mirroredAndListedBackwardsHaveTheSameBits) {
  const World world = chainAbove();
  World mirrored = chainAbove([](double x) { return -x; });
  World backwards = world;
  std::reverse(backwards.bodies.begin(), backwards.bodies.end());
  for (Joint& joint : backwards.joints) {
    joint.from.body = 5 - *joint.from.body;
    joint.to.body = 5 - *joint.to.body;
  }
  std::reverse(backwards.joints.begin(), backwards.joints.end());
  const Recorded run = runFor(world, 0.5);
  const Recorded other = runFor(mirrored, 0.5);
  const Recorded listed = runFor(backwards, 0.5);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 at = run.last(world, i, 0.5).pose.position;
    EXPECT_EQ(at, listed.last(backwards, 5 - i, 0.5).pose.position);
    EXPECT_EQ(at.x(), -other.last(mirrored, i, 0.5).pose.position.x());
    EXPECT_EQ(at.z(), other.last(mirrored, i, 0.5).pose.position.z());
  }
}

// Lengths four times as long, times twice: the same numbers but for their exponents.
TEST(ExactWorldJoints, inOtherUnitsHaveTheSameBits) {
  const World world = chainAbove();
  World larger = world;
  for (Body& body : larger.bodies) {
    body.halfExtents *= 4;
    body.mass = solidBox(body.halfExtents, body.mass.mass);
    body.initial.pose.position *= 4;
  }
  for (Joint& joint : larger.joints) {
    joint.from.point *= 4;
    joint.to.point *= 4;
  }
  const auto runOf = [](const World& of, double duration, double tolerance) {
    Recorded run;
    run.motions.resize(of.bodies.size());
    Notes notes(run);
    ExactWorld(of, {.duration = duration, .tolerance = tolerance}, notes).run({});
    return run;
  };
  const Recorded run = runOf(world, 0.5, 1e-6);
  const Recorded other = runOf(larger, 1, 4e-6);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(4 * run.last(world, i, 0.5).pose.position, other.last(larger, i, 1).pose.position);
  }
}

// Twenty links touch nothing: no crowd, however many are joined; the energy is that of the start to 3.5e-6 J.
TEST(ExactWorldJoints, aLongChainIsNoCrowd) {
  World world = swinging();
  for (int k = 0; k < 20; ++k) {
    world.bodies.push_back(
        box("link-" + std::to_string(k), Vec3(0.1, 0.02, 0.02), 1, Vec3(0.1 + 0.2 * k, 0, 0)));
    join(world, Kind::kBall, k, k == 0 ? std::nullopt : std::optional(k - 1), Vec3(0.2 * k, 0, 0));
  }
  for (int a = 0; a < 20; ++a) {
    for (int b = a + 1; b < 20; ++b) {
      world.apart.emplace_back(a, b);
    }
  }
  std::sort(world.apart.begin(), world.apart.end());
  const Recorded run = runFor(world, 1);
  EXPECT_FALSE(run.figures.boundedFrom.has_value());
  EXPECT_NEAR(energyIn(world, run, 1), energyIn(world, run, 0), 1e-5);
}

// A falling figure whose springs swing a limb at its limit, away, and back, with a gap that is open at both
// ends of a step. Where that was not looked at in between, the limit was passed by 2.4e-4 to 8.8e-4 rad.
TEST(ExactWorldJoints, limitsHoldWithinSteps) {
  const auto limb = [](World& world, Kind kind, const Vec3& at, const Vec3& axis, double lowest,
                       double highest) -> Joint& {
    Joint& joint = join(world, kind, static_cast<int>(world.joints.size()) + 1, 0, at, axis);
    joint.lowest = lowest;
    joint.highest = highest;
    return joint;
  };
  for (const double rest : {0.365, 0.366, 0.367}) {
    World world = swinging();
    const double z = 6.2;
    world.bodies = {box("torso", Vec3(0.186, 0.125, 0.129), 6.09, Vec3(-0.348, -0.0771, z)),
                    box("arm", Vec3(0.194, 0.0553, 0.0553), 1.35, Vec3(-0.728, -0.0771, z)),
                    box("head", Vec3(0.0476, 0.0476, 0.168), 1.33, Vec3(-0.348, -0.0771, 6.5)),
                    box("tail", Vec3(0.154, 0.0309, 0.0309), 0.77, Vec3(-0.0072, -0.0771, z)),
                    box("leg", Vec3(0.0572, 0.12, 0.0572), 0.773, Vec3(-0.348, -0.322, z))};
    for (Body& body : world.bodies) {
      body.initial.velocity = Vec3(0, 0, -9);
    }
    Joint& shoulder =
        limb(world, Kind::kHinge, Vec3(-0.534, -0.0771, z), Vec3(0.714, -0.508, 0.987), -1.36, 0.905);
    shoulder.restitution = 0.5;
    shoulder.stiffness = 9.85;
    shoulder.rest = 0.0297;
    limb(world, Kind::kFixed, Vec3(-0.348, -0.0771, 6.33), Vec3::UnitZ(), -Joint::kFree, Joint::kFree);
    limb(world, Kind::kBall, Vec3(-0.162, -0.0771, z), Vec3::UnitZ(), -Joint::kFree, Joint::kFree);
    Joint& hip = limb(world, Kind::kHinge, Vec3(-0.348, -0.202, z), Vec3(1.66, -0.432, 3.75), -0.444, 0.556);
    hip.stiffness = 9.6;
    hip.rest = rest;
    const Recorded run = runFor(world, 0.35);
    double highest = 0;
    for (int k = 0; k <= 997; ++k) {
      const double time = 0.35 * k / 997;
      highest =
          std::max(highest, jointCoordinate(hip, run.at(world, 4, time).pose, run.at(world, 0, time).pose));
    }
    EXPECT_LE(highest, 0.556 + 1e-6);
    EXPECT_GT(highest, 0.556 - 1e-4);
  }
}

}  // namespace
}  // namespace careen
