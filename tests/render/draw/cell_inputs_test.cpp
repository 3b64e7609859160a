#include "render/draw/cell_inputs.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

constexpr int kWidth = 1280;  // a cell is 32 pixels wide and 30 high
constexpr int kHeight = 720;

// 10 m away the picture is 20 m high and 35.6 m wide: a pixel is 2.8 cm wide.
View inputsView() {
  const Camera camera{.eye = Vec3(0, -10, 0), .target = Vec3::Zero(), .up = Vec3::UnitZ(), .fovDegrees = 90};
  return viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 16.0 / 9);
}

// A square about the middle of the cell to the right of the picture's middle and above it.
std::vector<Vec3> smallSquare() {
  const Vec3 middle(16 * 20.0 / kHeight, 0, 15 * 20.0 / kHeight);
  return {middle + Vec3(-0.1, 0, -0.1), middle + Vec3(0.1, 0, -0.1), middle + Vec3(0.1, 0, 0.1),
          middle + Vec3(-0.1, 0, 0.1)};
}

PictureCells::Set changes(double reach, std::uint64_t before, std::uint64_t after) {
  CellInputs first(inputsView(), kWidth, kHeight);
  first.addEverywhere(7);
  first.add(smallSquare(), reach, before);
  CellInputs second(inputsView(), kWidth, kHeight);
  second.addEverywhere(7);
  second.add(smallSquare(), reach, after);
  return second.changedSince(first);
}

TEST(CellInputs, differWhereAPieceThatDiffersReaches) {
  EXPECT_EQ(changes(0, 1, 1).count(), 0U);
  // It is 3.6 pixels from the middle to each side.
  const PictureCells::Set one = changes(0, 1, 2);
  EXPECT_EQ(one.count(), 1U);
  EXPECT_TRUE(one[PictureCells::indexOf(20, 12)]);
  EXPECT_EQ(changes(10, 1, 2).count(), 1U);  // 14.6 pixels of 15, and one more for rounding
  EXPECT_EQ(changes(11, 1, 2).count(), 3U);
  EXPECT_EQ(changes(13, 1, 2).count(), 9U);
}

TEST(CellInputs, dependOnTheOrderOfPieces) {
  const auto inputs = [](std::uint64_t one, std::uint64_t other) {
    CellInputs result(inputsView(), kWidth, kHeight);
    const std::size_t place = result.add(smallSquare(), 0, one);
    result.addAt(place, other);
    return result;
  };
  EXPECT_EQ(inputs(1, 2).changedSince(inputs(1, 2)).count(), 0U);
  EXPECT_EQ(inputs(2, 1).changedSince(inputs(1, 2)).count(), 1U);
}

TEST(CellInputs, digestsKnowEveryNumberAndHowManyThereAre) {
  const std::vector<float> numbers = {1, 2, 3};
  const std::uint64_t all = digest(numbers);
  EXPECT_EQ(digest(std::vector<float>{1, 2, 3}), all);
  EXPECT_NE(digest(numbers, 1), all);
  EXPECT_NE(digest(std::vector<float>{1, 2, 3, 0}), all);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::vector<float> other = numbers;
    other[i] = -other[i];
    EXPECT_NE(digest(other), all) << i;
  }
  EXPECT_NE(digest(std::vector<float>{0}), digest(std::vector<float>{-0.0F}));
}

TEST(PieceVertices, trianglesAreThoseOfPiecesInTheCells) {
  CellInputs inputs(inputsView(), kWidth, kHeight);
  const std::vector<Vec3> left = {Vec3(-5, 0, 0), Vec3(-4, 0, 0), Vec3(-4, 0, 1)};
  PieceVertices pieces;
  pieces.add(inputs.add(smallSquare(), 0, 1), 4);
  pieces.add(inputs.add(left, 0, 2), 7);
  pieces.add(inputs.add(smallSquare(), 0, 3), 10);
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 2, 3, 4, 5, 6, 7, 8, 9};
  PictureCells::Set cells;
  EXPECT_TRUE(pieces.trianglesIn(triangles, inputs, cells).empty());
  cells.set(PictureCells::indexOf(20, 12));
  EXPECT_EQ(pieces.trianglesIn(triangles, inputs, cells),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 7, 8, 9}));
  cells.set();
  EXPECT_EQ(pieces.trianglesIn(triangles, inputs, cells), triangles);
}

}  // namespace
}  // namespace careen
