#include "physics/contact/kept_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/contact/joint_rows.h"
#include "support/jointed.h"
#include "support/touching_bodies.h"

namespace careen {
namespace {

// A bar that hangs from the origin and turns about y at 3 rad/s.
struct Swinging {
  Swinging() {
    world.gravity = Vec3(0, 0, -10);
    world.bodies = {test::bar("bar", 0.5)};
    test::join(world, Joint::Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
    Body& body = world.bodies[0];
    body.initial.angularMomentum = angularMomentum(body.mass, body.initial.pose.worldFromBody, kSpin);
    body.initial.velocity = kSpin.cross(body.initial.pose.position);
  }
  ContactSystem system() const {
    std::vector<TouchingBody> bodies = touching(world);
    bodies.push_back(touchingBody(nowhere()));
    ContactSystem made(world, bodies,
                       jointFeatures(world, 0, [](const JointEnd& end) { return end.body ? 0 : 1; }));
    made.closeAll();
    return made;
  }
  inline static const Vec3 kSpin{0, 3, 0};
  World world;
};

double speedIn(const std::vector<double>& y) { return Vec3(y[7], y[8], y[9]).norm(); }

TEST(KeptEnergy, ofASwingIsPutRightByItsSpeed) {
  const Swinging swinging;
  ContactSystem system = swinging.system();
  KeptEnergy kept(swinging.world, system);
  std::vector<double> y = system.pack();
  system.look(y);
  kept.begin(y);
  const double due = speedIn(y);
  for (std::size_t k = 7; k < 13; ++k) {
    y[k] *= 1 + 1e-5;
  }
  ASSERT_TRUE(kept.keep(y));
  EXPECT_NEAR(speedIn(y), due, 1e-15);
  EXPECT_NEAR(y[11], 3, 1e-14);
  EXPECT_FALSE(kept.keep(y));  // nothing is left to do
}

// ½ I ω² with I of a bar about its end, and m g times the height it lost.
TEST(KeptEnergy, isThatOfTurningAndHeight) {
  const Swinging swinging;
  ContactSystem system = swinging.system();
  KeptEnergy kept(swinging.world, system);
  std::vector<double> y = system.pack();
  system.look(y);
  kept.begin(y);
  y[2] -= 1e-4;
  ASSERT_TRUE(kept.keep(y));
  const double inertia = swinging.world.bodies[0].mass.inertiaBody[1] + 0.25;
  EXPECT_NEAR(0.5 * inertia * (y[11] * y[11] - 9), 10 * 1e-4, 1e-12);
}

TEST(KeptEnergy, isNotKeptWhereADamperTakesSome) {
  Swinging swinging;
  swinging.world.joints[0].damping = 0.1;
  ContactSystem system = swinging.system();
  KeptEnergy kept(swinging.world, system);
  std::vector<double> y = system.pack();
  system.look(y);
  kept.begin(y);
  y[8] += 1e-6;
  EXPECT_FALSE(kept.keep(y));
}

// Nearly at rest no speed could make up for it.
TEST(KeptEnergy, isLeftWhereHardlyAnythingMoves) {
  Swinging swinging;
  swinging.world.bodies[0].initial.velocity.setZero();
  swinging.world.bodies[0].initial.angularMomentum.setZero();
  ContactSystem system = swinging.system();
  KeptEnergy kept(swinging.world, system);
  std::vector<double> y = system.pack();
  system.look(y);
  kept.begin(y);
  y[2] += 1e-6;
  EXPECT_FALSE(kept.keep(y));
}

}  // namespace
}  // namespace careen
