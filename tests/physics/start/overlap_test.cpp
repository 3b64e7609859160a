#include "physics/start/overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

PlacedBox cube(const std::string& name, const Vec3& position, double mass = 1, double half = 0.5) {
  return {.name = name,
          .halfExtents = Vec3::Constant(half),
          .pose = {.position = position},
          .inverseMass = mass > 0 ? 1 / mass : 0};
}

Wall wall(const std::string& name, const Vec3& normal, double offset) {
  return {.name = name, .normal = normal, .offset = offset, .material = {}};
}

// Anywhere in a cube of the given edge, at any attitude.
std::vector<PlacedBox> heap(int count, double edge, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-edge / 2, edge / 2);
  std::uniform_real_distribution<double> size(0.2, 0.3);
  std::vector<PlacedBox> boxes;
  for (int k = 0; k < count; ++k) {
    PlacedBox box = cube("box-" + std::to_string(k), Vec3(within(random), within(random), within(random)),
                         1 + std::fabs(within(random)));
    box.halfExtents = Vec3(size(random), size(random), size(random));
    const Vec3 axis(within(random), within(random), within(random) + edge);
    box.pose.worldFromBody = Eigen::AngleAxisd(within(random), Vec3(axis / axis.norm())).toRotationMatrix();
    boxes.push_back(box);
  }
  return boxes;
}

double gapOf(const PlacedBox& a, const PlacedBox& b) { return BoxAxes(a.at(0), b.at(0)).gap(); }

std::vector<PlacedBox> movedTo(std::vector<PlacedBox> boxes, const Parted& parted) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].pose.position = parted.positions[i];
  }
  return boxes;
}

TEST(FirstOverlap, isTheFirstInTheOrderGiven) {
  int found = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<PlacedBox> boxes = heap(40, 4 + 0.2 * seed, seed);
    std::optional<Overlap> expected;
    for (std::size_t j = 1; j < boxes.size() && !expected; ++j) {
      for (std::size_t i = 0; i < j && !expected; ++i) {
        if (gapOf(boxes[i], boxes[j]) < -1e-9) {
          expected = {.first = i, .second = j, .depth = -gapOf(boxes[i], boxes[j])};
        }
      }
    }
    const std::optional<Overlap> overlap = firstOverlap(boxes);
    ASSERT_EQ(overlap.has_value(), expected.has_value());
    if (overlap) {
      ++found;
      EXPECT_EQ(overlap->first, expected->first);
      EXPECT_EQ(overlap->second, expected->second);
      EXPECT_EQ(overlap->depth, expected->depth);
    }
  }
  EXPECT_GT(found, 10);
}

TEST(FirstOverlap, leavesOutTwoThatAreHeld) {
  EXPECT_FALSE(firstOverlap(std::vector{cube("a", Vec3::Zero(), 0), cube("b", Vec3::Zero(), 0)}));
  EXPECT_TRUE(firstOverlap(std::vector{cube("a", Vec3::Zero(), 0), cube("b", Vec3::Zero(), 1)}));
}

// By 0.25 m along x: 3 kg by a quarter of that, 1 kg by three quarters.
TEST(FirstOverlap, leavesOutTwoThatPassThroughEachOther) {
  const std::vector<PlacedBox> boxes = {cube("a", {0, 0, 0}), cube("b", {0.9, 0, 0}), cube("c", {1.7, 0, 0})};
  const std::vector<std::pair<int, int>> apart = {{0, 1}};
  const std::optional<Overlap> found = firstOverlap(boxes, apart);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 1U);
  EXPECT_EQ(found->second, 2U);
  EXPECT_EQ(overlaps(boxes, apart).size(), 1U);
  const std::vector<std::pair<int, int>> all = {{0, 1}, {1, 2}};
  EXPECT_FALSE(firstOverlap(boxes, all));
}

// The second and third are 0.2 m in each other, and part by that; the first stays in the second.
TEST(MoveApart, leavesTwoInEachOtherThatPassThrough) {
  const std::vector<PlacedBox> boxes = {cube("a", {0, 0, 0}), cube("b", {0.9, 0, 0}), cube("c", {1.7, 0, 0})};
  const std::vector<std::pair<int, int>> apart = {{0, 1}};
  const Parted parted = moveApart(boxes, {}, Meeting::kAll, apart);
  EXPECT_EQ(parted.pairs, 1U);
  EXPECT_EQ(parted.positions[0], boxes[0].pose.position);
  EXPECT_NEAR(parted.positions[1].x(), 0.8, 1e-12);
  EXPECT_NEAR(parted.positions[2].x(), 1.8, 1e-12);
}

TEST(MoveApart, movesTwoAlongTheAxisOfLeastDepthTheLighterOneFurther) {
  const Parted parted =
      moveApart(std::vector{cube("a", Vec3(0, 0, 0), 3), cube("b", Vec3(0.75, 0.5, 0.25), 1)}, {});
  EXPECT_EQ(parted.pairs, 1U);
  EXPECT_EQ(parted.moved, 2U);
  EXPECT_NEAR(parted.furthest, 0.1875, 1e-13);
  EXPECT_NEAR((parted.positions[0] - Vec3(-0.0625, 0, 0)).norm(), 0, 1e-13);
  EXPECT_NEAR((parted.positions[1] - Vec3(0.9375, 0.5, 0.25)).norm(), 0, 1e-13);
}

TEST(MoveApart, leavesAloneWhatTouches) {
  const std::vector<Wall> floor = {wall("floor", Vec3::UnitZ(), 0)};
  const std::vector<PlacedBox> boxes = {cube("a", Vec3(0.1, 0, 0.5)), cube("b", Vec3(0.1, 0.2, 1.5))};
  const Parted parted = moveApart(boxes, floor);
  EXPECT_EQ(parted.pairs + parted.behindWalls + parted.moved, 0U);
  EXPECT_EQ(parted.positions[1], boxes[1].pose.position);
}

TEST(MoveApart, leavesWhatIsHeldWhereItIs) {
  const Parted parted =
      moveApart(std::vector{cube("a", Vec3(0, 0, 0), 0), cube("b", Vec3(0.75, 0.5, 0.25))}, {});
  EXPECT_EQ(parted.positions[0], Vec3(0, 0, 0));
  EXPECT_NEAR((parted.positions[1] - Vec3(1, 0.5, 0.25)).norm(), 0, 1e-13);
}

// Ten cubes, each 0.1 m too low for the one below: all of least movement push up from the floor.
TEST(MoveApart, liftsAStackOffTheFloor) {
  std::vector<PlacedBox> boxes;
  for (int k = 0; k < 10; ++k) {
    boxes.push_back(cube("box-" + std::to_string(k), Vec3(0, 0, 0.4 + 0.9 * k), k == 9 ? 1e4 : 1));
  }
  const std::vector<Wall> floor = {wall("floor", Vec3::UnitZ(), 0)};
  const Parted parted = moveApart(boxes, floor);
  EXPECT_EQ(parted.pairs, 9U);
  EXPECT_EQ(parted.behindWalls, 1U);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(parted.positions[k].z(), 0.5 + static_cast<double>(k), 1e-12);
    EXPECT_EQ(parted.positions[k].x(), 0);
  }
}

TEST(MoveApart, partsWhatStandsInOnePlace) {
  std::vector<PlacedBox> boxes;
  for (int k = 0; k < 5; ++k) {
    boxes.push_back(cube("box-" + std::to_string(k), Vec3(1, 2, 3)));
  }
  const Parted parted = moveApart(boxes, {});
  EXPECT_EQ(parted.pairs, 10U);
  EXPECT_FALSE(firstOverlap(movedTo(boxes, parted)));
  EXPECT_NEAR(parted.furthest, 2, 1e-12);  // they end in a row
}

// Down is the axis of least depth, and there is the floor.
TEST(MoveApart, takesTheNextAxisWhereTheFirstLeavesNoRoom) {
  const std::vector<Wall> floor = {wall("floor", Vec3::UnitZ(), 0)};
  const std::vector<PlacedBox> boxes = {cube("held", Vec3(0, 0, 1.4), 0), cube("under", Vec3(0.5, 0.1, 0.5))};
  const Parted parted = moveApart(boxes, floor);
  EXPECT_NEAR((parted.positions[1] - Vec3(1, 0.1, 0.5)).norm(), 0, 1e-12);
}

TEST(MoveApart, endsWithoutOverlapInAHeapWhateverTheOrder) {
  const std::vector<Wall> floor = {wall("floor", Vec3::UnitZ(), -1.25)};
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<PlacedBox> boxes = heap(60, 2.5, seed);
    const Parted parted = moveApart(boxes, floor);
    EXPECT_GT(parted.pairs, 5U);
    const std::vector<PlacedBox> after = movedTo(boxes, parted);
    EXPECT_FALSE(firstOverlap(after));
    for (const PlacedBox& box : after) {
      EXPECT_FALSE(lowestGap(floor[0], box).overlaps());
    }
    std::vector<PlacedBox> reversed(boxes.rbegin(), boxes.rend());
    Parted other = moveApart(reversed, floor);
    std::reverse(other.positions.begin(), other.positions.end());
    EXPECT_EQ(other.positions, parted.positions);
  }
}

// Of three in a row the middle one is pushed from both sides. Least Σ m d²: the outer ones go by the depth.
TEST(MoveApart, movesAsLittleAsCanBe) {
  const Parted parted = moveApart(
      std::vector{cube("a", Vec3(-0.75, 0, 0)), cube("b", Vec3(0, 0, 0)), cube("c", Vec3(0.75, 0, 0))}, {});
  EXPECT_NEAR(parted.positions[0].x(), -1, 1e-13);
  EXPECT_NEAR(parted.positions[1].x(), 0, 1e-13);
  EXPECT_NEAR(parted.positions[2].x(), 1, 1e-13);
}

std::string errorOf(const std::vector<PlacedBox>& boxes, const std::vector<Wall>& walls) {
  try {
    moveApart(boxes, walls);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MoveApart, namesThePairThatHasNoRoom) {
  const std::vector<Wall> slot = {wall("left", Vec3::UnitX(), 0), wall("right", -Vec3::UnitX(), -0.75)};
  const std::string error = errorOf({cube("wide", Vec3(0.25, 0, 0))}, slot);
  EXPECT_NE(error.find("box wide cannot be moved out of wall"), std::string::npos) << error;
  EXPECT_NE(error.find("there is no room for it, 0.25 m are missing"), std::string::npos) << error;
}

// Ten cubes in a shaft that is a millimetre too short, and as wide as they are: where it lacks is shared by
// them all.
TEST(MoveApart, tellsHowMuchRoomARowLacks) {
  std::vector<Wall> shaft = {wall("left", Vec3::UnitX(), 0), wall("right", -Vec3::UnitX(), -9.999)};
  for (const Vec3& side : {Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    shaft.push_back(wall("low" + std::to_string(shaft.size()), side, -0.5));
    shaft.push_back(wall("high" + std::to_string(shaft.size()), -side, -0.5));
  }
  std::vector<PlacedBox> boxes;
  for (int k = 0; k < 10; ++k) {
    boxes.push_back(cube("box-" + std::to_string(k), Vec3(0.5 + k, 0, 0)));
  }
  const std::string error = errorOf(boxes, shaft);
  EXPECT_NE(error.find(", 0.001 m are missing"), std::string::npos) << error;
}

// Cubes in a tower, each 0.1 m too low for the one below: to rounding, however long it is.
TEST(MoveApart, liftsAHighTower) {
  constexpr int kCount = 100;
  std::vector<PlacedBox> boxes;
  for (int k = 0; k < kCount; ++k) {
    boxes.push_back(cube("box-" + std::to_string(k), Vec3(0, 0, 0.5 + 0.9 * k), 1 + k % 3));
  }
  const Parted parted = moveApart(boxes, std::vector{wall("floor", Vec3::UnitZ(), 0)});
  for (int k = 0; k < kCount; ++k) {
    EXPECT_NEAR(parted.positions[static_cast<std::size_t>(k)].z(), 0.5 + k, 1e-10);
  }
}

// A bridge over a cube: their boxes overlap where the cube is under its foot, and nowhere else.
TEST(MoveApart, seesEachBoxOfABody) {
  PlacedBox bridge{.name = "bridge", .halfExtents = Vec3(1.5, 0.5, 1), .inverseMass = 1};
  bridge.parts = {{.halfExtents = Vec3(1.5, 0.5, 0.2), .center = Vec3(0, 0, 0.8)},
                  {.halfExtents = Vec3(0.25, 0.5, 0.8), .center = Vec3(-1.25, 0, -0.2)},
                  {.halfExtents = Vec3(0.25, 0.5, 0.8), .center = Vec3(1.25, 0, -0.2)}};
  EXPECT_FALSE(firstOverlap(std::vector{bridge, cube("under", Vec3(0.4, 0, -0.1))}));
  const std::vector<PlacedBox> deep{bridge, cube("under", Vec3(0.6, 0, -0.1))};
  const std::optional<Overlap> overlap = firstOverlap(deep);
  ASSERT_TRUE(overlap);
  EXPECT_NEAR(overlap->depth, 0.1, 1e-15);
  const Parted parted = moveApart(deep, {});
  EXPECT_EQ(parted.pairs, 1U);
  EXPECT_NEAR((parted.positions[1] - parted.positions[0]).x(), 0.5, 1e-12);
  EXPECT_NEAR(lowestGap(wall("floor", Vec3::UnitZ(), -1.2), bridge).gap, 0.2, 1e-15);
  // A cube that has sunk into the deck finds room, too.
  const std::vector<PlacedBox> low{bridge, cube("under", Vec3(0, 0, 0.2))};
  EXPECT_FALSE(firstOverlap(movedTo(low, moveApart(low, {}))));
}

}  // namespace
}  // namespace careen
