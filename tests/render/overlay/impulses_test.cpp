#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using ImpulsesOverlay = OverlayPictures;

TEST_F(ImpulsesOverlay, impulseFadesAndVanishes) {
  strike(0.2, 3);
  strike(0.6, 1.5);
  EXPECT_TRUE(arrows("impulses", 0.199).empty());
  for (const double age : {0.0, 0.05, 0.2}) {
    const std::vector<Stroke> found = arrows("impulses", 0.2 + age);
    ASSERT_EQ(found.size(), 1U) << age;
    EXPECT_NEAR(found[0].ink.alpha, 1 - age / (kImpactFrames * kFrame), 1e-9);
    expectNear(found[0].from, onPicture(Vec3(1, 0, 1)));
    expectNear(found[0].to - found[0].from, Vec2(-0.2 * kHeight, 0));
  }
  EXPECT_TRUE(arrows("impulses", 0.2 + kImpactFrames * kFrame + 1e-9).empty());
  expectNear(arrows("impulses", 0.6)[0].to - arrows("impulses", 0.6)[0].from, Vec2(-0.1 * kHeight, 0));
}

TEST_F(ImpulsesOverlay, otherBoxGetsTheImpulseTheOtherWay) {
  strike(0.2, 3);
  scene_.boxes.push_back(boxAt(Vec3(1, 1, 1), Vec3(0.1, 0.1, 0.1)));
  run_.tracks.push_back({.segments = {{.start = 0, .motion = Rest{}}}});
  run_.impacts[0].b = Partner::ofBody(1);
  const std::vector<Stroke> found = arrows("impulses", 0.2);
  ASSERT_EQ(found.size(), 2U);
  expectNear(found[0].to - found[0].from, found[1].from - found[1].to);
}

}  // namespace
}  // namespace careen
