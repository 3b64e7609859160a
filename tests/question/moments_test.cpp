#include "question/moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "audit/overlap.h"
#include "question/touching_spans.h"
#include "support/asked_runs.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

using test::kG;
using test::runOf;

std::vector<Moment> momentsIn(const Trajectory& run, const std::string& question) {
  return moments(run, readQuestion(question, run.world));
}

// Slides from 2 m/s with μ = 0.4: stops after v/μg. And one that never moves.
class Sliders : public testing::Test {
 protected:
  Sliders() {
    world_.gravity = Vec3(0, 0, -kG);
    world_.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
    world_.walls[0].material.friction = 0.4;
    add("fast", 0, 2);
    add("slow", 3, 1);
    Body held = box("held", Vec3::Constant(0.1), 1, Vec3(9, 9, 0.5));
    held.mass = immovable();
    world_.bodies.push_back(held);
  }
  void add(const std::string& name, double y, double speed) {
    Body body = box(name, Vec3(0.3, 0.2, 0.05), 1, Vec3(0, y, 0.05), Vec3(speed, 0, 0), Vec3::Zero(), 0);
    body.material.friction = 0.4;
    world_.bodies.push_back(body);
  }
  World world_;
};

TEST_F(Sliders, restWhenFrictionHasStoppedThem) {
  const Trajectory run = runOf(world_, 1);
  const auto only = [&](const std::string& question, double time) {
    const std::vector<Moment> found = momentsIn(run, question);
    ASSERT_EQ(found.size(), 1U) << question;
    EXPECT_NEAR(found[0].time, time, 1e-6) << question;
  };
  only("rest(fast)", 2 / (0.4 * kG));
  only("rest(slow)", 1 / (0.4 * kG));
  only("rest", 2 / (0.4 * kG));
  only("rest(held)", 0);
  EXPECT_TRUE(moments(run, readQuestion("rest", run.world), 0.4).empty());
}

// At 0.3 s "late" falls onto "slow", which rests since 1/(μg) = 0.25 s, and both come to rest again.
TEST_F(Sliders, thatAreStruckRestAgain) {
  add("late", 3, 0);
  const double where = 0.5 / (0.4 * kG);
  world_.bodies.back().initial.pose.position = Vec3(where, 3, 0.15 + 0.5 * kG * 0.09);
  const Trajectory run = runOf(world_, 3);
  const std::vector<Moment> slow = momentsIn(run, "rest(slow)");
  ASSERT_GE(slow.size(), 1U);
  EXPECT_NEAR(slow[0].time, 1 / (0.4 * kG), 1e-6);
  const std::vector<Moment> struck = momentsIn(run, "late touches anything");
  ASSERT_FALSE(struck.empty());
  EXPECT_NEAR(struck[0].time, 0.3, 1e-9);
  EXPECT_EQ(struck[0].with, Partner::ofBody(1));
  const std::vector<Moment> all = momentsIn(run, "rest");
  ASSERT_FALSE(all.empty());
  EXPECT_GT(all.back().time, 0.3);
}

// One comes to rest at the very time at which another begins to move: they never rest together, but once it
// is at rest again.
TEST(MomentsOfRest, countWhoGoesOnFirst) {
  Trajectory run;
  run.settings.duration = 4;
  run.world.bodies = {box("a", Vec3::Ones(), 1, Vec3::Zero()), box("b", Vec3::Ones(), 1, Vec3(5, 0, 0))};
  run.tracks = {{.segments = {{.start = 0, .motion = Rest()},
                              {.start = 1, .motion = Flight()},
                              {.start = 3, .motion = Rest()}}},
                {.segments = {{.start = 0, .motion = Flight()}, {.start = 1, .motion = Rest()}}}};
  const auto only = [&](const std::string& question, std::vector<double> expected) {
    std::vector<double> times;
    for (const Moment& moment : momentsIn(run, question)) {
      times.push_back(moment.time);
    }
    EXPECT_EQ(times, expected) << question;
  };
  only("rest", {3});
  only("rest(a)", {0, 3});
  only("rest(b)", {1});
  std::swap(run.tracks[0], run.tracks[1]);
  only("rest", {3});
  run.world.bodies[0].mass = immovable();
  only("rest", {0, 3});
}

// What touches a thing is told for each thing; who asks from the other side gets the same moments.
TEST_F(Sliders, touchesAreTheSameFromBothSides) {
  const Trajectory run = runOf(world_, 1);
  const std::vector<Moment> floor = momentsIn(run, "floor touches anything");
  ASSERT_EQ(floor.size(), 2U);
  EXPECT_EQ(floor[0].time, 0);
  EXPECT_EQ(floor[0].with, Partner::ofBody(0));
  EXPECT_EQ(floor[1].with, Partner::ofBody(1));
  EXPECT_EQ(momentsIn(run, "fast touches floor").size(), 1U);
  EXPECT_EQ(momentsIn(run, "floor touches fast").size(), 1U);
  EXPECT_TRUE(momentsIn(run, "fast leaves floor").empty());
  EXPECT_TRUE(momentsIn(run, "fast touches slow").empty());
}

// A cube is thrown up from the floor at 2 m/s, e = 0: it leaves it at the start, or 4e-6 m later.
TEST(MomentsOfContact, leavingEndsATouch) {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.bodies = {box("a", Vec3::Constant(0.1), 1, Vec3(0, 0, 0.1), Vec3(0, 0, 2), Vec3::Zero(), 0)};
  const Trajectory run = runOf(world, 1);
  const std::vector<Moment> left = momentsIn(run, "a leaves floor");
  ASSERT_EQ(left.size(), 1U);
  const double near = touchingGaps(run).usual;
  EXPECT_NEAR(left[0].time, (2 - std::sqrt(4 - 2 * kG * near)) / kG, 1e-14);
  const std::vector<Moment> touched = momentsIn(run, "a touches floor");
  ASSERT_EQ(touched.size(), 2U);
  EXPECT_EQ(touched[0].time, 0);
  EXPECT_NEAR(touched[1].time, 4 / kG, 1e-12);
}

// ---- Against samples.

class RandomRoom {
 public:
  explicit RandomRoom(unsigned seed) : random_(seed) {
    world_ = elasticRoom();
    world_.bodies.clear();
    for (Wall& each : world_.walls) {
      each.material = {.restitution = real(0, 0.9), .friction = real(0, 0.6)};
    }
    const int count = 1 + static_cast<int>(random_() % 3);
    for (int i = 0; i < count; ++i) {
      Body body = box(std::string(1, static_cast<char>('a' + i)),
                      Vec3(real(0.1, 0.5), real(0.1, 0.5), real(0.1, 0.5)), real(0.5, 2),
                      Vec3(2 * i - 2, real(-1, 1), real(1, 4)), vector(3), vector(6), real(0, 0.9));
      body.material.friction = real(0, 0.6);
      if (random_() % 3 == 0) {
        body.boxCenter = 0.3 * Vec3(real(-1, 1), real(-1, 1), real(-1, 1)).cwiseProduct(body.halfExtents);
      }
      world_.bodies.push_back(body);
    }
  }

  const World& world() const { return world_; }
  std::string name() { return world_.bodies[random_() % world_.bodies.size()].name; }
  double real(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }

  Question question() {
    const std::string walls[] = {"-z", "+x", "-y"};
    switch (random_() % 10) {
      case 0:
        return read(name() + " touches '" + walls[random_() % 3] + "'");
      case 1:
        return read(name() + " leaves '" + walls[random_() % 3] + "'");
      case 2:
        return world_.bodies.size() > 1 ? read("a touches b") : read("a touches '-z'");
      case 3:
        return world_.bodies.size() > 1 ? compared("distance(a, b)", 0.5, 3) : compared("x(a)", -2, 2);
      case 4:
        return compared("height(" + name() + ")", 0.2, 2);
      case 5:
        return compared("speed(" + name() + ")", 0.5, 6);
      case 6:
        return compared("spin(" + name() + ")", 0.5, 8);
      case 7:
        return compared("energy(" + name() + ")", 1, 30);
      case 8:
        return compared("tilt(" + name() + ")", 5, 170);
      default:
        return compared("y(" + name() + ")", -1, 1);
    }
  }

 private:
  Vec3 vector(double size) { return Vec3(real(-size, size), real(-size, size), real(-size, size)); }
  Question read(const std::string& text) { return readQuestion(text, world_); }
  Question compared(const std::string& what, double least, double most) {
    return read(what + (random_() % 2 == 0 ? " < " : " > ") + std::to_string(real(least, most)));
  }

  std::mt19937 random_;
  World world_;
};

// Whether it is true at that moment, from the states of the run alone.
bool isTrueAt(const Trajectory& run, const Question& question, double time) {
  const auto body = static_cast<std::size_t>(question.of.front().body());
  const Body& own = run.world.bodies[body];
  const BodyState state = run.state(body, time);
  const Pose middle = boxPose(own, state.pose);
  if (question.kind == Question::Kind::kTouches || question.kind == Question::Kind::kLeaves) {
    const Partner other = question.of[1];
    const double gap =
        other.isWall()
            ? separationOf(own, state.pose, planeAt(run.world.walls[other.wall()], time))
            : separationOf(own, state.pose, run.world.bodies[static_cast<std::size_t>(other.body())],
                           run.state(static_cast<std::size_t>(other.body()), time).pose);
    return (gap <= touchingGaps(run).usual) == (question.kind == Question::Kind::kTouches);
  }
  double value = 0;
  const Vec3 spin = angularVelocity(own.mass, state);
  switch (question.quantity) {
    case Quantity::kX:
      value = middle.position.x();
      break;
    case Quantity::kY:
      value = middle.position.y();
      break;
    case Quantity::kHeight:
    case Quantity::kZ:
      value = middle.position.z();
      break;
    case Quantity::kSpeed:
      value = (state.velocity + spin.cross(state.pose.worldFromBody * own.boxCenter)).norm();
      break;
    case Quantity::kSpin:
      value = spin.norm();
      break;
    case Quantity::kEnergy:
      value = 0.5 * own.mass.mass * state.velocity.squaredNorm() + 0.5 * spin.dot(state.angularMomentum);
      break;
    case Quantity::kTilt:
      value = std::acos(std::clamp(state.pose.worldFromBody(2, 2), -1.0, 1.0)) * 180 / M_PI;
      break;
    case Quantity::kDistance:
      value =
          (middle.position - run.boxPoseAt(static_cast<std::size_t>(question.of[1].body()), time).position)
              .norm();
  }
  return question.kind == Question::Kind::kAbove ? value > question.level : value < question.level;
}

// Of a touch whose moment is the impact a little later.
bool isNearUntil(const Trajectory& run, const Question& question, double time, double moment) {
  bool isNear = question.kind == Question::Kind::kTouches;
  for (int i = 0; i <= 8 && isNear; ++i) {
    isNear = isTrueAt(run, question, time + (moment - time) * i / 8);
  }
  return isNear;
}

// Between two samples of which only the second is true there is a moment; just after each moment it is true,
// and just before it is not. At impacts a box touches for less time than lies between samples.
TEST(Moments, agreeWithDenseSamplesOfRandomRuns) {
  constexpr int kRuns = 200;
  constexpr int kSamples = 6000;
  constexpr double kSeconds = 3;
  constexpr double kBeside = 2e-9;  // [s]
  std::size_t rises = 0;
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    RandomRoom room(seed);
    const Trajectory run = runOf(room.world(), kSeconds);
    for (int asked = 0; asked < 3; ++asked) {
      const Question question = room.question();
      const std::vector<Moment> all = moments(run, question);
      found += all.size();
      bool before = question.kind == Question::Kind::kLeaves && isTrueAt(run, question, 0);
      std::size_t next = 0;
      for (int i = 0; i <= kSamples; ++i) {
        const double time = kSeconds * i / kSamples;
        const bool now = isTrueAt(run, question, time);
        std::size_t here = 0;
        for (; next < all.size() && all[next].time <= time; ++next) {
          ++here;
        }
        if (now && !before) {
          ++rises;
          EXPECT_TRUE(here > 0 || (next < all.size() && isNearUntil(run, question, time, all[next].time)))
              << seed << ' ' << question.text << ' ' << time;
        }
        before = now;
      }
      for (const Moment& moment : all) {
        const bool isContact = moment.with.has_value();
        if (moment.time > kBeside && moment.time < kSeconds - kBeside && !isContact) {
          EXPECT_TRUE(isTrueAt(run, question, moment.time + kBeside))
              << seed << ' ' << question.text << ' ' << moment.time;
          EXPECT_FALSE(isTrueAt(run, question, moment.time - kBeside))
              << seed << ' ' << question.text << ' ' << moment.time;
        }
      }
    }
  }
  std::cout << rises << " rises between samples, " << found << " moments\n";
  EXPECT_GT(rises, 500U);
  EXPECT_GE(found, rises);
}

}  // namespace
}  // namespace careen
