#include "physics/pile/reached_contacts.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

// Three cubes of 1 m and 1000 kg on the floor, beside each other; none pushes yet.
struct ThreeOnTheFloor {
  ThreeOnTheFloor() : world(made()), stages(world), reached(stages.members, stages.contacts) {
    stages.members.begin();
    stages.meet(kCrowdStep);
    stages.impulses.find();
    moveMembers(stages.members, stages.loads, stages.impulses);
    reached.begin();
  }
  static World made() {
    World world = floorWorld({});
    world.gravity = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      world.bodies.push_back(
          crate(std::string(1, static_cast<char>('a' + k)), Vec3::Constant(0.5), Vec3(k, 0, 0.5), {}));
    }
    return world;
  }
  int slotBetween(int a, int b) const {
    for (const int slot : stages.contacts.near()) {
      const PileManifold& manifold = stages.contacts[slot];
      if ((manifold.a == a && manifold.b == b) || (manifold.a == b && manifold.b == a)) {
        return slot;
      }
    }
    return -1;
  }

  World world;
  CrowdStages stages;  // the floor has the first place
  ReachedContacts reached;
};

TEST(ReachedContacts, listsWhatImpulsesReachAndNothingElse) {
  ThreeOnTheFloor three;
  three.reached.strike(three.slotBetween(1, 0), 0, 1);
  EXPECT_EQ(three.reached.points().size(), 4U);  // of the manifold of the first one and the floor
  EXPECT_EQ(three.reached.bodies().size(), 1U);
  three.reached.push(three.reached[0], 1);
  std::vector<int> front;
  three.reached.findFront({}, front);
  EXPECT_EQ(front.size(), 8U);  // and of the second one beside it, which is reached, but not pushed
  EXPECT_EQ(three.reached.bodies().size(), 2U);
  three.reached.findFront({}, front);
  EXPECT_TRUE(front.empty());
}

// 1/m + (r × n)·I⁻¹(r × n) with I = m/6 about each axis: below a corner r × n = (±1/2, ±1/2, 0), so that
// 1/mass = 1/m (1 + 6/2), and an impulse of that mass changes the corner's normal speed by 1.
TEST(ReachedContacts, massBelowTheCornerOfACubeIsAQuarterOfIts) {
  ThreeOnTheFloor three;
  three.reached.strike(three.slotBetween(1, 0), 0, 1);
  const ReachedPoint& point = three.reached[0];
  EXPECT_NEAR(point.mass, 250, 1e-9);
  EXPECT_NEAR(three.reached.massAlong(point, 3 * point.normal, 3), 250, 1e-9);
  EXPECT_EQ(three.reached.speed(point), -1);
  three.reached.push(point, point.mass);
  EXPECT_NEAR(three.reached.speed(point), 0, 1e-12);
  ReachedContacts::Velocities none;
  three.reached.swap(point, none);
  EXPECT_EQ(three.reached.speed(point), -1);
}

// The second point is not solved again after the first sweep, in which nothing pushed its body.
TEST(ReachedContacts, sweepsSolveAgainOnlyWhatWasPushed) {
  ThreeOnTheFloor three;
  three.reached.strike(three.slotBetween(1, 0), 0, 1);
  three.reached.strike(three.slotBetween(3, 0), 0, 1);
  const std::vector<int> chosen{0, 4};
  int first = 0;
  int second = 0;
  int sweeps = 0;
  const auto solve = [&](const ReachedPoint& point) {
    return &point == &three.reached[0] ? (++first < 3 ? 1.0 : 0.0) : (++second, 0.0);
  };
  three.reached.sweep(chosen, 10, 0.5, solve, [&] { ++sweeps; });
  EXPECT_EQ(first, 3);
  EXPECT_EQ(second, 1);
  EXPECT_EQ(sweeps, 3);
}

}  // namespace
}  // namespace careen
