#include "render/draw/picture_cells.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace careen
