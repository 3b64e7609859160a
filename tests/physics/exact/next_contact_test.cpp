#include "physics/exact/next_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/math/rotation.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

/// A body, and a mover that flies from its initial state.
struct Flyer {
  explicit Flyer(const BoxSpec& spec, const Vec3& gravity = Vec3::Zero(), double start = 0, int rank = 0)
      : body(makeBox(spec)) {
    mover.body = &body;
    mover.rank = rank;
    mover.start = Instant(start);
    mover.motion = 5;
    mover.fly(body.initial, Quat(body.initial.pose.worldFromBody), gravity, Vec3::Zero());
  }
  Flyer(const Flyer&) = delete;
  Flyer& operator=(const Flyer&) = delete;

  Body body;
  Mover mover;
};

constexpr int kFirstWall = 7;  // rank

struct Walls {
  explicit Walls(std::vector<Wall> of) : walls(std::move(of)) {
    for (const Wall& wall : walls) {
      Mover& mover = movers.emplace_back();
      mover.body = &bodyOfWalls();
      mover.halfSpace = &wall;
      mover.rank = kFirstWall + static_cast<int>(movers.size()) - 1;
    }
  }
  Walls(const Walls&) = delete;
  Walls& operator=(const Walls&) = delete;

  std::vector<Wall> walls;
  std::vector<Mover> movers;
};

// Half sizes 0.2, walls at ±4: (3.8 − 0)/2 s to the one at x = 4, wall 1; z = 4 would take 3.8 s.
TEST(NextContact, isWithTheWallThatIsReachedFirst) {
  const Flyer box({.velocity = {2, 0, 1}}, Vec3::Zero(), 0, 3);
  const Walls room(roomWalls(Vec3::Constant(-4), Vec3::Constant(4)));
  const std::optional<Event> event = firstWall(box.mover, room.movers, Instant(100));
  ASSERT_TRUE(event.has_value());
  EXPECT_NEAR(event->time.hi, 1.9, 1e-15);
  EXPECT_EQ(event->kind, EventKind::kContact);
  EXPECT_EQ(event->body, 3);
  EXPECT_EQ(event->partner, kFirstWall + 1);
}

TEST(NextContact, isNoneBeyondTheEnd) {
  const Flyer box({.velocity = {2, 0, 1}});
  const Walls room(roomWalls(Vec3::Constant(-4), Vec3::Constant(4)));
  EXPECT_FALSE(firstWall(box.mover, room.movers, Instant(1.8)).has_value());
  EXPECT_FALSE(firstWall(box.mover, {}, Instant(100)).has_value());
}

// Turned by π/4 about z the box reaches half a diagonal, 0.2 √2, and it spins by π/4 in the first second:
// thrown at 3.8 − 0.2(√2 − 1) m/s it would meet the wall then, were the corner not to pass it before.
TEST(NextContact, ofATumblingBoxIsThatOfItsLowestCorner) {
  const double eighth = std::atan(1.0);
  const double speed = 4 - 0.2 * std::sqrt(2.0);
  const Flyer box({.velocity = {speed, 0, 0}, .angularVelocity = {0, 0, eighth}});
  const Walls walls({{.name = "wall", .normal = -Vec3::UnitX(), .offset = -4, .material = {}}});
  const std::optional<Event> event = firstWall(box.mover, walls.movers, Instant(100));
  ASSERT_TRUE(event.has_value());
  const double t = event->time.hi;
  EXPECT_NEAR(speed * t + 0.2 * (std::cos(eighth * t) + std::sin(eighth * t)), 4, 1e-14);
  EXPECT_NEAR(t, 1, 1e-9);  // sin + cos is level there
}

TEST(NextContact, fromRestOnAWallIsTouching) {
  const Flyer box({.position = {0, 0, 0.2}}, Vec3(0, 0, -9.81));
  const Walls floor({floorAt(0)});
  const std::optional<Event> event = firstWall(box.mover, floor.movers, Instant(1));
  ASSERT_TRUE(event.has_value());
  EXPECT_EQ(event->kind, EventKind::kTouching);
  EXPECT_EQ(event->time.hi, 0);
}

// 2 m apart and closing at 3 m/s, boxes 0.4 m wide: 1.6/3 s after the later of their starts, when the one
// that started first is 1 m on its way already.
TEST(NextContact, ofTwoCountsFromTheLaterStart) {
  const Flyer early({.position = {-1, 0, 0}, .velocity = {1, 0, 0}}, Vec3::Zero(), 1, 1);
  const Flyer late({.position = {2, 0, 0}, .velocity = {-2, 0, 0}}, Vec3::Zero(), 2, 9);
  for (const bool swapped : {false, true}) {
    const Flyer& a = swapped ? late : early;
    const Flyer& b = swapped ? early : late;
    const std::optional<Event> event = firstMeeting(a.mover, b.mover, Instant(100), Instant(100));
    ASSERT_TRUE(event.has_value());
    EXPECT_NEAR(event->time.hi, 2 + 1.6 / 3, 1e-14);
    EXPECT_EQ(event->kind, EventKind::kContact);
    EXPECT_EQ(event->body, a.mover.rank);
    EXPECT_EQ(event->partner, b.mover.rank);
    EXPECT_EQ(event->partnerMotion, 5U);
  }
  EXPECT_FALSE(firstMeeting(early.mover, late.mover, Instant(2.5), Instant(2.5)).has_value());
  EXPECT_FALSE(firstMeeting(early.mover, late.mover, Instant(1.5), Instant(1.5)).has_value());
}

// Thrown at t = 2 downward from below a box at rest. The same parabola, had it begun at t = 1, would have
// risen to 1.25 m at t = 1.5 and met that box, which hangs at 1.5 m.
TEST(NextContact, ofTwoIsNotBeforeBothHaveBegun) {
  const Flyer hanging({.position = {0, 0, 1.5}}, Vec3::Zero(), 1);
  const Flyer falling({.velocity = {0, 0, -5}}, Vec3(0, 0, -10), 2);
  EXPECT_FALSE(firstMeeting(hanging.mover, falling.mover, Instant(100), Instant(100)).has_value());
  const Flyer fallen({.position = {0, 0, 0}, .velocity = {0, 0, 5}}, Vec3(0, 0, -10), 2);
  EXPECT_TRUE(firstMeeting(hanging.mover, fallen.mover, Instant(100), Instant(100)).has_value());
}

// Blocks that lie face to face and move alike are let be; so are those that part.
TEST(NextContact, ofTwoThatMoveAsOneIsNone) {
  const Flyer a({.velocity = {1, 2, 3}});
  const Flyer b({.position = {0.4, 0, 0}, .velocity = {1, 2, 3}});
  EXPECT_FALSE(firstMeeting(a.mover, b.mover, Instant(100), Instant(100)).has_value());
  const Flyer leaving({.position = {0.4, 0, 0}, .velocity = {2, 2, 3}});
  EXPECT_FALSE(firstMeeting(a.mover, leaving.mover, Instant(100), Instant(100)).has_value());
}

}  // namespace
}  // namespace careen
