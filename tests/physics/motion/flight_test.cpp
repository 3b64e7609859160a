#include "physics/motion/flight.h"

#include <gtest/gtest.h>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

// x = 1 + 2t, z = 5 + 3t − 4t².
TEST(Flight, isAParabolaByHand) {
  const Flight flight{.position = {1, 0, 5}, .velocity = {2, 0, 3}, .acceleration = {0, 0, -8}};
  EXPECT_EQ(flight.positionAt(0), Vec3(1, 0, 5));
  EXPECT_EQ(flight.positionAt(0.5), Vec3(2, 0, 5.5));
  EXPECT_EQ(flight.positionAt(-1), Vec3(-1, 0, -2));
  EXPECT_EQ(flight.velocityAt(0.5), Vec3(2, 0, -1));
}

// x = 1 + 2t + t³, z = 5 + 3t − 4t².
TEST(Flight, isACubicByHand) {
  const Flight flight{
      .position = {1, 0, 5}, .velocity = {2, 0, 3}, .acceleration = {0, 0, -8}, .jerk = {6, 0, 0}};
  EXPECT_EQ(flight.positionAt(2), Vec3(13, 0, -5));
  EXPECT_EQ(flight.velocityAt(2), Vec3(14, 0, -13));
  EXPECT_EQ(flight.accelerationAt(2), Vec3(12, 0, -8));
}

TEST(Flight, isThatToARoundingOfItsTermsHoweverLongItLasts) {
  test::Dice dice(1);
  for (int k = 0; k < 1000; ++k) {
    const Flight flight{
        .position = dice.vector(10), .velocity = dice.vector(10), .acceleration = dice.vector(10)};
    const double t = dice.between(0, 1e6);
    const Vec3 position = flight.positionAt(t);
    const Vec3 velocity = flight.velocityAt(t);
    for (int i = 0; i < 3; ++i) {
      const Quad way = Quad(flight.velocity[i]) * t;
      const Quad bend = Quad(flight.acceleration[i]) * t * t / 2;
      const Quad size = abs(Quad(flight.position[i])) + abs(way) + abs(bend);
      EXPECT_LT(abs(Quad(position[i]) - (Quad(flight.position[i]) + way + bend)), Quad(4e-16) * size);
      const Quad gain = Quad(flight.acceleration[i]) * t;
      EXPECT_LT(abs(Quad(velocity[i]) - (Quad(flight.velocity[i]) + gain)), Quad(4e-16) * abs(gain) + 4e-15);
    }
  }
}

// Turned round at any moment it comes back the way it came.
TEST(Flight, comesBackWhenItsVelocityIsReversed) {
  const Flight out{.position = {1, 2, 3}, .velocity = {4, -5, 6}, .acceleration = {0, 0, -10}};
  const Flight back{
      .position = out.positionAt(2), .velocity = -out.velocityAt(2), .acceleration = out.acceleration};
  EXPECT_EQ(back.positionAt(2), out.position);
  EXPECT_EQ(back.velocityAt(2), -out.velocity);
}

}  // namespace
}  // namespace careen
