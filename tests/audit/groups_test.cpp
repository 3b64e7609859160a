#include "audit/groups.h"

#include <gtest/gtest.h>

#include "support/exact_runs.h"

namespace careen {
namespace {

// Four cubes of 2 m in a row, 10 m apart, at rest.
Trajectory fourCubes() {
  Trajectory run;
  run.settings = {.duration = 1};
  for (int i = 0; i < 4; ++i) {
    run.world.bodies.push_back(box("cube-" + std::to_string(i), Vec3::Ones(), 1, Vec3(10. * i, 0, 0)));
    Flight flight;
    flight.position = Vec3(10. * i, 0, 0);
    run.tracks.push_back({.segments = {{.start = 0, .motion = flight}}});
  }
  return run;
}

std::vector<std::vector<std::size_t>> membersOf(const Trajectory& run) {
  std::vector<std::vector<std::size_t>> members;
  for (const ExchangeGroup& group : exchangeGroups(run, Samples(run, {0, 0.5, 1}))) {
    members.push_back(group.bodies);
  }
  return members;
}

using Members = std::vector<std::vector<std::size_t>>;

TEST(Groups, aloneUnlessSomethingJoinsThem) {
  EXPECT_EQ(membersOf(fourCubes()), (Members{{0}, {1}, {2}, {3}}));
}

TEST(Groups, impactsAndSpringsJoin) {
  Trajectory run = fourCubes();
  run.impacts.push_back({.time = 0.5, .a = {2}, .b = Partner::ofBody(0)});
  run.world.springs.push_back({.from = {.body = 1}, .to = {.body = 3}});
  run.world.springs.push_back({.from = {.body = 0}, .to = {}});
  EXPECT_EQ(membersOf(run), (Members{{0, 2}, {1, 3}}));
  const auto groups = exchangeGroups(run, Samples(run, {0, 1}));
  EXPECT_EQ(groups[0].impacts, (std::vector<std::size_t>{0}));
  EXPECT_EQ(groups[0].springs, (std::vector<std::size_t>{1}));
  EXPECT_EQ(groups[1].springs, (std::vector<std::size_t>{0}));
}

TEST(Groups, jointsJoin) {
  Trajectory run = fourCubes();
  run.world.joints = {{.name = "a", .kind = Joint::Kind::kBall, .from = {.body = 1}, .to = {.body = 3}},
                      {.name = "b", .kind = Joint::Kind::kHinge, .from = {.body = 0}, .to = {}}};
  EXPECT_EQ(membersOf(run), (Members{{0}, {1, 3}, {2}}));
  const auto groups = exchangeGroups(run, Samples(run, {0, 1}));
  EXPECT_EQ(groups[0].joints, (std::vector<std::size_t>{1}));
  EXPECT_EQ(groups[1].joints, (std::vector<std::size_t>{0}));
  EXPECT_TRUE(groups[2].joints.empty());
}

// Only what stops can: limits, ropes.
TEST(Groups, loseEnergyInJointsThatStop) {
  const auto loses = [](const Joint& joint) {
    Trajectory run = fourCubes();
    run.world.joints = {joint};
    run.world.joints[0].from.body = 0;
    return exchangeGroups(run, Samples(run, {0, 1})).front().jointsLose;
  };
  EXPECT_FALSE(loses({.name = "joint", .kind = Joint::Kind::kBall, .from = {}, .to = {}}));
  EXPECT_FALSE(loses({.name = "joint", .kind = Joint::Kind::kHinge, .from = {}, .to = {}}));
  EXPECT_TRUE(loses(
      {.name = "joint", .kind = Joint::Kind::kHinge, .from = {}, .to = {}, .lowest = -1, .highest = 1}));
  EXPECT_FALSE(loses({.name = "joint",
                      .kind = Joint::Kind::kSlider,
                      .from = {},
                      .to = {},
                      .lowest = 0,
                      .highest = 1,
                      .restitution = 1}));
  EXPECT_TRUE(loses({.name = "joint", .kind = Joint::Kind::kRope, .from = {}, .to = {}, .restitution = 0.5}));
  EXPECT_FALSE(loses({.name = "joint", .kind = Joint::Kind::kRope, .from = {}, .to = {}, .restitution = 1}));
}

TEST(Groups, immovableBodiesJoinNothing) {
  Trajectory run = fourCubes();
  run.world.bodies[1].mass = immovable();
  run.impacts.push_back({.time = 0.5, .a = {0}, .b = Partner::ofBody(1)});
  run.impacts.push_back({.time = 0.6, .a = {2}, .b = Partner::ofBody(1)});
  EXPECT_EQ(membersOf(run), (Members{{0}, {2}, {3}}));
}

TEST(Groups, contactStepsThatBeginTogetherJoin) {
  Trajectory run = fourCubes();
  for (const std::size_t body : {0U, 3U}) {
    ContactStep step{.duration = 0.1};
    step.position.fill(Vec3::Zero());
    step.position[0] = Vec3(10. * static_cast<double>(body), 0, 0);
    step.worldFromBody.fill(Vec4::Zero());
    step.worldFromBody[0] = Vec4(0, 0, 0, 1);
    run.tracks[body].segments.open().push_back({.start = 1. / 3, .motion = step});
  }
  EXPECT_EQ(membersOf(run), (Members{{0, 3}, {1}, {2}}));
}

TEST(Groups, boxesThatLieOnEachOtherJoin) {
  Trajectory run = fourCubes();
  Rest rest;
  rest.pose.position = Vec3(0, 0, 2);
  run.tracks[3].segments = {{.start = 0, .motion = rest}};
  EXPECT_EQ(membersOf(run), (Members{{0, 3}, {1}, {2}}));
}

TEST(Groups, boxesThatPassThroughEachOtherDoNotJoin) {
  Trajectory run = fourCubes();
  Rest rest;
  rest.pose.position = Vec3(0, 0, 2);
  run.tracks[3].segments = {{.start = 0, .motion = rest}};
  run.world.apart = {{0, 3}};
  EXPECT_EQ(membersOf(run), (Members{{0}, {1}, {2}, {3}}));
}

TEST(Groups, loseEnergyIfAnyPairMay) {
  Trajectory run = fourCubes();
  for (Body& body : run.world.bodies) {
    body.material = {.restitution = 1, .friction = 0};
  }
  EXPECT_FALSE(exchangeGroups(run, Samples(run, {0, 1}))[0].mayLose);
  run.world.bodies[2].material.friction = run.world.bodies[3].material.friction = 0.1;
  EXPECT_FALSE(exchangeGroups(run, Samples(run, {0, 1}))[0].mayLose);  // the frictionless slide on the rough
  EXPECT_TRUE(exchangeGroups(run, Samples(run, {0, 1}))[2].mayLose);
}

TEST(Groups, noBodyLosesWithItself) {
  Trajectory run = fourCubes();
  for (Body& body : run.world.bodies) {
    body.material = {.restitution = 1, .friction = 0};
  }
  run.world.bodies[1].material = {.restitution = 0.5, .friction = 0.1};
  EXPECT_FALSE(exchangeGroups(run, Samples(run, {0, 1}))[1].mayLose);
  run.world.bodies[3].material.restitution = 0.9;  // max(0.5, 0.9) < 1
  EXPECT_TRUE(exchangeGroups(run, Samples(run, {0, 1}))[1].mayLose);
  EXPECT_TRUE(exchangeGroups(run, Samples(run, {0, 1}))[3].mayLose);
  EXPECT_FALSE(exchangeGroups(run, Samples(run, {0, 1}))[0].mayLose);
}

}  // namespace
}  // namespace careen
