#include "physics/pile/belts.h"

#include <gtest/gtest.h>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

World onBeltOf(const SurfaceMotion& surface) {
  World world = floorWorld({.restitution = 0, .friction = 0.5, .surface = surface});
  world.bodies = {crate("crate", Vec3::Constant(0.25), Vec3(1, 2, 0.25), {.friction = 0.5})};
  return world;
}

// At each corner the body moves as the surface there: v + ω × x, the part along the floor. The crate is
// still, so the middle of the step is its beginning.
TEST(Belts, moveAsTheSurfaceAtEveryPointOfAFace) {
  const SurfaceMotion surface{.velocity = Vec3(1, -2, 0), .spin = Vec3(0, 0, 3)};
  const World world = onBeltOf(surface);
  CrowdStages stages(world);
  stages.meet(kCrowdStep);
  const PileManifold& manifold = stages.manifold();
  ASSERT_TRUE(isOnBelt(stages.members, manifold));
  ASSERT_EQ(manifold.count, 4);
  const ContactFrame& frame = manifold.frameOf(0);
  const Moving motion = motionOfBelt(stages.members, manifold, frame, manifold.points[0]);
  const Vec3 apart = stages.members.apart(manifold.a, manifold.b);
  for (int k = 0; k < 4; ++k) {
    const Vec3& arm = manifold.points[at(k)].world;
    const Vec3 point = Vec3(1, 2, 0.25) + arm;
    const Vec3 due = surface.velocity + surface.spin.cross(point);
    EXPECT_LT((motion.velocity + motion.omega.cross(arm + apart) - due).norm(), 1e-13);
  }
}

TEST(Belts, takeThePlaceOfWhatIsHeld) {
  const World world = onBeltOf({.velocity = Vec3(1, 0, 0)});
  CrowdStages stages(world);
  stages.meet(kCrowdStep);
  const BeltBlock block = bodiesOnBelt(stages.members, stages.manifold(), 77);
  EXPECT_EQ(block.a, static_cast<int>(stages.of(0)));
  EXPECT_EQ(block.b, 77);
}

// A step on a belt that is faster than friction can follow gives μ g h/2, as velocities are those of its
// middle; on one that is slower, its speed.
TEST(Belts, giveWhatFrictionCan) {
  for (const double speed : {10.0, 0.01}) {
    const World world = onBeltOf({.velocity = Vec3(speed, 0, 0)});
    CrowdStages stages(world);
    stages.take(kCrowdStep);
    const double most = 0.5 * 0.5 * kGravity * kCrowdStep;
    EXPECT_NEAR(stages.members[stages.of(0)].velocity.x(), std::min(speed, most),
                1e-3 * std::min(speed, most));
  }
}

TEST(Belts, ofStillFloorsThereAreNone) {
  const World world = onBeltOf({});
  CrowdStages stages(world);
  stages.meet(kCrowdStep);
  EXPECT_FALSE(isOnBelt(stages.members, stages.manifold()));
}

}  // namespace
}  // namespace careen
