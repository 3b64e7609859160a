#include "physics/contact_pushes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/jointed.h"

namespace careen {
namespace {

constexpr double kPullOfPushes = 10;  // [m/s²]

// At rest: what contacts give is the weight's opposite.
std::vector<PushedBody> atRest(const World& world) {
  std::vector<PushedBody> bodies;
  for (const Body& body : world.bodies) {
    PushedBody& pushed = bodies.emplace_back();
    pushed.state = body.initial;
    const double weight = body.mass.mass * kPullOfPushes;
    if (!isImmovable(body.mass)) {
      pushed.given = {.force = Vec3(0, 0, weight)};
      pushed.scale = weight;
    }
    pushed.near = 1e-6;
    pushed.slow = 1e-3;
  }
  return bodies;
}

World onFloor(double friction) {
  World world;
  world.walls = {wall("floor", Vec3::UnitZ(), 0)};
  world.walls[0].material.friction = friction;
  return world;
}

Body rough(Body body, double friction) {
  body.material.friction = friction;
  return body;
}

TEST(ContactPushes, ofABoxOnTheFloorAreQuartersOfItsWeight) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("box", Vec3(0.5, 0.3, 0.2), 4, Vec3(1, 2, 0.2)), 0.5)};
  const std::vector<ContactPush> pushes = contactPushes(world, atRest(world), 0);
  ASSERT_EQ(pushes.size(), 4U);
  for (const ContactPush& push : pushes) {
    EXPECT_EQ(push.a.value, 0);
    EXPECT_EQ(push.b, Partner::ofWall(0));
    EXPECT_LT((push.force - Vec3(0, 0, 10)).norm(), 1e-12);
    EXPECT_NEAR(std::fabs(push.point.x() - 1), 0.5, 1e-15);
    EXPECT_NEAR(push.point.z(), 0, 1e-15);
    EXPECT_LT(push.left, 1e-12);
  }
}

// A plank against a smooth wall, on a rough floor, at 60°: N = m g below, and m g/2 · cot 60° at the wall.
TEST(ContactPushes, ofALadderFollowFromItsTorques) {
  World world = onFloor(0.5);
  world.walls.push_back(wall("smooth", -Vec3::UnitX(), -3));
  const double angle = std::numbers::pi / 3;
  Body plank = rough(box("plank", Vec3(1, 0.25, 1e-3), 6, Vec3::Zero()), 0.5);
  plank.initial.pose.worldFromBody = Eigen::AngleAxisd(-angle, Vec3::UnitY()).toRotationMatrix();
  // Its foot's lower edge on the floor, its head's outer edge at the wall.
  const Mat3& turn = plank.initial.pose.worldFromBody;
  double low = 0;
  double far = 0;
  for (int k = 0; k < kCorners; ++k) {
    low = std::min(low, (turn * corner(plank, k)).z());
    far = std::max(far, (turn * corner(plank, k)).x());
  }
  plank.initial.pose.position = Vec3(3 - far, 0, -low);
  world.bodies = {plank};
  const std::vector<ContactPush> pushes = contactPushes(world, atRest(world), 0);
  Vec3 atFloor = Vec3::Zero();
  Vec3 atWall = Vec3::Zero();
  Vec3 foot = Vec3::Zero();
  Vec3 head = Vec3::Zero();
  for (const ContactPush& push : pushes) {
    (push.b == Partner::ofWall(0) ? atFloor : atWall) += push.force;
    (push.b == Partner::ofWall(0) ? foot : head) = push.point;
  }
  const Vec3& middle = plank.initial.pose.position;
  // About the foot: weight × its arm = wall's push × its height.
  const double push = 60 * (middle.x() - foot.x()) / (head.z() - foot.z());
  EXPECT_EQ(pushes.size(), 4U);
  EXPECT_NEAR(push, 30 / std::tan(angle), 0.1);  // it is thin
  EXPECT_LT((atWall - Vec3(-push, 0, 0)).norm(), 1e-10);
  EXPECT_LT((atFloor - Vec3(push, 0, 60)).norm(), 1e-10);
}

// Three boxes on each other, the lower on a held one; forces on both are opposite and the sums what is above.
TEST(ContactPushes, ofAStackBearWhatIsAbove) {
  World world;
  world.bodies = {box("table", Vec3(1, 1, 0.5), 1, Vec3(0, 0, -0.5))};
  world.bodies[0].mass = immovable();
  for (int k = 0; k < 3; ++k) {
    world.bodies.push_back(
        rough(box("box", Vec3::Constant(0.25), 1 + k, Vec3(0.01 * k, 0, 0.25 + 0.5 * k)), 0.5));
  }
  Vec3 onTable = Vec3::Zero();
  Vec3 between = Vec3::Zero();
  for (const ContactPush& push : contactPushes(world, atRest(world), 0)) {
    EXPECT_NE(push.a.value, 0);
    onTable += push.b == Partner::ofBody(0) ? push.force : Vec3::Zero();
    // On the third by the second, whichever is a.
    if (push.a.value == 2 && push.b == Partner::ofBody(3)) {
      between -= push.force;
    }
    EXPECT_LT(push.left, 1e-10);
    EXPECT_GE(dot(push.normal, push.force), 0);
  }
  EXPECT_LT((onTable - Vec3(0, 0, 60)).norm(), 1e-10);
  EXPECT_LT((between - Vec3(0, 0, 30)).norm(), 1e-10);
}

// What slides turning is braked against the slip of each corner, and not as would be least.
TEST(ContactPushes, areOppositeToSlip) {
  World world = onFloor(0.5);
  world.bodies = {
      rough(box("box", Vec3(0.5, 0.5, 0.1), 1, Vec3(0, 0, 0.1), Vec3(0.3, 0, 0), Vec3(0, 0, 2)), 0.5)};
  std::vector<PushedBody> bodies = atRest(world);
  // Heights of its middle turn it over by friction's arm: corners press as x and y of friction's sum say. A
  // thin one would press alike, so that forces are μ m g/4 each; here they are found by the torque given.
  Vec3 force = Vec3(0, 0, kPullOfPushes);
  Vec3 torque = Vec3::Zero();
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Vec3 slip = Vec3(0.3 - 2 * y, 2 * x, 0).normalized();
      force -= 0.5 * kPullOfPushes / 4 * slip;
      torque += Vec3(x, y, -0.1).cross(Vec3(-0.5 * kPullOfPushes / 4 * slip));
    }
  }
  bodies[0].given = {.force = force, .torque = torque};
  const std::vector<ContactPush> pushes = contactPushes(world, bodies, 0);
  ASSERT_EQ(pushes.size(), 4U);
  for (const ContactPush& push : pushes) {
    const Vec3 slip = Vec3(0.3 - 2 * push.point.y(), 2 * push.point.x(), 0).normalized();
    EXPECT_LT((push.force - Vec3(0, 0, 2.5) + 1.25 * slip).norm(), 1e-12);
  }
}

// A box that hangs by a ball joint and one that lies beside it: the joint's force is not told, and the lying
// box has all its weight.
TEST(ContactPushes, takeTheForcesOfJointsIntoAccount) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("hangs", Vec3::Constant(0.25), 2, Vec3(0, 0, 2)), 0.5),
                  rough(box("lies", Vec3::Constant(0.25), 2, Vec3(2, 0, 0.25)), 0.5)};
  test::join(world, Joint::Kind::kBall, 0, {}, Vec3(0, 0, 2.25));
  const std::vector<ContactPush> pushes = contactPushes(world, atRest(world), 0);
  ASSERT_EQ(pushes.size(), 4U);
  for (const ContactPush& push : pushes) {
    EXPECT_EQ(push.a.value, 1);
    EXPECT_LT((push.force - Vec3(0, 0, 5)).norm(), 1e-12);
  }
}

// A body of two legs and a plate: its eight corners on the floor lie alike on both sides, and bear alike.
TEST(ContactPushes, ofABodyOfSeveralBoxesAreAtTheCornersOfEach) {
  World world = onFloor(0.5);
  Body table = rough(box("table", Vec3(0.5, 0.25, 0.25), 8, Vec3(0, 0, 0.25)), 0.5);
  setParts(table, {{.halfExtents = Vec3(0.1, 0.25, 0.2), .center = Vec3(-0.4, 0, -0.05)},
                   {.halfExtents = Vec3(0.1, 0.25, 0.2), .center = Vec3(0.4, 0, -0.05)},
                   {.halfExtents = Vec3(0.5, 0.25, 0.05), .center = Vec3(0, 0, 0.2)}});
  world.bodies = {table};
  const std::vector<ContactPush> pushes = contactPushes(world, atRest(world), 0);
  ASSERT_EQ(pushes.size(), 8U);
  for (const ContactPush& push : pushes) {
    EXPECT_LT((push.force - Vec3(0, 0, 10)).norm(), 1e-12);
    EXPECT_NEAR(std::fabs(std::fabs(push.point.x()) - 0.4), 0.1, 1e-15);
  }
}

// Nothing holds it: so much is left of its weight.
TEST(ContactPushes, tellWhatNothingGives) {
  World world = onFloor(0.5);
  world.bodies = {box("floats", Vec3::Constant(0.25), 2, Vec3(0, 0, 2))};
  const std::vector<ContactPush> pushes = contactPushes(world, atRest(world), 0);
  ASSERT_EQ(pushes.size(), 1U);
  EXPECT_FALSE(pushes[0].b.has_value());
  EXPECT_TRUE(pushes[0].force.isZero(0));
  EXPECT_NEAR(pushes[0].left, 20, 1e-12);
}

}  // namespace
}  // namespace careen
