#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

class EffortsOverlay : public OverlayPictures {
 protected:
  // The crate, at (0.5, 0, 1.25) at 0.5 s, on a slider along x, whose motor pushes with 2 N from 0.25 s on
  // and pulls with 4 N from 0.75 s on.
  void drive() {
    Joint joint{.name = "rail", .kind = Joint::Kind::kSlider, .from = {}, .to = {}};
    joint.from.body = 0;
    joint.from.axes.col(2) = joint.to.axes.col(2) = Vec3::UnitX();
    joint.from.axes.col(0) = joint.to.axes.col(0) = -Vec3::UnitZ();
    scene_.joints = {joint};
    run_.jointEfforts = {{.time = 0.25, .joint = 0, .effort = 2}, {.time = 0.75, .joint = 0, .effort = -4}};
  }
};

// The largest is a fifth of the picture's height.
TEST_F(EffortsOverlay, areArrowsAlongTheAxisSinceTheLastSample) {
  drive();
  EXPECT_TRUE(arrows("efforts", 0.2).empty());
  const std::vector<Stroke> pushed = arrows("efforts", 0.5);
  ASSERT_EQ(pushed.size(), 1U);
  expectNear(pushed[0].from, onPicture(Vec3(0.5, 0, 1.25)));
  expectNear(pushed[0].to - pushed[0].from, Vec2(0.1 * kHeight, 0));
  const std::vector<Stroke> pulled = arrows("efforts", 0.8);
  expectNear(pulled[0].to - pulled[0].from, Vec2(-0.2 * kHeight, 0));
}

TEST_F(EffortsOverlay, withoutMotorsAreNone) { EXPECT_TRUE(only<Stroke>(shapesAt("efforts", 0.5)).empty()); }

}  // namespace
}  // namespace careen
