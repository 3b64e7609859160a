#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "physics/exact/exact_world.h"
#include "support/article_equations.h"
#include "support/exact_runs.h"
#include "support/tumbling_box.h"

// Scenes that are their own mirror image or rotation: bodies meet edge on edge and corner on corner.

namespace careen {
namespace {

using test::Dice;

const double kRight = std::acos(-1.0) / 2;

// A cube of 1 m with an edge (or a corner) ahead along x.
Mat3 edgeAhead() { return axisAngle(Vec3::UnitZ(), kRight / 2); }
Mat3 cornerAhead() { return axisAngle(Vec3::UnitY(), std::atan(std::sqrt(0.5))) * edgeAhead(); }

World headOn(const Mat3& attitude, double restitution) {
  World world;
  for (const double side : {-1.0, 1.0}) {
    Body cube = box(side < 0 ? "left" : "right", Vec3(0.5, 0.5, 0.5), 1, Vec3(1.5 * side, 0, 0),
                    Vec3(-side, 0, 0), Vec3::Zero(), restitution);
    cube.initial.pose.worldFromBody = attitude;
    world.bodies.push_back(cube);
  }
  return world;
}

// Alike and head on: they exchange e times their velocities and do not turn. Without restitution the run ends
// at once: nothing is left to do.
TEST(ExactWorldSymmetry, edgesAndCornersHeadOnExchangeVelocities) {
  for (const Mat3& attitude : {edgeAhead(), cornerAhead()}) {
    for (const double restitution : {1.0, 0.5, 0.0}) {
      const World world = headOn(attitude, restitution);
      const Recorded run = runFor(world, 2);
      EXPECT_EQ(run.moments(), 1U);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(run.motions[i].size(), 8U);
        const BodyState end = run.last(world, i, 2);
        const Vec3 expected = -restitution * world.bodies[i].initial.velocity;
        EXPECT_NEAR((end.velocity - expected).norm(), 0, 1e-12);  // measured 4e-16
        EXPECT_NEAR(end.angularMomentum.norm(), 0, 1e-12);        // measured 1e-16
      }
    }
  }
}

// The scene is its own quarter turn: so is what happens. Each box is pushed by both neighbours alike, so
// every speed is e times what it was.
TEST(ExactWorldSymmetry, fourThatMeetEdgeOnEdgeLeaveAlike) {
  for (const double restitution : {1.0, 0.5, 0.0}) {
    World world;
    const std::array<Vec3, 4> ways = {Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitX(), -Vec3::UnitY()};
    for (const Vec3& way : ways) {
      Body each = box(std::string(1, static_cast<char>('a' + world.bodies.size())), Vec3(0.5, 0.5, 0.5), 1,
                      2 * way, -way, Vec3::Zero(), restitution);
      each.material.friction = 0.5;
      world.bodies.push_back(each);
    }
    const Recorded run = runFor(world, 3);
    for (std::size_t i = 0; i < 4; ++i) {
      const BodyState end = run.last(world, i, 3);
      // To rounding, not to the bit: which of four bodies in a ring is eliminated first breaks the symmetry.
      EXPECT_NEAR((end.velocity - restitution * ways.at(i)).norm(), 0, 1e-15) << restitution;
      EXPECT_NEAR(end.angularMomentum.norm(), 0, 1e-15) << restitution;
    }
  }
}

// A box that tumbles into its own mirror image meets it with a corner or an edge, at any attitude.
World intoItsImage(Dice& dice) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  const Vec3 half(dice.between(0.1, 0.4), dice.between(0.1, 0.4), dice.between(0.1, 0.4));
  const Vec3 position(-1, dice.between(-1, 1), 0);
  const Vec3 velocity(dice.between(1, 5), dice.between(-1, 1), dice.between(0, 3));
  const Vec3 spin = dice.vector(6);
  Body left = box("left", half, 1, position, velocity, Vec3::Zero(), dice.between(0.1, 1));
  left.material.friction = dice.between(-0.5, 1);
  left.material.friction = std::max(0.0, left.material.friction);
  left.initial.pose.worldFromBody = Quat(dice.orientation()).normalized().toRotationMatrix();
  left.initial.angularMomentum = angularMomentum(left.mass, left.initial.pose.worldFromBody, spin);
  Body right = left;
  right.name = "right";
  const Vec3 mirror(-1, 1, 1);
  right.initial.pose.position = mirror.cwiseProduct(position);
  right.initial.pose.worldFromBody =
      mirror.asDiagonal() * left.initial.pose.worldFromBody * mirror.asDiagonal();
  right.initial.velocity = mirror.cwiseProduct(velocity);
  right.initial.angularMomentum = -mirror.cwiseProduct(left.initial.angularMomentum);
  world.bodies = {left, right};
  return world;
}

bool everTouches(const Recorded& run) {
  return std::any_of(run.motions[0].begin(), run.motions[0].end(),
                     [](const auto& motion) { return std::holds_alternative<ContactStep>(motion.second); });
}

// Of contact that lasts, the forces are found by elimination, from one body on: symmetric to rounding only.
TEST(ExactWorldSymmetry, aBoxThatHitsItsImageMovesAsTheImageToTheBit) {
  Dice dice(71);
  const Vec3 mirror(-1, 1, 1);
  int impacts = 0;
  int lasting = 0;
  for (int k = 0; k < 300; ++k) {
    const World world = intoItsImage(dice);
    const double duration = 1;
    const Recorded run = runFor(world, duration);
    const BodyState left = run.last(world, 0, duration);
    const BodyState right = run.last(world, 1, duration);
    if (everTouches(run)) {
      ++lasting;
      ASSERT_NEAR((mirror.cwiseProduct(left.velocity) - right.velocity).norm(), 0, 1e-12) << k;
      continue;
    }
    ASSERT_EQ(Vec3(mirror.cwiseProduct(left.pose.position)), right.pose.position) << k;
    ASSERT_EQ(Vec3(mirror.cwiseProduct(left.velocity)), right.velocity) << k;
    ASSERT_EQ(Vec3(-mirror.cwiseProduct(left.angularMomentum)), right.angularMomentum) << k;
    for (const Impact& impact : run.impacts) {
      ASSERT_EQ(impact.normal.cwiseAbs(), Vec3(Vec3::UnitX())) << k;
      ASSERT_EQ(impact.point.x(), 0) << k;
      ++impacts;
    }
    World listed = world;
    std::swap(listed.bodies[0], listed.bodies[1]);
    const Recorded other = runFor(listed, duration);
    ASSERT_EQ(other.last(listed, 1, duration).velocity, left.velocity) << k;
    ASSERT_EQ(other.last(listed, 0, duration).angularMomentum, right.angularMomentum) << k;
  }
  EXPECT_GT(impacts, 250);
  EXPECT_LT(lasting, 10);  // measured 1
}

BodyState stateOf(const World& world, const Recorded& run, std::size_t body, double time) {
  const auto& motions = run.motions[body];
  const auto next =
      std::find_if(motions.begin(), motions.end(), [&](const auto& motion) { return motion.first > time; });
  const auto& [start, motion] = *(next - 1);
  return stateAt(motion, world.bodies[body].mass, time - start);
}

// Two cards of length L and thickness t that lean on each other's top edges at θ to the floor. About its
// foot, the corner below, a card's weight turns it at an arm of (L cos θ − t sin θ)/2; the other card's level
// push, at a height of L sin θ above the foot's corner, holds it. So the floor must give μ = arm / height.
struct Tent {
  double angle = 0;     // [rad] of the cards to the floor
  double friction = 0;  // of every pair
  static constexpr double kLength = 1;
  static constexpr double kThickness = 0.01;

  double threshold() const {
    return (std::cos(angle) * kLength - std::sin(angle) * kThickness) / (2 * std::sin(angle) * kLength);
  }
  World world() const {
    World world;
    world.gravity = Vec3(0, 0, -9.81);
    world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
    world.walls[0].material.friction = friction;
    const Vec3 half(kThickness / 2, 0.3, kLength / 2);
    const double lean = kRight - angle;
    const double across = half.z() * std::sin(lean) + half.x() * std::cos(lean);
    const double up = half.z() * std::cos(lean) + half.x() * std::sin(lean);
    for (const double side : {-1.0, 1.0}) {
      Body card = box(side < 0 ? "left" : "right", half, 0.1, Vec3(side * across, 0, up));
      card.material = {.restitution = 0, .friction = friction};
      card.initial.pose.worldFromBody =
          Quat(std::cos(lean / 2), 0, -side * std::sin(lean / 2), 0).toRotationMatrix();
      world.bodies.push_back(card);
    }
    return world;
  }
  bool stands() const {
    const World scene = world();
    const Recorded run = runFor(scene, 0.01);
    return run.impacts.empty() && std::all_of(run.motions.begin(), run.motions.end(), [](const auto& of) {
             return std::holds_alternative<Rest>(of.back().second);
           });
  }
};

TEST(ExactWorldSymmetry, tentsStandFromTheirFrictionOn) {
  for (const double degrees : {50.0, 65.0, 75.0, 80.0}) {
    Tent tent{.angle = degrees * kRight / 90};
    double slides = 0.5 * tent.threshold();
    double stands = 1.5 * tent.threshold();
    for (int k = 0; k < 40; ++k) {
      tent.friction = 0.5 * (slides + stands);
      (tent.stands() ? stands : slides) = tent.friction;
    }
    EXPECT_NEAR(stands, tent.threshold(), 1e-9) << degrees;  // measured 1.3e-10
  }
}

// Below it both feet slide out alike until the cards lie flat, and the top edges never part sideways.
TEST(ExactWorldSymmetry, tentsWithLessFrictionSlideApartAlike) {
  for (const double degrees : {50.0, 65.0, 75.0}) {
    Tent tent{.angle = degrees * kRight / 90};
    for (const double part : {0.0, 0.4, 0.9}) {
      tent.friction = part * tent.threshold();
      const World world = tent.world();
      const double duration = 2;
      const Recorded run = runFor(world, duration);
      for (double time = 0; time <= duration; time += 0.0625) {
        const std::array<BodyState, 2> cards = {stateOf(world, run, 0, time), stateOf(world, run, 1, time)};
        const Vec3 sum = cards[0].pose.position - Vec3(-1, 1, 1).cwiseProduct(cards[1].pose.position);
        ASSERT_NEAR(sum.x(), 0, 1e-12) << degrees << " " << part << " " << time;
        ASSERT_NEAR(sum.z(), 0, 1e-12) << degrees << " " << part << " " << time;
        ASSERT_NEAR(cards[0].angularMomentum.y(), -cards[1].angularMomentum.y(), 1e-12) << time;
      }
      EXPECT_NEAR(run.last(world, 0, duration).pose.position.z(), Tent::kThickness / 2, 1e-9);
    }
  }
}

// Cards of different lengths, one foot held by friction, the other almost free, the top edges rough: a hinge,
// for as long as it sticks, which turns each by another angle.
TEST(ExactWorldSymmetry, edgesThatStickAreAHinge) {
  Tent tent{.angle = 65 * kRight / 90, .friction = 1};
  World world = tent.world();
  world.bodies[0].material.friction = 4;
  Body& right = world.bodies[1];
  const Vec3 half(Tent::kThickness / 2, 0.3, 0.48);
  const double lean = std::acos(Tent::kLength / 2 * std::sin(tent.angle) / half.z());  // as high as the other
  right = box("right", half, 0.1,
              Vec3(half.z() * std::sin(lean) + half.x() * std::cos(lean), 0,
                   half.z() * std::cos(lean) + half.x() * std::sin(lean)));
  right.material = {.restitution = 0, .friction = 0.02};
  right.initial.pose.worldFromBody = Quat(std::cos(lean / 2), 0, -std::sin(lean / 2), 0).toRotationMatrix();
  const double duration = 0.4;
  const Recorded run = runFor(world, duration);
  EXPECT_TRUE(run.impacts.empty());
  EXPECT_LT(run.motions[0].size(), 20U);  // measured 6: no change of contact
  const auto top = [&](std::size_t card, double time) {
    const BodyState at = stateOf(world, run, card, time);
    const Vec3& of = world.bodies[card].halfExtents;
    const Vec3 edge((card == 0 ? 1 : -1) * of.x(), 0, of.z());
    return Vec3(at.pose.position + at.pose.worldFromBody * edge);
  };
  double apart = 0;
  for (const auto& [time, motion] : run.motions[0]) {
    apart = std::max(apart, (top(0, time) - top(1, time)).norm());
  }
  EXPECT_LT(apart, 1e-14);  // measured 1.1e-16
  EXPECT_LT(top(0, duration).z(), top(0, 0).z() - 0.005);
}

// A cube that strikes the edge of a fixed one from above while it passes it: without friction and restitution
// it keeps its level velocity, and leaves, since the edges fall away at 45° to both sides: a parabola.
TEST(ExactWorldSymmetry, edgesThatPassEachOtherPart) {
  for (const double side : {-1.0, 1.0}) {
    World world;
    world.gravity = Vec3(0, 0, -9.81);
    const Vec3 half(0.5, 0.5, 0.5);
    const double drop = 0.5;
    const double fall = std::sqrt(2 * drop / 9.81);
    const Vec3 slides(side, 0, 0);
    Body fixed = box("fixed", half, 1, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0);
    fixed.mass = immovable();
    Body above =
        box("above", half, 1, Vec3(0, 0, std::sqrt(2.0) + drop) - fall * slides, slides, Vec3::Zero(), 0);
    for (Body* each : {&fixed, &above}) {
      each->initial.pose.worldFromBody = axisAngle(Vec3::UnitY(), kRight / 2);
    }
    world.bodies = {fixed, above};
    const double after = 0.15;
    const Recorded run = runFor(world, fall + after);
    EXPECT_FALSE(run.impacts.empty());
    EXPECT_TRUE(std::none_of(run.motions[1].begin(), run.motions[1].end(), [](const auto& motion) {
      return std::holds_alternative<ContactStep>(motion.second);
    }));
    const BodyState end = run.last(world, 1, fall + after);
    EXPECT_NEAR((end.velocity - Vec3(side, 0, -9.81 * after)).norm(), 0, 1e-12);
    EXPECT_NEAR(end.angularMomentum.norm(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace careen
