#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using VelocityOverlay = OverlayPictures;

TEST_F(VelocityOverlay, velocityPointsWhereTheBoxGoes) {
  const std::vector<Stroke> found = arrows("velocity", 0.5);
  ASSERT_EQ(found.size(), 1U);
  expectNear(found[0].from, onPicture(Vec3(0.5, 0, 1.25)));
  // The film's largest speed, at right angles to the line of sight: the longest arrow.
  expectNear(found[0].to - found[0].from, 0.2 * kHeight * Vec2(1, -0.5).normalized());
}

}  // namespace
}  // namespace careen
