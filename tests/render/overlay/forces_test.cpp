#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using ForcesOverlay = OverlayPictures;

// It lies on the floor: four arrows upward, of a quarter of its weight each, which is the largest.
TEST_F(ForcesOverlay, areArrowsAtTheCornersThatBear) {
  scene_.gravity = Vec3(0, 0, -10);
  scene_.boxes[0] = boxAt(Vec3(0, 0, 0.2), Vec3(0.3, 0.3, 0.2));
  simulate();
  const std::vector<Stroke> found = arrows("forces", 0.5 * run_.settings.duration);
  ASSERT_EQ(found.size(), 4U);
  for (const Stroke& arrow : found) {
    const bool isNear = std::any_of(found.begin(), found.end(), [&](const Stroke& other) {
      return other.from.y() < arrow.from.y() - 1;  // farther is higher on the picture
    });
    const double depth = isNear ? 9.7 : 10.3;
    EXPECT_NEAR(std::fabs(arrow.from.x() - 640), kPixels * 10 * 0.3 / depth, 1e-6);
    EXPECT_NEAR(arrow.to.x(), arrow.from.x(), 1);
    EXPECT_NEAR(arrow.from.y() - arrow.to.y(), 0.2 * kHeight, 2);
  }
}

TEST_F(ForcesOverlay, areNoneInFlight) {
  fall();
  EXPECT_LE(only<Stroke>(shapesAt("forces", 0.01)).size(), 1U);  // the legend's
}

}  // namespace
}  // namespace careen
