#include "render/draw/picture_cells.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace careen {
namespace {

View straightOn() {
  const Camera camera{.eye = Vec3(0, -10, 0), .target = Vec3::Zero(), .up = Vec3::UnitZ(), .fovDegrees = 90};
  return viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 16.0 / 9);
}

TEST(PictureCells, areMarkedWhereAnOutlineMayBe) {
  PictureCells cells(straightOn());
  // 10 m away the picture is 20 m high and 35.6 m wide: a cell is 0.889 m wide and 0.833 m high.
  cells.mark({Vec3(1, 0, 1), Vec3(5, 0, 1), Vec3(5, 0, 5)});
  int count = 0;
  for (int row = 0; row < PictureCells::kRows; ++row) {
    for (int column = 0; column < PictureCells::kColumns; ++column) {
      count += cells.isMarked(column, row) ? 1 : 0;
    }
  }
  EXPECT_TRUE(cells.isMarked(24, 15));
  EXPECT_TRUE(cells.isMarked(21, 13));
  EXPECT_FALSE(cells.isMarked(21, 17));  // above the slanting edge
  EXPECT_FALSE(cells.isMarked(19, 13));
  EXPECT_LE(count, 26);
  EXPECT_GE(count, 16);
}

TEST(PictureCells, outlinesBesideTheEyeMarkAll) {
  PictureCells cells(straightOn());
  cells.mark({Vec3(1, 0, 1), Vec3(3, 0, 1), Vec3(3, -11, 4)});
  EXPECT_TRUE(cells.isMarked(0, 0));
  EXPECT_TRUE(cells.isMarked(PictureCells::kColumns - 1, PictureCells::kRows - 1));
}

// 10 m away a cell of 32 by 30 pixels is 0.889 m wide and 0.833 m high, and a pixel 2.8 cm.
TEST(PictureCells, areFilledWhereAnOutlineGoesAPixelBeyondThem) {
  const auto filled = [](double right, double beyond) {
    const double left = -beyond;
    const double top = 2 * 20.0 / 24 + beyond;
    return PictureCells::filledBy(
        straightOn(), {Vec3(left, 0, left), Vec3(right, 0, left), Vec3(right, 0, top), Vec3(left, 0, top)},
        1280, 720);
  };
  const double cell = 20.0 * 32 / 720;
  const PictureCells::Set six = filled(3 * cell + 0.03, 0.03);
  EXPECT_EQ(six.count(), 6U);
  EXPECT_TRUE(six[PictureCells::indexOf(20, 12)]);
  EXPECT_TRUE(six[PictureCells::indexOf(22, 13)]);
  EXPECT_EQ(filled(3 * cell + 0.02, 0.03).count(), 4U);
  EXPECT_EQ(filled(3 * cell + 0.03, 0.02).count(), 0U);
}

// A floor on which the camera stands: all that is below the horizon, as far as it is drawn.
TEST(PictureCells, areFilledByWhatGoesOnBehindTheEye) {
  const PictureCells::Set cells = PictureCells::filledBy(
      straightOn(), {Vec3(-900, -900, -1), Vec3(900, -900, -1), Vec3(900, 9, -1), Vec3(-900, 9, -1)}, 1280,
      720);
  // Its end, 19 m away, is 19 pixels below the middle.
  EXPECT_EQ(cells.count(), 11U * PictureCells::kColumns);
  EXPECT_TRUE(cells[PictureCells::indexOf(0, 0)]);
  EXPECT_FALSE(cells[PictureCells::indexOf(0, 11)]);
}

TEST(PictureCells, rectanglesHoldEachCellOnce) {
  PictureCells::Set cells;
  for (const auto& [column, row] : {std::pair(3, 4), {4, 4}, {3, 5}, {4, 5}, {9, 5}, {39, 23}}) {
    cells.set(PictureCells::indexOf(column, row));
  }
  int pixels = 0;
  for (const PixelRectangle& at : pixelsOf(cells, 1000, 500)) {
    pixels += (at.right - at.left) * (at.top - at.bottom);
  }
  // Columns end at whole pixels: all are 25 wide; rows 4, 5 and 23 begin at 83, 104 and 479.
  EXPECT_EQ(pixels, 50 * 21 + 50 * 21 + 25 * 21 + 25 * 21);
  EXPECT_TRUE(pixelsOf({}, 1000, 500).empty());
  cells.set();
  ASSERT_EQ(pixelsOf(cells, 1000, 500).size(), 1U);
  EXPECT_EQ(pixelsOf(cells, 1000, 500)[0].right, 1000);
}

}  // namespace
}  // namespace careen
