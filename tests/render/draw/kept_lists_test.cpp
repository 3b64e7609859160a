#include "render/draw/kept_lists.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace careen {
namespace {

constexpr double kPixelAngle = 0.001;
constexpr double kSpread = 0.03;
constexpr double kLeastSeen = 0.004;
const Vec3 kEyeOfLists(0, -12, 6);
const Vec3 kTowardsOfLists = Vec3(-0.5, -0.4, 1).normalized();

DrawnBox randomBox(std::mt19937& random, std::size_t shown) {
  std::uniform_real_distribution<double> place(-3, 3);
  std::uniform_real_distribution<double> size(0.1, 0.4);
  DrawnBox box;
  box.pose.position = Vec3(place(random), place(random), place(random));
  box.pose.worldFromBody =
      Quat(place(random), place(random), place(random), place(random)).normalized().toRotationMatrix();
  box.halfExtents = Vec3(size(random), size(random), size(random));
  box.shown = shown;
  return box;
}

std::vector<DrawnBox> randomBoxes(std::mt19937& random, std::size_t count) {
  std::vector<DrawnBox> boxes;
  while (boxes.size() < count) {
    boxes.push_back(randomBox(random, boxes.size()));
  }
  return boxes;
}

// Shots of boxes, with lists that are kept and lists that are not: how many faces were as before.
class Shots {
 public:
  std::size_t see(std::vector<DrawnBox> boxes, const Vec3& eye = kEyeOfLists) {
    sortFromEye(boxes, eye);
    const std::vector<DrawnFace> faces = facesTowards(boxes, eye, kPixelAngle);
    lists_.begin(boxes, faces, eye, kPixelAngle);
    LightPlane plane(kTowardsOfLists, boxes);
    const auto shadowsWith = [&](const KeptLists* kept) {
      return shadowsOnFaces(plane, boxes, faces, eye, kSpread, kPixelAngle, kept);
    };
    FaceShadows shadows = shadowsWith(&lists_);
    compare(shadows, shadowsWith(nullptr));
    FaceNeighbors neighbors = neighborsOf(boxes, faces, kLeastSeen, &lists_);
    compare(neighbors, neighborsOf(boxes, faces, kLeastSeen));
    std::size_t same = 0;
    for (std::size_t face = 0; face < faces.size(); ++face) {
      same += lists_.before(face) ? 1 : 0;
    }
    lists_.keep(std::move(shadows), std::move(neighbors));
    return same;
  }
  std::size_t changed() const { return lists_.changed().size(); }

 private:
  static void compare(const FaceShadows& kept, const FaceShadows& all) {
    EXPECT_EQ(kept.isDark, all.isDark);
    ASSERT_EQ(kept.pairs.size(), all.pairs.size());
    for (std::size_t i = 0; i < all.pairs.size(); ++i) {
      EXPECT_EQ(kept.pairs[i].face, all.pairs[i].face);
      EXPECT_EQ(kept.pairs[i].caster, all.pairs[i].caster);
      EXPECT_EQ(kept.pairs[i].weight, all.pairs[i].weight);
    }
  }
  static void compare(const FaceNeighbors& kept, const FaceNeighbors& all) {
    ASSERT_EQ(kept.lists.size(), all.lists.size());
    ASSERT_EQ(kept.entries.size(), all.entries.size());
    for (std::size_t i = 0; i < all.lists.size(); ++i) {
      EXPECT_EQ(kept.lists[i].begin, all.lists[i].begin);
      EXPECT_EQ(kept.lists[i].near, all.lists[i].near);
      EXPECT_EQ(kept.lists[i].far, all.lists[i].far);
      EXPECT_EQ(kept.lists[i].least, all.lists[i].least);
    }
    for (std::size_t i = 0; i < all.entries.size(); ++i) {
      EXPECT_EQ(kept.entries[i].box, all.entries[i].box);
      EXPECT_EQ(kept.entries[i].weight, all.entries[i].weight);
    }
  }

  KeptLists lists_;
};

// Of 10 boxes, whose lists have room for all others, and of 300, whose lists are full.
TEST(KeptLists, areThoseThatWouldBeFoundAnew) {
  for (const std::size_t count : {10U, 300U}) {
    std::mt19937 random(7);
    std::vector<DrawnBox> boxes = randomBoxes(random, count);
    Shots shots;
    EXPECT_EQ(shots.see(boxes), 0U);
    const std::size_t faces = shots.see(boxes);
    EXPECT_GE(faces, 2 * count);
    EXPECT_EQ(shots.changed(), 0U);
    for (int step = 0; step < 20; ++step) {
      const std::size_t moving = random() % count;
      boxes[moving] = randomBox(random, moving);
      const std::size_t same = shots.see(boxes);
      EXPECT_LT(same, faces + 30);
      EXPECT_GE(same, 2 * (count - 1));
      EXPECT_EQ(shots.changed(), 2U);  // as it was and as it is
    }
  }
}

TEST(KeptLists, boxesMayComeAndGo) {
  std::mt19937 random(11);
  std::vector<DrawnBox> boxes = randomBoxes(random, 60);
  Shots shots;
  shots.see(boxes);
  const DrawnBox last = boxes.back();
  boxes.pop_back();
  EXPECT_GT(shots.see(boxes), 100U);
  EXPECT_EQ(shots.changed(), 1U);
  boxes.push_back(last);
  EXPECT_GT(shots.see(boxes), 100U);
  EXPECT_EQ(shots.changed(), 1U);
}

TEST(KeptLists, nothingIsKeptFromElsewhereOrOfCopiesOrWhereMostHasChanged) {
  std::mt19937 random(13);
  std::vector<DrawnBox> boxes = randomBoxes(random, 40);
  Shots shots;
  shots.see(boxes);
  EXPECT_GT(shots.see(boxes), 0U);
  EXPECT_EQ(shots.see(boxes, kEyeOfLists + Vec3(0, 0, 1e-6)), 0U);
  EXPECT_EQ(shots.see(boxes), 0U);
  for (std::size_t i = 0; i < 20; ++i) {
    boxes[i] = randomBox(random, i);
  }
  EXPECT_EQ(shots.see(boxes), 0U);
  boxes[0].shown = 1;
  EXPECT_EQ(shots.see(boxes), 0U);
}

}  // namespace
}  // namespace careen
