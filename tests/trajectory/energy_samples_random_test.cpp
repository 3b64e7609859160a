// 50 random runs, each at 20 random moments: energies by other code, and what the columns add up to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/jointed.h"
#include "trajectory/energy_samples.h"

namespace careen {
namespace {

class RandomRun {
 public:
  explicit RandomRun(unsigned seed) : random_(seed), family_(seed % kFamilies) {}

  Trajectory run() {
    World world;
    const int count = 1 + static_cast<int>(random_() % 4);
    for (int i = 0; i < count; ++i) {
      add(world, i);
    }
    RunSettings settings{.duration = 1.5, .tolerance = 1e-8};
    if (family_ == kFloor || family_ == kCrowd) {
      world.gravity = Vec3(0, 0, -9.81);
      world.walls = {wall("floor", Vec3::UnitZ(), 0, real(0, 0.9))};
      world.walls[0].material.friction = real(0, 1);
      settings.tolerance = 1e-6;
      if (family_ == kCrowd) {
        settings.crowds.when = CrowdSettings::When::kAbove;
      }
    } else if (family_ == kSprings) {
      world.gravity = vector(5);
      world.drag = Drag{.linear = real(0, 0.5), .angular = real(0, 0.1)};
      addSprings(world);
    } else if (family_ == kJoints) {
      world.gravity = vector(5);
      addJoints(world);
    }
    return record(world, settings, "");
  }
  /// Whether all that is lost has a column of its own.
  bool isAllTold() const { return family_ == kThrown || family_ == kSprings || family_ == kJoints; }

 private:
  enum Family : unsigned { kThrown, kFloor, kSprings, kJoints, kCrowd };
  static constexpr unsigned kFamilies = 5;

  double real(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  Vec3 vector(double most) {
    const double x = real(-most, most);
    const double y = real(-most, most);
    return {x, y, real(-most, most)};
  }
  // Thrown at each other without weight; piled over the floor; else far apart.
  void add(World& world, int i) {
    const bool meet = family_ == kThrown;
    const bool fall = family_ == kFloor || family_ == kCrowd;
    const Vec3 place =
        fall ? Vec3(real(-0.2, 0.2), real(-0.2, 0.2), 0.8 + 1.2 * i) : Vec3((meet ? 2 : 20) * i, 0, 0);
    const Vec3 velocity = meet ? Vec3((i % 2 == 0 ? 2 : -2), real(-0.2, 0.2), real(-0.2, 0.2)) : vector(1);
    const Vec3 size(real(0.2, 0.5), real(0.2, 0.5), real(0.2, 0.5));
    world.bodies.push_back(
        box("b" + std::to_string(i), size, real(0.5, 3), place, velocity, vector(3), real(0.4, 1)));
    world.bodies.back().material.friction = real(0, 1);
  }
  void addSprings(World& world) {
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      Spring spring{.from = {.body = static_cast<int>(i), .point = vector(0.2)},
                    .to = {.body = {}, .point = world.bodies[i].initial.pose.position + Vec3(0, 0, 3)},
                    .stiffness = real(5, 50),
                    .damping = real(0, 2),
                    .restLength = real(1, 2)};
      if (i > 0) {
        spring.to = {.body = static_cast<int>(i) - 1, .point = vector(0.2)};
        spring.restLength = 20;
      }
      world.springs.push_back(spring);
    }
  }
  void addJoints(World& world) {
    world.control = Control{.period = 0.1};
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      Body& body = world.bodies[i];
      body.initial.velocity = Vec3::Zero();
      body.initial.angularMomentum = Vec3::Zero();
      const Vec3 axis = vector(1) + Vec3(0, 0, 1.5);
      const bool slides = random_() % 2 == 0;
      Joint& joint = test::join(world, slides ? Joint::Kind::kSlider : Joint::Kind::kHinge,
                                static_cast<int>(i), {}, body.initial.pose.position + vector(0.5), axis);
      joint.stiffness = real(0, 20);
      joint.damping = real(0, 2);
      joint.grip = random_() % 2 == 0 ? real(0, 1) : 0;
      joint.rest = real(-0.5, 0.5);
      world.control->motors.push_back({.joint = static_cast<int>(i),
                                       .target = {.amplitude = 1, .frequency = 1},
                                       .stiffness = 10,
                                       .damping = 0.5});
    }
  }

  std::mt19937 random_;
  unsigned family_;
};

// Σ ½ m v² + ½ Σ Lᵢ²/Iᵢ − m g·x in the body's own axes, and springs by the places of their ends.
double energyByHand(const World& world, const std::vector<BodyState>& states) {
  double energy = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const MassProperties& mass = world.bodies[i].mass;
    const Vec3 own = states[i].pose.worldFromBody.transpose() * states[i].angularMomentum;
    for (int k = 0; k < 3; ++k) {
      energy += own[k] * own[k] / (2 * mass.inertiaBody[k]) +
                mass.mass * states[i].velocity[k] * states[i].velocity[k] / 2 -
                mass.mass * world.gravity[k] * states[i].pose.position[k];
    }
  }
  const auto place = [&](const std::optional<int>& body, const Vec3& point) -> Vec3 {
    if (!body) {
      return point;
    }
    const Pose& pose = states[static_cast<std::size_t>(*body)].pose;
    return pose.position + pose.worldFromBody * point;
  };
  for (const Spring& spring : world.springs) {
    const double length =
        (place(spring.to.body, spring.to.point) - place(spring.from.body, spring.from.point)).norm();
    energy += spring.stiffness * (length - spring.restLength) * (length - spring.restLength) / 2;
  }
  for (const Joint& joint : world.joints) {  // each of one body and the world
    const Pose& pose = states[static_cast<std::size_t>(*joint.from.body)].pose;
    const Mat3 turned = joint.to.axes.transpose() * pose.worldFromBody * joint.from.axes;
    const double along = joint.to.axes.col(2).dot(place(joint.from.body, joint.from.point) - joint.to.point);
    double coordinate = joint.kind == Joint::Kind::kSlider ? along : std::atan2(turned(1, 0), turned(0, 0));
    if (joint.kind == Joint::Kind::kHinge) {  // at most half a turn from where its spring rests
      coordinate = joint.rest + std::remainder(coordinate - joint.rest, 2 * M_PI);
    }
    energy += joint.stiffness * (coordinate - joint.rest) * (coordinate - joint.rest) / 2;
  }
  return energy;
}

TEST(EnergySamples, ofRandomRunsAddUp) {
  std::size_t moments = 0;
  double worst = 0;
  double untold = 0;
  double lost = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomRun random(seed);
    const Trajectory run = random.run();
    std::vector<BodyState> initial;
    for (const Body& body : run.world.bodies) {
      initial.push_back(body.initial);
    }
    const double start = energyByHand(run.world, initial);
    std::mt19937 random2(seed);
    std::vector<double> times(20);
    std::generate(times.begin(), times.end(),
                  [&] { return std::uniform_real_distribution<double>(0, run.settings.duration)(random2); });
    std::sort(times.begin(), times.end());
    EnergySamples samples(run);
    for (const double time : times) {
      const RunEnergies now = samples.at(time);
      const double sum = energyByHand(run.world, run.states(time)) - now.motors + now.lost.impacts +
                         now.lost.jointFriction + now.lost.damping + now.lost.drag + now.remaining;
      const double scale = std::fabs(start) + now.shares.translation + now.shares.rotation +
                           std::fabs(now.shares.gravity) + now.shares.springs + now.shares.jointSprings;
      worst = std::max(worst, std::fabs(sum - start) / scale);
      EXPECT_GE(now.lost.damping, 0);
      EXPECT_GE(now.lost.drag, 0);
      EXPECT_GE(now.lost.impacts, -1e-9 * scale) << seed;
      if (random.isAllTold()) {
        untold = std::max(untold, std::fabs(now.remaining) / scale);
      }
      lost += now.lost.sum();
      ++moments;
    }
  }
  RecordProperty("worst", std::to_string(worst));
  std::printf("sum %.3g, untold %.3g\n", worst, untold);
  EXPECT_EQ(moments, 1000U);
  EXPECT_GT(lost, 100);
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(untold, 1e-6);
}

}  // namespace
}  // namespace careen
