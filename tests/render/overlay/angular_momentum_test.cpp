#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using AngularMomentumOverlay = OverlayPictures;

TEST_F(AngularMomentumOverlay, pointsAlongIt) {
  std::get<EulerStep>(run_.tracks[0].segments.open()[0].motion).start.angularMomentum = Vec3(0, 0, 0.3);
  const std::vector<Stroke> momentum = arrows("angular-momentum", 0);
  ASSERT_EQ(momentum.size(), 1U);
  expectNear(momentum[0].to - momentum[0].from, Vec2(0, -0.2 * kHeight), 1e-2);
}

}  // namespace
}  // namespace careen
