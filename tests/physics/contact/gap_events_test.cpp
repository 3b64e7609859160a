#include "physics/contact/gap_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/touching_bodies.h"

namespace careen {
namespace {

constexpr double kNone = 1e-6;  // [m] gaps that count as none

// Event functions of a step from the state in which the bodies of a world are.
struct Events {
  explicit Events(World world, double h)
      : of(std::move(world)), contacts(of.group, kNone), events(of.group, kNone) {
    contacts.find(of.state, 0);
    events.list(contacts, of.state, h, 10);
    step = {.length = h, .start = of.state, .end = of.state};
  }
  double firstRoot() { return events.firstRoot({of.group, step}); }
  double firstDip() { return events.firstDip({of.group, step}); }

  GroupOf of;
  FoundContacts contacts;
  GapEvents events;
  GroupStep step;
};

// In h a point comes no farther than 2 h (v + 10 h).
TEST(GapEvents, areOfTheCornersThatMayReachTheFloor) {
  const World near = cubeAbove(0.1 + 0.05, Vec3(0, 0, -1));
  const World far = cubeAbove(1 + 0.2, Vec3(0, 0, -1));
  EXPECT_EQ(Events(near, 0.1).events.size(), 8U);
  EXPECT_EQ(Events(far, 0.1).events.size(), 0U);
  EXPECT_EQ(Events(far, 0.3).events.size(), 8U);
  // What rests on the floor keeps its law: only its upper corners may fall.
  EXPECT_EQ(Events(cubeAbove(0.1), 0.1).events.size(), 4U);
}

// z = 0.15 − t − 5 t²: corners reach the floor after 0.05 m, t = (√2 − 1)/10, and are then less than an
// eighth of 1 µm above it.
TEST(GapEvents, aFallingCornerMeetsTheFloorAtItsRoot) {
  Events fall(cubeAbove(0.15, Vec3(0, 0, -1)), 0.05);
  fall.step.end[0].position.z() = 0.15 - 0.05 - 5 * 0.0025;
  fall.step.end[0].velocity.z() = -1.5;
  const double root = (std::sqrt(2) - 1) / 10;
  EXPECT_LT(fall.firstRoot(), root + 1e-15);
  EXPECT_GT(fall.firstRoot(), root - 0.125e-6);
  fall.step.length = 0.04;  // before it
  fall.step.end[0].position.z() = 0.15 - 0.04 - 5 * 0.0016;
  fall.step.end[0].velocity.z() = -1.4;
  EXPECT_EQ(fall.firstRoot(), 0.04);
}

// z = z₀ + 5 (t − 0.1)²: down to z₀ halfway and up again.
World bouncing(double lowest) { return cubeAbove(lowest + 0.05, Vec3(0, 0, -1)); }
void bounce(GroupStep& step) { step.end[0].velocity = -step.start[0].velocity; }

TEST(GapEvents, aQuadraticThatDipsBelowZeroIsFound) {
  Events in(bouncing(0.1 - 1e-6), 0.2);
  bounce(in.step);
  EXPECT_EQ(in.firstRoot(), 0.2);  // it is open at both ends
  EXPECT_NEAR(in.firstDip(), 0.1, 1e-4);
  Events above(bouncing(0.1 + 1e-6), 0.2);
  bounce(above.step);
  EXPECT_EQ(above.firstDip(), 0);
}

// The lower edge of the first, along x, comes down on the upper edge of the second, along y.
World crossingEdges(double lowest) {
  const double reach = 0.1 * std::sqrt(2);
  World world;
  world.bodies.push_back(box("a", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 2 * reach + lowest + 0.05)));
  world.bodies.push_back(box("b", Vec3(0.1, 0.1, 0.1), 1, Vec3::Zero()));
  world.bodies[0].initial.velocity.z() = -1;
  world.bodies[0].initial.pose.worldFromBody = Eigen::AngleAxisd(M_PI / 4, Vec3::UnitX()).matrix();
  world.bodies[1].initial.pose.worldFromBody = Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY()).matrix();
  return world;
}

TEST(GapEvents, edgesThatPassAreSeenIfOneGoesIntoTheOther) {
  Events in(crossingEdges(-1e-6), 0.2);
  ASSERT_EQ(in.events.size(), 1U);
  bounce(in.step);
  EXPECT_NEAR(in.firstDip(), 0.1, 1e-4);
  Events above(crossingEdges(1e-6), 0.2);
  bounce(above.step);
  EXPECT_EQ(above.firstDip(), 0);
  // As deep, but beside it: 0.3 m along x the edge along y is out of reach.
  World beside = crossingEdges(-1e-6);
  beside.bodies[0].initial.pose.position.x() = 0.3;
  Events passing(beside, 0.2);
  bounce(passing.step);
  EXPECT_EQ(passing.firstDip(), 0);
}

// A corner on a face 0.4 m wide, 0.05 m before its end, at 1 m/s: it gets there after 0.05 s.
TEST(GapEvents, aContactLeavesItsFaceAtItsEnd) {
  World world;
  world.bodies.push_back(box("slider", Vec3(0.1, 0.1, 0.1), 1, Vec3(0.25, 0, 0.2), Vec3(1, 0, 0)));
  world.bodies.push_back(box("table", Vec3(0.4, 0.4, 0.1), 1, Vec3(0, 0, 0)));
  Events slide(world, 0.1);
  ASSERT_EQ(slide.contacts.features().size(), 4U);
  slide.step.end[0].position.x() += 0.1;
  EXPECT_NEAR(slide.firstRoot(), 0.05, 2e-7);
}

}  // namespace
}  // namespace careen
