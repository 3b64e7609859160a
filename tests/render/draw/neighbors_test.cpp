#include "render/draw/neighbors.h"

#include <gtest/gtest.h>

#include <vector>

namespace careen {
namespace {

const Vec3 kEye(3, -8, 6);

DrawnBox cubeAt(const Vec3& position, std::size_t body, double half = 0.5) {
  return {.pose = {.position = position}, .halfExtents = Vec3::Constant(half), .shown = body};
}

struct Lists {
  std::vector<FaceNeighbors::Entry> near;
  std::vector<FaceNeighbors::Entry> far;
};

Lists aboveFirst(const std::vector<DrawnBox>& boxes, double least) {
  const std::vector<DrawnFace> faces = facesTowards(boxes, kEye, 1e-3);
  const FaceNeighbors neighbors = neighborsOf(boxes, faces, least);
  EXPECT_EQ(neighbors.lists.size(), faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].box == 0 && faces[i].side == 4) {
      return {.near = {neighbors.near(i).begin(), neighbors.near(i).end()},
              .far = {neighbors.far(i).begin(), neighbors.far(i).end()}};
    }
  }
  ADD_FAILURE();
  return {};
}

bool isEmpty(const Lists& lists) { return lists.near.empty() && lists.far.empty(); }

TEST(FaceNeighbors, areInFrontOfTheFaceAndNear) {
  EXPECT_EQ(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0.8, 0, 1.2), 1)}, 0.02).near.size(), 1U);
  EXPECT_EQ(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, 3), 1)}, 0.02).far.size(), 1U);
  EXPECT_TRUE(isEmpty(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(1.1, 0, 0), 1)}, 0.02)));   // level
  EXPECT_TRUE(isEmpty(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, -1.2), 1)}, 0.02)));  // below
  EXPECT_TRUE(isEmpty(aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, 30), 1)}, 0.02)));    // too far
}

TEST(FaceNeighbors, ofCopiesOfABodyOnlyOneCounts) {
  const std::vector<DrawnBox> boxes = {cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, 2), 1),
                                       cubeAt(Vec3(0, 0, 1.1), 1), cubeAt(Vec3(0, 0, 1.2), 0)};
  const Lists found = aboveFirst(boxes, 0.02);
  ASSERT_EQ(found.near.size(), 1U);
  EXPECT_EQ(found.near[0].box, 2U);  // the one that covers most, and not the copy of the box itself
  EXPECT_TRUE(found.far.empty());
}

// On its way from near to far a box loses as much weight in one list as it gains in the other.
TEST(FaceNeighbors, goFromNearToFarGradually) {
  double last = 1;
  for (double away = 1.1; away < 3; away += 0.01) {
    const Lists found = aboveFirst({cubeAt(Vec3::Zero(), 0), cubeAt(Vec3(0, 0, away), 1)}, 0.001);
    const double near = found.near.empty() ? 0 : found.near[0].weight;
    EXPECT_LE(near, last);
    EXPECT_LT(last - near, 0.05) << away;
    EXPECT_NEAR(near + (found.far.empty() ? 0 : found.far[0].weight), 1, 1e-12) << away;
    last = near;
  }
  EXPECT_EQ(last, 0);
}

// What is crowded out of a full list has lost its weight before.
TEST(FaceNeighbors, weightsFallBeforeABoxIsCrowdedOut) {
  std::vector<DrawnBox> boxes = {cubeAt(Vec3::Zero(), 0)};
  for (std::size_t i = 1; i <= kMostFar + 1; ++i) {
    boxes.push_back(cubeAt(Vec3(0, 0, 1 + 0.2 * static_cast<double>(i)), i, 0.1));
  }
  const Lists found = aboveFirst(boxes, 1e-5);
  ASSERT_EQ(found.far.size(), kMostFar);
  EXPECT_EQ(found.far.front().weight, 1);
  EXPECT_LT(found.far.back().weight, 0.3);
}

TEST(FaceNeighbors, largestSilhouetteOfACubeIsItsHexagon) {
  EXPECT_NEAR(largestSilhouette(cubeAt(Vec3::Zero(), 0)), std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace careen
