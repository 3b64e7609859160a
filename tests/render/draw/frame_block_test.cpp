#include "render/draw/frame_block.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace careen {
namespace {

// std140: a mat4 takes 64 bytes, a vec4 16, each at a multiple of 16; the shaders' block has them in this
// order.
TEST(FrameBlock, isLaidOutAsTheShadersReadIt) {
  EXPECT_EQ(offsetof(FrameBlock, clipFromOffset), 0U);
  EXPECT_EQ(offsetof(FrameBlock, towardsLight), 64U);
  EXPECT_EQ(offsetof(FrameBlock, finish), 176U);
  EXPECT_EQ(offsetof(FrameBlock, surfaceLook), 240U);
  EXPECT_EQ(offsetof(FrameBlock, occlusion), 256U);
  EXPECT_EQ(sizeof(FrameBlock), 272U);
}

TEST(FrameBlock, matricesGoColumnByColumn) {
  Mat4 matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix(row, column) = 10 * row + column;
    }
  }
  const Float16 values = floats(matrix);
  EXPECT_EQ(values[1], 10);  // row 1 of column 0
  EXPECT_EQ(values[4], 1);   // row 0 of column 1
  EXPECT_EQ(values[14], 23);
}

TEST(FrameBlock, vectorsTakeAFourthNumber) {
  EXPECT_EQ(floats(Vec3(1, 2, 3)), (Float4{1, 2, 3, 0}));
  EXPECT_EQ(floats(Vec3(1, 2, 3), 0.5), (Float4{1, 2, 3, 0.5F}));
}

}  // namespace
}  // namespace careen
