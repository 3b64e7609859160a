#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using TrailOverlay = OverlayPictures;

// How strong a point of a trail is tells its time: there and then the corner was.
TEST_F(TrailOverlay, trailGoesThroughTheCornersPlaces) {
  scene_.settings.duration = 3;
  scene_.boxes[0].velocity = Vec3(2, 0.3, 1);
  scene_.boxes[0].angularVelocity = Vec3(3, 7, -2);
  simulate();
  ASSERT_FALSE(run_.impacts.empty());
  for (const double time : {0.4, 2.5}) {
    const std::vector<Ribbon> ribbons = only<Ribbon>(shapesAt("trail", time));
    ASSERT_EQ(ribbons.size(), 2U);  // its dark rim and itself
    for (const Ribbon& ribbon : ribbons) {
      EXPECT_GT(ribbon.points.size(), 40U);
      for (const RibbonPoint& point : ribbon.points) {
        const double then = std::max(0.0, time - (1 - point.strength) * kTrailSeconds);
        expectNear(point.at, onPicture(run_.state(0, then).pose.worldPoint(Vec3(0.5, 0.3, 0.2))), 1e-5);
      }
      EXPECT_NEAR(ribbon.points.front().strength, 1 - std::min(time, kTrailSeconds) / kTrailSeconds, 1e-12);
      EXPECT_EQ(ribbon.points.back().strength, 1);
    }
  }
}

TEST_F(TrailOverlay, whatRestsLeavesNoTrail) {
  run_ = drifting(scene_, Vec3::Zero());
  EXPECT_TRUE(shapesAt("trail", 0.7).empty());
}

}  // namespace
}  // namespace careen
