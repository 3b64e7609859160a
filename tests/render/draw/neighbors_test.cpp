#include "render/draw/neighbors.h"

#include <gtest/gtest.h>

#include <vector>

namespace careen {
namespace {

const Vec3 kEye(3, -8, 6);

DrawnBox cubeAt(const Vec3& position, std::size_t body, double half = 0.5) {
  return {.pose = {.position = position}, .halfExtents = Vec3::Constant(half), .body = body};
}

std::vector<Neighbors::Entry> aboveFirst(const std::vector<DrawnBox>& boxes, double least) {
  const std::vector<DrawnFace> faces = facesTowards(boxes, kEye, 1e-3);
  const Neighbors neighbors = neighborsOf(boxes, faces, least);
  EXPECT_EQ(neighbors.begins.size(), faces.size() + 1);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].box == 0 && faces[i].side == 4) {
      return {neighbors.of(i).begin(), neighbors.of(i).end()};
    }
  }
  ADD_FAILURE();
  return {};
}

TEST(Neighbors, areInFrontOfTheFaceAndNear) {
  EXPECT_EQ(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0.8, 0, 1.2), 1)}, 0.02).size(), 1U);
  EXPECT_TRUE(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(1.1, 0, 0), 1)}, 0.02).empty());   // level
  EXPECT_TRUE(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, -1.2), 1)}, 0.02).empty());  // below
  EXPECT_TRUE(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, 30), 1)}, 0.02).empty());    // far
}

TEST(Neighbors, ofCopiesOfABodyOnlyOneCounts) {
  const std::vector<DrawnBox> boxes = {cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, 2), 1),
                                       cubeAt(Vec3(0, 0, 1.5), 1), cubeAt(Vec3(0, 0, 1.2), 0)};
  const std::vector<Neighbors::Entry> found = aboveFirst(boxes, 0.02);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].box, 2U);  // the one that covers most, and not the copy of the box itself
}

// A box that leaves the list, because it goes away or because others come nearer, has lost its weight before.
TEST(Neighbors, weightsFallBeforeABoxLeaves) {
  double last = 1;
  for (double away = 1.2; last > 0; away += 0.01) {
    const std::vector<Neighbors::Entry> found =
        aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, away), 1)}, 0.05);
    const double weight = found.empty() ? 0 : found[0].weight;
    EXPECT_LE(weight, last);
    EXPECT_LT(last - weight, 0.1) << away;
    last = weight;
    ASSERT_LT(away, 20);
  }
  std::vector<DrawnBox> boxes = {cubeAt(Vec3::Zero(), 0)};
  for (std::size_t i = 1; i <= kMostNeighbors + 1; ++i) {
    boxes.push_back(cubeAt(Vec3(0, 0, 1 + 0.2 * static_cast<double>(i)), i, 0.1));
  }
  const std::vector<Neighbors::Entry> found = aboveFirst(boxes, 1e-4);
  ASSERT_EQ(found.size(), kMostNeighbors);
  EXPECT_EQ(found.front().weight, 1);
  EXPECT_LT(found.back().weight, 1);
}

TEST(Neighbors, largestSilhouetteOfACubeIsItsHexagon) {
  EXPECT_NEAR(largestSilhouette(cubeAt(Vec3::Zero(), 0)), std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace careen
