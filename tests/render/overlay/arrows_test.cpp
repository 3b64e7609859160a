#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using Arrows = OverlayPictures;

// Arrows and trails of nearer boxes lie over those of farther ones, whatever the order of the boxes.
TEST_F(Arrows, whatIsNearerIsDrawnOverWhatIsBehind) {
  for (const bool isFarther : {true, false}) {
    scene_ = roomStraightOn();
    scene_.boxes.push_back(boxAt(Vec3(0.5, isFarther ? 1 : -1, 1), Vec3(0.1, 0.1, 0.1)));
    scene_.boxes.back().name = "other";
    run_ = drifting(scene_, Vec3(1, 0, 0.5));
    run_.tracks.push_back(run_.tracks[0]);
    std::get<EulerStep>(run_.tracks[1].segments.open()[0].motion).start.pose = scene_.boxes[1].pose;
    const Vec2 other = onPicture(scene_.boxes[1].pose.position);
    const std::vector<Stroke> found = arrows("velocity", 0);
    ASSERT_EQ(found.size(), 2U);
    expectNear(found[isFarther ? 0 : 1].from, other);
    const std::vector<Ribbon> trails = only<Ribbon>(shapesAt("trail", 1));
    ASSERT_EQ(trails.size(), 4U);
    const auto length = [](const Ribbon& ribbon) {
      return (ribbon.points.back().at - ribbon.points.front().at).norm();
    };
    EXPECT_LT(length(trails[0]), length(trails[3]));  // as seen in perspective
  }
}

// 2 px and less are not drawn: the longest arrow, of 10 m/s, has 144 px.
TEST_F(Arrows, whatIsTooShortToBeSeenIsNotDrawn) {
  scene_.boxes.push_back(boxAt(Vec3(2, 0, 1), Vec3(0.1, 0.1, 0.1)));
  for (const double speed : {2.1, 1.9}) {  // [px]
    run_ = drifting(scene_, Vec3(10, 0, 0));
    run_.tracks.push_back(run_.tracks[0]);
    std::get<EulerStep>(run_.tracks[1].segments.open()[0].motion).start.velocity =
        Vec3(10 * speed / 144, 0, 0);
    EXPECT_EQ(arrows("velocity", 0).size(), speed > 2 ? 2U : 1U);
  }
}

}  // namespace
}  // namespace careen
