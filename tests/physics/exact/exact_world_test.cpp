#include "physics/exact/exact_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/article_equations.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

// G. Galperin: a heavy box of 100ᵏ the mass drives a light one against a wall; the impacts spell π.
TEST(ExactWorld, countsTheDigitsOfPi) {
  const std::vector<std::size_t> expected = {3, 31, 314, 3141, 31415};
  double mass = 1;
  for (const std::size_t impacts : expected) {
    World world;
    world.walls = {wall("wall", Vec3(1, 0, 0), 0)};
    world.bodies = {box("light", Vec3(0.2, 0.2, 0.2), 1, Vec3(1.5, 0, 0)),
                    box("heavy", Vec3(0.5, 0.5, 0.5), mass, Vec3(4, 0, 0), Vec3(-1, 0, 0))};
    const Recorded run = runFor(world, 1000);
    EXPECT_EQ(run.moments(), impacts);
    EXPECT_LT(run.figures.energyChange, 1e-12);
    for (std::size_t i = 0; i < 2; ++i) {  // straight, to the bit
      EXPECT_EQ(run.last(world, i, 1000).angularMomentum, Vec3(0, 0, 0));
      EXPECT_EQ(run.last(world, i, 1000).pose.position.tail<2>(), (Vec3(0, 0, 0).tail<2>()));
    }
    mass *= 100;
  }
}

// Falls h = 1 m flat: at rest after sqrt(2h/g)(1+e)/(1−e).
TEST(ExactWorld, bouncesThatAccumulateEndInRestAtTheirTime) {
  double worst = 0;
  for (const Vec3& half : {Vec3(0.25, 0.25, 0.25), Vec3(0.3, 0.2, 0.1)}) {
    for (const double e : {0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99}) {
      World world;
      world.gravity = Vec3(0, 0, -10);
      world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
      world.bodies = {box("box", half, 0.7, Vec3(0, 0, 1 + half.z()), Vec3::Zero(), Vec3::Zero(), e)};
      world.bodies[0].material.friction = half.x() == half.y() ? 0 : 0.4;
      const Recorded run = runFor(world, 200);
      const auto& [start, motion] = run.motions[0].back();
      ASSERT_TRUE(std::holds_alternative<Rest>(motion)) << e;
      worst = std::max(worst, std::fabs(start - std::sqrt(0.2) * (1 + e) / (1 - e)));
      const Pose& pose = std::get<Rest>(motion).pose;
      EXPECT_EQ(pose.worldFromBody, Mat3(Mat3::Identity())) << e;
      EXPECT_EQ(pose.position.head<2>(), (Vec3(0, 0, 0).head<2>())) << e;
      EXPECT_NEAR(pose.position.z(), half.z(), 1e-12) << e;
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  EXPECT_LT(worst, 1e-12);  // measured 3.7e-13, after 1,500 impacts that are each off by a few roundings
}

// The same on a box instead of a wall, off its middle and turned against it, far from the origin.
TEST(ExactWorld, bouncesOnABoxEndInRestToo) {
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(10, -7, 3)}) {
    World world;
    world.gravity = Vec3(0, 0, -10);
    Body table = box("table", Vec3(0.7, 0.6, 0.3), 1, place, Vec3::Zero(), Vec3::Zero(), 0);
    table.mass = immovable();
    table.initial.pose.worldFromBody = axisAngle(Vec3::UnitZ(), 0.6);
    world.bodies = {table, box("crate", Vec3(0.3, 0.2, 0.1), 1.3, place + Vec3(0.02, 0.07, 1.4), Vec3::Zero(),
                               Vec3::Zero(), 0.7)};
    const Recorded run = runFor(world, 20);
    const auto& [start, motion] = run.motions[1].back();
    ASSERT_TRUE(std::holds_alternative<Rest>(motion));
    // The gap of two boxes is known to the rounding of their places, and that decides when a slow hop ends.
    // Measured 3.2e-9 at the origin, 2.2e-8 ten metres from it.
    EXPECT_NEAR(start, std::sqrt(0.2) * 1.7 / 0.3, 1e-7);
    EXPECT_EQ(std::get<Rest>(motion).pose.worldFromBody, Mat3(Mat3::Identity()));
  }
}

// A turning slide without loss: friction at every hop tilts the box a little, and hops of 1e-10 m would go on
// for ever (they did, 100,000 in a second).
TEST(ExactWorld, hopsWithoutLossTooLowToSeeEnd) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 1)};
  world.walls[0].material.friction = 1;
  world.bodies = {
      box("box", Vec3(0.18, 0.13, 0.1), 1, Vec3(0, 0, 0.1 + 1e-10), Vec3(1, 0, 0), Vec3(0, 0, 1.7), 1)};
  world.bodies[0].material.friction = 1;
  const Recorded run = runFor(world, 2);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
  EXPECT_LT(run.moments(), 1000);  // more than 200,000 if each is followed
}

// A thin plate clatters down to its last hops long before they are short for its thickness: they must not
// feed on the rounding of the gap for ever (they did, 4 times in a microsecond). It ends flat and turning,
// and then at rest.
TEST(ExactWorld, hopsAsLowAsRoundingEnd) {
  World world = elasticRoom();
  for (Wall& each : world.walls) {
    each.offset = -3;
    each.material = {.restitution = 0.8, .friction = 0.3};
  }
  world.walls[4].offset = 0;
  world.walls[5].offset = -6;
  world.bodies = {box("plate", Vec3(0.001, 0.2, 0.4), 1, Vec3(-1.8, -0.9, 4.248675802878872),
                      Vec3(3.0400652147227083, 1.7592954373558287, -1.782294254840342),
                      Vec3(0.0, 0.007949236900840262, -3.140148208153027), 0.8)};
  world.bodies[0].material.friction = 0.3;
  const Recorded run = runFor(world, 6);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
}

TEST(ExactWorld, fallsAtRestWithoutRestitution) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  world.bodies = {box("cube", Vec3(0.5, 0.5, 0.5), 1, Vec3(0, 0, 1.5), Vec3::Zero(), Vec3::Zero(), 0)};
  const Recorded run = runFor(world, 2);
  EXPECT_EQ(run.moments(), 1U);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
  EXPECT_NEAR(run.motions[0].back().first, std::sqrt(0.2), 1e-15);
}

// The corners of a body at any moment of its recorded motion.
double deepestCorner(const World& world, const Recorded& run, double duration) {
  double deepest = 0;
  const auto& motions = run.motions[0];
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const double end = k + 1 < motions.size() ? motions[k + 1].first : duration;
    for (int sample = 0; sample <= 50; ++sample) {
      const BodyState state =
          stateAt(motions[k].second, world.bodies[0].mass, (end - motions[k].first) * sample / 50);
      for (int c = 0; c < kCorners; ++c) {
        const Vec3 point = state.pose.worldPoint(corner(world.bodies[0].halfExtents, c));
        for (const Wall& each : world.walls) {
          deepest = std::max(deepest, each.offset - each.normal.dot(point));
        }
      }
    }
  }
  return deepest;
}

TEST(ExactWorld, neverGoesIntoAWall) {
  const World world = elasticRoom();
  EXPECT_LT(deepestCorner(world, runFor(world, 300), 300), 1e-12);
}

World scaled(World world, double length, double time) {
  for (Wall& each : world.walls) {
    each.offset *= length;
  }
  world.gravity *= length / (time * time);
  for (Body& body : world.bodies) {
    const double mass = body.mass.mass;
    body.halfExtents *= length;
    body.mass = solidBox(body.halfExtents, mass);
    body.initial.pose.position *= length;
    body.initial.velocity *= length / time;
    body.initial.angularMomentum *= length * length / time;
  }
  return world;
}

// No hidden absolute tolerance: powers of two change exponents and nothing else.
TEST(ExactWorld, isTheSameToTheBitWhenScaled) {
  const World world = elasticRoom();
  const Recorded run = runFor(world, 60);
  const Recorded large = runFor(scaled(world, 4, 2), 120);
  ASSERT_EQ(run.impacts.size(), large.impacts.size());
  ASSERT_GT(run.impacts.size(), 100U);
  for (std::size_t k = 0; k < run.impacts.size(); ++k) {
    ASSERT_EQ(2 * run.impacts[k].time, large.impacts[k].time) << k;
    ASSERT_EQ(4 * run.impacts[k].point, large.impacts[k].point) << k;
    ASSERT_EQ(2 * run.impacts[k].impulse, large.impacts[k].impulse) << k;
  }
}

TEST(ExactWorld, isTheSameToTheBitInAMirror) {
  const World world = elasticRoom();
  const Recorded run = runFor(world, 60);
  World mirrored = world;
  std::swap(mirrored.walls[0], mirrored.walls[1]);
  mirrored.walls[0].normal = Vec3(1, 0, 0);
  mirrored.walls[1].normal = Vec3(-1, 0, 0);
  BodyState& start = mirrored.bodies[0].initial;
  start.pose.position.x() *= -1;
  start.velocity.x() *= -1;
  start.angularMomentum.y() *= -1;
  start.angularMomentum.z() *= -1;
  const Recorded image = runFor(mirrored, 60);
  ASSERT_EQ(run.impacts.size(), image.impacts.size());
  for (std::size_t k = 0; k < run.impacts.size(); ++k) {
    ASSERT_EQ(run.impacts[k].time, image.impacts[k].time) << k;
    ASSERT_EQ(Vec3(-run.impacts[k].point.x(), run.impacts[k].point.y(), run.impacts[k].point.z()),
              image.impacts[k].point)
        << k;
  }
}

World threeInARoom() {
  World world = elasticRoom();
  world.bodies = {box("b", Vec3(0.5, 0.3, 0.2), 1, Vec3(0, 0, 3), Vec3(3, 2, 1), Vec3(3, 7, -2)),
                  box("c", Vec3(0.3, 0.3, 0.3), 2, Vec3(-2, 1, 1), Vec3(1, -2, 2), Vec3(1, 0, 4)),
                  box("a", Vec3(0.2, 0.6, 0.1), 1, Vec3(2, -1, 4.5), Vec3(-2, 1, -1), Vec3(0, 5, 1))};
  return world;
}

TEST(ExactWorld, isTheSameToTheBitHoweverTheBodiesAreListed) {
  const World world = threeInARoom();
  World reversed = world;
  std::reverse(reversed.bodies.begin(), reversed.bodies.end());
  const Recorded run = runFor(world, 20);
  const Recorded other = runFor(reversed, 20);
  ASSERT_GT(run.impacts.size(), 150U);
  ASSERT_EQ(run.impacts.size(), other.impacts.size());
  for (std::size_t body = 0; body < 3; ++body) {
    EXPECT_EQ(run.last(world, body, 20).pose.position, other.last(reversed, 2 - body, 20).pose.position);
  }
  EXPECT_LT(run.figures.energyChange, 1e-13);
}

TEST(ExactWorld, comesBackWhenVelocitiesAreReversed) {
  const World world = elasticRoom();
  const Recorded run = runFor(world, 60);
  const std::size_t impacts = 6;
  const double turn = (run.impacts[impacts - 1].time + run.impacts[impacts].time) / 2;
  const Recorded there = runFor(world, turn);
  World back = world;
  back.bodies[0].initial = there.last(world, 0, turn);
  back.bodies[0].initial.velocity *= -1;
  back.bodies[0].initial.angularMomentum *= -1;
  const Recorded again = runFor(back, turn);
  EXPECT_EQ(again.impacts.size(), there.impacts.size());
  const Vec3 end = again.last(back, 0, turn).pose.position;
  // 1e-16 grows ×4.3 with every bounce, there and back: 12 bounces make 4e-9 of it at most.
  EXPECT_LT((end - world.bodies[0].initial.pose.position).norm(), 4e-8);
}

TEST(ExactWorld, rowOfBlocksPassesTheSpeedOn) {
  World world;
  for (int i = 0; i < 5; ++i) {
    world.bodies.push_back(box("block-" + std::to_string(i), Vec3(0.5, 0.5, 0.5), 1,
                               Vec3(i == 0 ? -2.0 : i, 0, 0), Vec3(i == 0 ? 1.0 : 0.0, 0, 0)));
  }
  const Recorded run = runFor(world, 4);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(run.last(world, i, 4).velocity.x(), i == 4 ? 1 : 0, 1e-14) << i;
  }
}

TEST(ExactWorld, slidesOnWhereItHasLanded) {
  World slides;
  slides.gravity = Vec3(0, 0, -10);
  slides.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  slides.bodies = {box("sled", Vec3(0.5, 0.5, 0.5), 1, Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3::Zero(), 0)};
  const Recorded run = runFor(slides, 5);
  const auto& [start, motion] = run.motions[0].back();
  ASSERT_TRUE(std::holds_alternative<ContactStep>(motion));
  const BodyState end = stateAt(motion, slides.bodies[0].mass, 5 - start);
  EXPECT_LT((end.pose.position - Vec3(5, 0, 0.5)).norm(), 1e-14) << end.pose.position.transpose();
  EXPECT_EQ(end.pose.worldFromBody, Mat3(Mat3::Identity()));
}

TEST(ExactWorld, tumblesToRest) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  world.walls[0].material.friction = 0.5;
  world.bodies = {box("crate", Vec3(0.5, 0.3, 0.2), 1, Vec3(0, 0, 2), Vec3::Zero(), Vec3(1, 2, 3), 0.3)};
  world.bodies[0].material.friction = 0.5;
  const Recorded run = runFor(world, 20);
  ASSERT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
  EXPECT_NEAR(std::get<Rest>(run.motions[0].back().second).pose.position.z(), 0.2, 1e-14);
}

class EnoughAfter : public Notes {
 public:
  EnoughAfter(Recorded& run, double time) : Notes(run), time_(time) {}
  void reaches(double time) override { reached = time; }
  bool hasEnough() const override { return reached >= time_; }
  double reached = 0;  // [s]

 private:
  double time_;
};

// What there is then are the first events of the whole run, bit for bit, and its figures.
TEST(ExactWorld, endsWhereItsRecorderHasEnough) {
  const World world = elasticRoom();
  const Recorded whole = runFor(world, 60);
  Recorded run;
  run.motions.resize(1);
  EnoughAfter notes(run, 7);
  run.figures = ExactWorld(world, {.duration = 60}, notes).run({});
  EXPECT_GE(notes.reached, 7);
  EXPECT_LT(notes.reached, 9);
  ASSERT_FALSE(run.impacts.empty());
  ASSERT_GT(whole.impacts.size(), run.impacts.size());
  EXPECT_GE(whole.impacts[run.impacts.size()].time, notes.reached);
  EXPECT_LT(run.impacts.back().time, notes.reached);
  EXPECT_EQ(run.impacts.back().impulse, whole.impacts[run.impacts.size() - 1].impulse);
  EXPECT_LE(run.figures.energyChange, whole.figures.energyChange);
}

TEST(ExactWorld, stopsWhenAsked) {
  const World world = elasticRoom();
  Recorded run;
  run.motions.resize(1);
  Notes notes(run);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(ExactWorld(world, {.duration = 60}, notes).run(source.get_token()), Interrupted);
}

}  // namespace
}  // namespace careen
