#include "audit/flown.h"

#include <gtest/gtest.h>

#include "physics/motion/flight.h"
#include "physics/motion/motion.h"

namespace careen {
namespace {

// The motion of the method in closed form, by other code: measured 3e-9.
TEST(Flown, isTheFlightInClosedForm) {
  const MassProperties mass = solidBox({0.1, 0.2, 0.3}, 2);
  Flight flight;
  flight.position = Vec3(1, 2, 3);
  flight.velocity = Vec3(0.5, 0, -1);
  flight.acceleration = Vec3(0, 0, -9.81);
  flight.angularMomentum = angularMomentum(mass, Mat3::Identity(), Vec3(3, 0.2, -1));
  const BodyState start = stateAt(Motion(flight), mass, 0);
  for (const double seconds : {0.05, 0.4}) {
    const BodyState due = stateAt(Motion(flight), mass, seconds);
    const BodyState found = flown(mass, start, flight.acceleration, seconds);
    EXPECT_LT((found.pose.position - due.pose.position).norm(), 1e-14);
    EXPECT_LT((found.velocity - due.velocity).norm(), 1e-14);
    EXPECT_LT(turnBetween(found.pose.worldFromBody, due.pose.worldFromBody).norm(), 1e-7);
    const BodyState back = flown(mass, due, flight.acceleration, -seconds);
    EXPECT_LT(turnBetween(back.pose.worldFromBody, start.pose.worldFromBody).norm(), 1e-7);
  }
}

TEST(Flown, whatCannotMoveStays) {
  const BodyState there{.pose = {.position = Vec3(1, 2, 3)}};
  EXPECT_EQ(flown(immovable(), there, Vec3(0, 0, -9.81), 2).pose.position, there.pose.position);
}

TEST(Flown, turnsAreRotationVectors) {
  const Vec3 turn(0.3, -0.2, 0.4);
  const Mat3 from = Eigen::AngleAxisd(0.7, Vec3::UnitX()).toRotationMatrix();
  const Mat3 to = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * from;
  EXPECT_LT((turnBetween(from, to) - turn).norm(), 1e-15);
  EXPECT_EQ(turnBetween(from, from), Vec3::Zero());
}

TEST(Flown, pointsOfATurningBodyMove) {
  const MassProperties mass = solidBox(Vec3::Ones(), 3);
  const BodyState state{.velocity = Vec3(1, 0, 0),
                        .angularMomentum = angularMomentum(mass, Mat3::Identity(), Vec3(0, 0, 2))};
  EXPECT_LT((velocityAt(mass, state, Vec3(0, 1, 0)) - Vec3(-1, 0, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace careen
