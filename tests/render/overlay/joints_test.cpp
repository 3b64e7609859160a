#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

// The crate is at (0.5, 0, 1.25) at 0.5 s.
class JointsOverlay : public OverlayPictures {
 protected:
  std::vector<Stroke> shown(Joint joint) {
    joint.name = "joint";
    joint.from.body = 0;
    scene_.joints = {joint};
    return only<Stroke>(shapesAt("joints", 0.5));
  }
  double halfDiagonal() const { return scene_.boxes[0].halfExtents.norm(); }
};

TEST_F(JointsOverlay, ballsAreDots) {
  const std::vector<Stroke> found = shown(
      {.name = "joint", .kind = Joint::Kind::kBall, .from = {.body = 0, .point = {0.25, 0, 0}}, .to = {}});
  ASSERT_EQ(found.size(), 1U);
  expectNear(found[0].from, onPicture(Vec3(0.5, 0, 1.25) + 0.25 * scene_.boxes[0].pose.worldFromBody.col(0)));
  EXPECT_EQ(found[0].from, found[0].to);
}

// Along z, half of the box's half diagonal to both sides.
TEST_F(JointsOverlay, hingesAreLinesAlongTheirAxis) {
  const std::vector<Stroke> found =
      shown({.name = "joint", .kind = Joint::Kind::kHinge, .from = {}, .to = {}});
  ASSERT_EQ(found.size(), 2U);
  expectNear(found[0].from, onPicture(Vec3(0.5, 0, 1.25 - 0.5 * halfDiagonal())));
  expectNear(found[0].to, onPicture(Vec3(0.5, 0, 1.25 + 0.5 * halfDiagonal())));
  EXPECT_EQ(found[1].from, found[1].to);
}

// From its lowest coordinate to its highest, or as far as the box is large.
TEST_F(JointsOverlay, slidersAreLinesFromStopToStop) {
  const std::vector<Stroke> found = shown({.name = "joint",
                                           .kind = Joint::Kind::kSlider,
                                           .from = {},
                                           .to = {.body = {}, .point = {0.5, 0, 1}},
                                           .lowest = 0,
                                           .highest = 0.25});
  ASSERT_EQ(found.size(), 2U);
  expectNear(found[0].from, onPicture(Vec3(0.5, 0, 1)));
  expectNear(found[0].to, onPicture(Vec3(0.5, 0, 1.25)));
}

TEST_F(JointsOverlay, ropesAreDashedWhereTheyAreSlack) {
  Joint rope{.name = "rope",
             .kind = Joint::Kind::kRope,
             .from = {},
             .to = {.body = {}, .point = {0.5, 0, 2}},
             .length = 0.75};
  const std::vector<Stroke> taut = shown(rope);
  ASSERT_EQ(taut.size(), 1U);
  expectNear(taut[0].from, onPicture(Vec3(0.5, 0, 1.25)));
  expectNear(taut[0].to, onPicture(Vec3(0.5, 0, 2)));
  rope.length = 1;
  const std::vector<Stroke> slack = shown(rope);
  ASSERT_EQ(slack.size(), 8U);
  expectNear(slack[0].from, onPicture(Vec3(0.5, 0, 1.25)));
  expectNear(slack[7].to, onPicture(Vec3(0.5, 0, 2)));
  rope.until = 0.25;  // it has let go
  EXPECT_TRUE(shown(rope).empty());
}

}  // namespace
}  // namespace careen
