#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using SpinAxisOverlay = OverlayPictures;

TEST_F(SpinAxisOverlay, pointsAlongTheAngularVelocityWithALineBackwards) {
  std::get<EulerStep>(run_.tracks[0].segments.open()[0].motion).start.angularMomentum = Vec3(0, 0, 0.3);
  const std::vector<Stroke> spin = arrows("spin-axis", 0);
  ASSERT_EQ(spin.size(), 2U);  // backwards, then the arrow
  const Vec3 omega = angularVelocity(run_.world.bodies[0].mass, run_.state(0, 0));
  const Vec2 way = spin[1].to - spin[1].from;
  const Vec2 expected = onPicture(Vec3(0, 0, 1) + 1e-6 * omega) - onPicture(Vec3(0, 0, 1));
  EXPECT_NEAR(way.normalized().dot(expected.normalized()), 1, 1e-6);
  EXPECT_LT(way.dot(spin[0].to - spin[0].from), 0);
}

}  // namespace
}  // namespace careen
