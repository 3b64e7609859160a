// Another run as outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

class Ghost : public testing::Test {
 protected:
  OverlayShapes shapesAt(double time) const {
    const Trajectory run = shownAs(scene_, run_);
    Overlays overlays(run, {}, 1.0 / 30, &ghost_);
    const View view = viewOf(*scene_.camera, extentOf(run), 16.0 / 9);
    const auto momentAt = [&](double filmTime) { return OverlayMoment{.sceneTime = filmTime, .view = view}; };
    return overlays.shapesAt(time, momentAt, kWidth, kHeight);
  }
  std::string textAt(double time) const {
    const std::vector<Label> labels = only<Label>(shapesAt(time));
    return labels.size() == 1 ? labels[0].text : std::to_string(labels.size()) + " labels";
  }

  Scene scene_ = roomStraightOn();
  Trajectory run_ = drifting(scene_, Vec3(1, 0, 0.5));
  Trajectory ghost_ = drifting(scene_, Vec3(1, 0, 0));
};

TEST_F(Ghost, isDrawnAsTheEdgesOfItsBox) {
  const std::vector<Stroke> strokes = only<Stroke>(shapesAt(0.5));
  ASSERT_EQ(strokes.size(), 13U);  // twelve edges and the way from centre to centre
  const Body& crate = run_.world.bodies[0];
  const Pose place = ghost_.state(0, 0.5).pose;
  for (std::size_t k = 0; k < 12; ++k) {
    for (const Vec2& end : {strokes[k].from, strokes[k].to}) {
      double nearest = 1e9;
      for (int index = 0; index < kCorners; ++index) {
        nearest =
            std::min(nearest, (onPicture(place.worldPoint(corner(crate.halfExtents, index))) - end).norm());
      }
      EXPECT_LT(nearest, 1e-6);
    }
    EXPECT_GT((strokes[k].to - strokes[k].from).norm(), 1);
  }
  EXPECT_LT((strokes[12].from - onPicture(run_.state(0, 0.5).pose.position)).norm(), 1e-6);
  EXPECT_LT((strokes[12].to - onPicture(place.position)).norm(), 1e-6);
}

// Seen straight on, the box shows one face: its four edges are in front, those of the sides too, as their
// faces are seen from the eye or hidden together with the back.
TEST_F(Ghost, edgesThatItsBoxWouldHideArePaler) {
  const std::vector<Stroke> strokes = only<Stroke>(shapesAt(0));
  std::size_t pale = 0;
  for (std::size_t k = 0; k < 12; ++k) {
    pale += strokes[k].ink.alpha < 1 ? 1U : 0U;
  }
  EXPECT_GE(pale, 3U);  // a box in general place hides three of its edges, one seen at a face up to eight
  EXPECT_LE(pale, 8U);
}

TEST_F(Ghost, theDistanceIsWritten) {
  EXPECT_EQ(textAt(0), "apart 0 m, 0°");
  EXPECT_EQ(textAt(0.5), "apart 0.25 m, 0°");
  ghost_.settings.duration = 0.4;
  EXPECT_EQ(textAt(0.5), "the other run has ended");
}

TEST_F(Ghost, boxesOfOtherNamesAreNotShown) {
  ghost_.world.bodies[0].name = "another";
  EXPECT_TRUE(only<Stroke>(shapesAt(0.5)).empty());
}

}  // namespace
}  // namespace careen
