#include "physics/contact/implicit_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/contact/joint_rows.h"
#include "support/jointed.h"

namespace careen {
namespace {

TouchingBody bodyOf(const World& world, int index) {
  const Body& body = world.bodies[static_cast<std::size_t>(index)];
  return {.body = &body, .index = index, .position = body.initial.pose.position};
}

GroupState stateOf(const World& world) {
  GroupState state;
  for (const Body& body : world.bodies) {
    state.push_back({.position = body.initial.pose.position,
                     .worldFromBody = Quat(body.initial.pose.worldFromBody),
                     .velocity = body.initial.velocity,
                     .angularMomentum = body.initial.angularMomentum});
  }
  state.resize(world.bodies.size() + world.walls.size());
  return state;
}

// A cube on a floor, all four corners in contact.
struct CubeOnFloor {
  explicit CubeOnFloor(double friction, const Vec3& velocity) {
    world.gravity = Vec3(0, 0, -10);
    world.walls.push_back({.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = {}});
    world.bodies.push_back(box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.1), velocity));
    for (int k = 0; k < kCorners; ++k) {
      const Vec3 at = corner(world.bodies[0].halfExtents, k);
      if (at.z() < 0) {
        contacts.push_back({.feature = {.a = 0, .b = 1, .onA = at}});
        contacts.back().feature.material.friction = friction;
      }
    }
    bodies = {bodyOf(world, 0), touchingBody(world.walls[0])};
  }
  GroupState after(double length, int steps) {
    ImplicitStep step(world, bodies, 1e-9);
    GroupState state = stateOf(world);
    for (int k = 0; k < steps; ++k) {
      GroupState next;
      EXPECT_TRUE(step.advance(state, length / steps, contacts, next));
      state = next;
    }
    return state;
  }
  World world;
  std::vector<TouchingBody> bodies;
  std::vector<ClosedContact> contacts;
};

TEST(ImplicitStep, slidesByTheParabolaOfItsFriction) {
  CubeOnFloor scene(0.2, Vec3(1, 0, 0));  // 2 m/s² back
  const GroupState end = scene.after(0.25, 5);
  EXPECT_NEAR(end[0].velocity.x(), 0.5, 1e-12);
  EXPECT_NEAR(end[0].position.x(), 0.25 - 0.0625, 1e-12);
  EXPECT_NEAR(end[0].position.z(), 0.1, 1e-12);
}

// A wheel of I = 1.2 kg m² at 3 rad/s, whose axle keeps to 0.5 rad/s by up to 1.5 N m: 1.25 rad/s per second,
// until it has the speed within the fifth step of 0.5 s.
TEST(ImplicitStep, aGripTakesWhatItsForceGivesInAStep) {
  World world;
  world.gravity = Vec3::Zero();
  world.bodies = {box("wheel", Vec3(0.3, 0.3, 0.1), 20, Vec3(1, 2, 3), Vec3::Zero(), Vec3(0, 0, 3))};
  Joint& axle = test::join(world, Joint::Kind::kHinge, 0, {}, Vec3(1, 2, 3));
  axle.grip = 1.5;
  axle.keptRate = 0.5;
  const std::vector<TouchingBody> bodies{bodyOf(world, 0), touchingBody(nowhere())};
  std::vector<ClosedContact> contacts;
  for (const ContactFeature& feature :
       jointFeatures(world, 0, [](const JointEnd& end) { return end.body ? 0 : 1; })) {
    contacts.push_back({.feature = feature});
  }
  ASSERT_EQ(contacts.size(), 3U);  // a point, an axis and a grip
  ImplicitStep step(world, bodies, 1e-9);
  GroupState state = stateOf(world);
  state.resize(2);
  for (int k = 1; k <= 6; ++k) {
    GroupState next;
    ASSERT_TRUE(step.advance(state, 0.5, contacts, next));
    state = next;
    EXPECT_NEAR(state[0].angularMomentum[2] / 1.2, std::max(0.5, 3 - 0.625 * k), 1e-12) << k;
    EXPECT_LE((state[0].position - Vec3(1, 2, 3)).norm(), 1e-12);
  }
}

// It stops after 0.5 s and 0.25 m, within a step: the error is of the second order in its length.
TEST(ImplicitStep, stopsWithAnErrorOfTheSecondOrder) {
  std::vector<double> errors;
  for (const int steps : {7, 14, 28, 56}) {
    CubeOnFloor scene(0.2, Vec3(1, 0, 0));
    const GroupState end = scene.after(0.77, steps);
    // Measured 1.7e-8 two long steps after the stop, whose first estimates are by the forces before it.
    EXPECT_LT(end[0].velocity.norm(), steps == 7 ? 2e-8 : 1e-9) << steps;
    errors.push_back(std::fabs(end[0].position.x() - 0.25));
  }
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double h = 0.77 / (7 << k);
    EXPECT_LT(errors[k], 0.25 * h * h * 2 * 1.01) << k;  // a quarter of a h² at most: the mean of two speeds
  }
}

// A cube that falls about an edge that sticks keeps its energy: to the second order in the length of the
// steps, or to the first if that is all that is asked for.
TEST(ImplicitStep, isOfTheOrderThatIsAskedFor) {
  using Order = ImplicitStep::Order;
  const auto errorOf = [](Order order, int steps) {
    CubeOnFloor scene(10, Vec3::Zero());
    std::erase_if(scene.contacts, [](const ClosedContact& at) { return at.feature.onA.x() > 0; });
    Body& cube = scene.world.bodies[0];
    Pose& pose = cube.initial.pose;
    pose.worldFromBody = Eigen::AngleAxisd(0.3, Vec3::UnitY()).toRotationMatrix();
    pose.position.z() = -(pose.worldFromBody * Vec3(-0.1, 0, -0.1)).z();
    TouchingBody touching = bodyOf(scene.world, 0);
    touching.worldFromBody = Quat(pose.worldFromBody);
    const std::vector<TouchingBody> bodies{touching, touchingBody(scene.world.walls[0])};
    const auto energy = [&](const GroupBody& at) {
      const Vec3 spin = cube.mass.inverseInertiaTimes(at.worldFromBody.conjugate() * at.angularMomentum);
      return 0.5 * at.velocity.squaredNorm() + 0.5 * spin.dot(cube.mass.inertiaTimes(spin)) +
             10 * at.position.z();
    };
    ImplicitStep step(scene.world, bodies, 1e-9);
    GroupState state = stateOf(scene.world);
    const double before = energy(state[0]);
    for (int k = 0; k < steps; ++k) {
      GroupState next;
      EXPECT_TRUE(step.advance(state, 0.2 / steps, scene.contacts, next, order));
      state = next;
    }
    return std::fabs(energy(state[0]) - before);
  };
  const double second = errorOf(Order::kSecond, 32) / errorOf(Order::kSecond, 64);
  const double first = errorOf(Order::kFirst, 32) / errorOf(Order::kFirst, 64);
  EXPECT_GT(second, 3.5);
  EXPECT_GT(first, 1.7);
  EXPECT_LT(first, 2.5);
  EXPECT_LT(errorOf(Order::kSecond, 64), errorOf(Order::kFirst, 64) / 4);
}

// Two bodies that collide and push: what one loses the other gains, about any point.
TEST(ImplicitStep, exchangesMomentaToRounding) {
  World world;
  world.bodies.push_back(
      box("a", Vec3(0.1, 0.2, 0.3), 1, Vec3(0.3, 0.05, -0.04), Vec3(-1, 0.2, 0), Vec3(1, 2, 3)));
  world.bodies.push_back(
      box("b", Vec3(0.2, 0.3, 0.4), 50, Vec3(0, 0, 0), Vec3(0.3, 0, 0.1), Vec3(0.1, 0, 0)));
  const std::vector<TouchingBody> bodies{bodyOf(world, 0), bodyOf(world, 1)};
  std::vector<ClosedContact> contacts(1);
  contacts[0].feature = {
      .kind = ContactFeature::Kind::kPointOnFace, .a = 0, .b = 1, .onA = {-0.1, 0.2, 0.3}, .axisB = 0};
  contacts[0].feature.material.friction = 0.7;
  ImplicitStep step(world, bodies, 1e-9);
  const GroupState from = stateOf(world);
  GroupState to;
  ASSERT_TRUE(step.advance(from, 1e-3, contacts, to));
  EXPECT_GT(contacts[0].push, 100);
  const auto momenta = [&](const GroupState& state) {
    std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 momentum = world.bodies[i].mass.mass * state[i].velocity;
      sums[0] += momentum;
      sums[1] += state[i].position.cross(momentum) + state[i].angularMomentum;
    }
    return sums;
  };
  EXPECT_LT((momenta(to)[0] - momenta(from)[0]).norm(), 1e-14);
  EXPECT_LT((momenta(to)[1] - momenta(from)[1]).norm(), 1e-14);
}

TEST(ImplicitStep, movesApartWhatIsDeep) {
  CubeOnFloor scene(0, Vec3::Zero());
  ImplicitStep step(scene.world, scene.bodies, 1e-9);
  GroupState state = stateOf(scene.world);
  state[0].position.z() -= 1e-5;
  std::vector<ContactFeature> features;
  for (const ClosedContact& contact : scene.contacts) {
    features.push_back(contact.feature);
  }
  ASSERT_TRUE(step.separate(state, features, 1e-9));
  EXPECT_NEAR(state[0].position.z(), 0.1, 1e-9);
  EXPECT_LT((state[0].worldFromBody.toRotationMatrix() - Mat3::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace careen
