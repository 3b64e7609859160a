#include "physics/pile/body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"
#include "physics/attitude/torque_free_rotation.h"
#include "support/article_equations.h"
#include "support/pile_scenes.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

Body bodyOf(const BoxSpec& spec) { return makeBox(spec); }

double angleBetweenAxes(const Mat3& a, const Mat3& b) {
  return (a - b).norm() / std::sqrt(2.0);  // for small angles
}

TEST(PileBody, isTheBodyInItsState) {
  const Mat3 turned = axisAngle(Vec3(2, -1, 2) / 3, 0.7);
  const Body body = bodyOf({.halfExtents = {1, 2, 2},
                            .position = {5, 6, 7},
                            .worldFromBody = turned,
                            .velocity = {1, 2, 3},
                            .angularVelocity = {0.5, -1, 2}});
  const PileBody pile = pileBody(body, body.initial);
  EXPECT_EQ(pile.radius, 3);  // √(1 + 4 + 4)
  EXPECT_EQ(pile.length, 2);  // the smallest size
  EXPECT_FALSE(pile.held());
  EXPECT_FALSE(pile.still());
  EXPECT_LT((pile.omega - Vec3(0.5, -1, 2)).norm(), 1e-15);
  const BodyState state = stateOf(pile);
  EXPECT_EQ(state.pose.position, body.initial.pose.position);
  EXPECT_EQ(state.pose.worldFromBody, turned);
  EXPECT_EQ(state.velocity, body.initial.velocity);
  EXPECT_EQ(state.angularMomentum, body.initial.angularMomentum);
}

TEST(PileBody, thatIsHeldStands) {
  Body body = bodyOf({.velocity = {1, 2, 3}, .angularVelocity = {1, 1, 1}});
  body.mass = immovable();
  const PileBody pile = pileBody(body, body.initial);
  EXPECT_TRUE(pile.held());
  EXPECT_TRUE(pile.still());
  EXPECT_EQ(pile.velocity, Vec3::Zero());
  EXPECT_EQ(pile.angularMomentum, Vec3::Zero());
  EXPECT_EQ(pile.omega, Vec3::Zero());
}

struct Tumble {
  double error = 0;     // [rad] after 1 s, against the closed form
  double momentum = 0;  // relative change of L
  double length = 0;    // of the quaternion, off 1
};

Tumble tumbled(const Vec3& spin, int steps) {
  const Body body = bodyOf({.halfExtents = {0.1, 0.2, 0.3}, .angularVelocity = spin});
  const TorqueFreeRotation<double> truth(body.mass.inertiaBody, Quat::Identity(),
                                         body.initial.angularMomentum);
  PileBody pile = pileBody(body, body.initial);
  for (int k = 0; k < steps; ++k) {
    turnFree(pile, 1.0 / steps);
  }
  return {angleBetweenAxes(pile.axes, truth.worldFromBody(1).toRotationMatrix()),
          (pile.angularMomentum - body.initial.angularMomentum).norm(), std::fabs(pile.attitude.norm() - 1)};
}

// Local error O(h⁴): a third of the step has a 27th of the error, at least.
TEST(PileBody, turnsFreelyWithThirdOrder) {
  const Vec3 spin(1, 2, 3);
  const Tumble coarse = tumbled(spin, 30);
  const Tumble fine = tumbled(spin, 90);
  EXPECT_GT(std::log(coarse.error / fine.error) / std::log(3.0), 2.9);
  EXPECT_LT(fine.error, 1e-5);
  EXPECT_EQ(fine.momentum, 0);
  EXPECT_LT(fine.length, 1e-15);
}

// Beyond half a radian per step Strang's splitting takes over in steps of a quarter: of second order.
TEST(PileBody, survivesTurnsOfManyRadiansInOneStep) {
  const Vec3 spin(10, 20, 30);
  const Tumble one = tumbled(spin, 1);  // 37 rad
  EXPECT_LT(one.error, 0.2);
  EXPECT_EQ(one.momentum, 0);
  const Tumble wild = tumbled(1e5 * spin, 1);  // more than Strang's steps are allowed for: wrong, but finite
  EXPECT_LT(wild.length, 1e-15);
  EXPECT_TRUE(std::isfinite(wild.error));
}

// About a principal axis a free body turns steadily, and the exponential alone is seen: the first term left
// out of its cosine is (θ/2)¹⁰/10! = 2.2e-13.
TEST(PileBody, spinsAboutAnAxisSteadily) {
  for (int axis = 0; axis < 3; ++axis) {
    const Body body = bodyOf({.halfExtents = {0.1, 0.2, 0.3}, .angularVelocity = 0.49 * Vec3::Unit(axis)});
    PileBody pile = pileBody(body, body.initial);
    turnFree(pile, 1);
    EXPECT_LT((pile.axes - axisAngle(Vec3::Unit(axis), 0.49)).norm(), 4e-13) << axis;  // measured 1.3e-13
  }
}

TEST(PileBody, isTurnedByARotationVectorOfTheWorld) {
  test::Dice dice(4);
  for (int k = 0; k < 1000; ++k) {
    const Mat3 start = dice.orientation();
    const Body body = bodyOf({.worldFromBody = start, .angularVelocity = dice.vector(1)});
    PileBody pile = pileBody(body, body.initial);
    const Vec3 axis = dice.direction();
    const double angle = dice.between(0, 0.3);
    turnBy(pile, angle * axis);
    EXPECT_LT((pile.axes - axisAngle(axis, angle) * start).norm(), 4e-15);
    EXPECT_LT((pile.axes - pile.attitude.toRotationMatrix()).norm(), 1e-15);
    // ω follows L, which stays.
    EXPECT_EQ(pile.angularMomentum, body.initial.angularMomentum);
    BodyState state = body.initial;
    state.pose.worldFromBody = pile.axes;
    EXPECT_LT((pile.omega - angularVelocity(body.mass, state)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace careen
