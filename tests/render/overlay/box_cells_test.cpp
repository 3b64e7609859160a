#include "render/overlay/box_cells.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/stages.h"
#include "truth/ray_cast.h"
#include "view/camera.h"

namespace careen {
namespace {

constexpr int kCellsWidth = 480;  // with 360 rows a square is a pixel
constexpr int kCellsHeight = 360;

// Some boxes at all angles, one before the other; one around the eye, one behind it.
class BoxCellsTest : public testing::Test {
 protected:
  BoxCellsTest() {
    for (int i = 0; i < 12; ++i) {
      const Vec3 axis = Vec3(1 + i % 3, i % 5 - 2, 1 - i % 2).normalized();
      boxes_.push_back({.pose = {.position = Vec3(i % 4 - 1.5, 0.7 * i - 4, i % 3 - 1),
                                 .worldFromBody = Eigen::AngleAxisd(i, axis).toRotationMatrix()},
                        .halfExtents = Vec3(0.5, 0.3 + 0.05 * i, 0.4)});
    }
    boxes_.push_back({.pose = {.position = camera_.eye}, .halfExtents = Vec3(0.2, 0.2, 0.2)});
    boxes_.push_back({.pose = {.position = Vec3(0, -18, 0)}, .halfExtents = Vec3(1, 1, 1)});
    for (const CellBox& box : boxes_) {
      cast_.push_back({.pose = box.pose, .halfExtents = box.halfExtents});
    }
    seen_ = castRays(PixelRays(camera_, kCellsWidth, kCellsHeight), cast_, {});
  }
  std::int32_t boxAt(int x, int y) const {
    return seen_.instance[static_cast<std::size_t>(y) * kCellsWidth + static_cast<std::size_t>(x)] - 1;
  }

  Camera camera_ = cameraAt(Vec3(0, -12, 1), Vec3::Zero(), 40);
  Screen screen_{viewOf(camera_, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 4.0 / 3), kCellsWidth,
                 kCellsHeight};
  std::vector<CellBox> boxes_;
  std::vector<CastBox> cast_;
  CastPicture seen_;
};

TEST_F(BoxCellsTest, showWhatRaysMeet) {
  const BoxCells cells(screen_, boxes_);
  int sure = 0;
  int shown = 0;
  for (int y = 4; y < kCellsHeight - 4; ++y) {
    for (int x = 4; x < kCellsWidth - 4; ++x) {
      const std::int32_t box = boxAt(x, y);
      bool isAlone = true;
      for (int dy = -4; dy <= 4; ++dy) {
        for (int dx = -4; dx <= 4; ++dx) {
          isAlone = isAlone && boxAt(x + dx, y + dy) == box;
        }
      }
      const Vec2 at(x + 0.5, y + 0.5);
      sure += isAlone ? 1 : 0;
      shown += cells.showOnly(box, at) ? 1 : 0;
      EXPECT_TRUE(!isAlone || cells.showOnly(box, at)) << x << ' ' << y;
      EXPECT_FALSE(cells.showOnly(box + 1, at)) << x << ' ' << y;
    }
  }
  EXPECT_GT(sure, 30'000);
  EXPECT_LT(shown, kCellsWidth * kCellsHeight - 10'000);  // the squares at edges show nothing alone
}

// A cube fills 90 px of 360 about the middle, from 10 m away under 2 · atan(1/5).
TEST_F(BoxCellsTest, rectanglesAndLinesMayMeetOneBoxOnly) {
  const Camera straight = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 22.619864948040426);
  const Screen screen(viewOf(straight, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 4.0 / 3), kCellsWidth,
                      kCellsHeight);
  const CellBox cube{.pose = {}, .halfExtents = Vec3(0.5, 0.0001, 0.5)};
  const BoxCells cells(screen, {&cube, 1});
  const Vec2 middle(240, 180);
  EXPECT_TRUE(cells.showOnly(0, middle - Vec2(42, 42), middle + Vec2(42, 42)));
  EXPECT_FALSE(cells.showOnly(0, middle - Vec2(46, 42), middle + Vec2(42, 42)));
  EXPECT_FALSE(cells.showOnly(0, middle - Vec2(42, 42), middle + Vec2(42, 46)));
  EXPECT_TRUE(cells.showOnly(BoxCells::kNoBox, Vec2(2, 2), Vec2(190, 358)));
  EXPECT_FALSE(cells.showOnly(BoxCells::kNoBox, Vec2(2, 2), Vec2(200, 358)));
  EXPECT_FALSE(cells.showOnly(BoxCells::kNoBox, Vec2(-1, 2), Vec2(100, 100)));  // beyond the picture
  EXPECT_TRUE(cells.lineMeetsOnly(0, Vec2(10, 10), middle));
  EXPECT_TRUE(cells.lineMeetsOnly(1, Vec2(10, 10), Vec2(400, 20)));
  EXPECT_FALSE(cells.lineMeetsOnly(1, Vec2(10, 10), Vec2(470, 350)));
  EXPECT_FALSE(cells.lineMeetsOnly(0, Vec2(-10, 10), middle));
}

}  // namespace
}  // namespace careen
