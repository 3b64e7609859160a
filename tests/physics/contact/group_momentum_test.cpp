#include "physics/contact/group_momentum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/impact_scene.h"
#include "support/quad.h"

namespace careen {
namespace {

using Quad3 = Vector3<Quad>;

struct RandomGroup {
  explicit RandomGroup(test::Random& random) {
    const int count = 1 + static_cast<int>(random.between(0, 6));
    for (int i = 0; i < count; ++i) {
      masses.push_back(solidBox({random.between(.1, 1), random.between(.1, 1), random.between(.1, 1)},
                                std::pow(10.0, random.between(-1, 3))));
      spins.push_back(random.inCube(3));
      BodyState state;
      state.pose = {random.inCube(5), random.rotation()};
      state.velocity = random.inCube(4);
      states.push_back(state);
    }
    turn();
  }
  void turn() {
    for (std::size_t i = 0; i < masses.size(); ++i) {
      states[i].angularMomentum = angularMomentum(masses[i], states[i].pose.worldFromBody, spins[i]);
    }
  }
  std::vector<GroupMember> members() const {
    std::vector<GroupMember> members;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      members.push_back({.mass = &masses[i], .state = states[i]});
    }
    return members;
  }
  std::vector<MassProperties> masses;
  std::vector<Vec3> spins;
  std::vector<BodyState> states;
};

// About the origin, in quadruple precision.
struct Momenta {
  Quad3 place = Quad3::Zero();  // mass times place
  Quad3 linear = Quad3::Zero();
  Quad3 angular = Quad3::Zero();
};
Momenta momentaOf(const std::vector<GroupMember>& members) {
  Momenta sum;
  for (const auto& [mass, state] : members) {
    const Quad3 x = state.pose.position.cast<Quad>();
    const Quad3 p = Quad(mass->mass) * state.velocity.cast<Quad>();
    sum.place += Quad(mass->mass) * x;
    sum.linear += p;
    sum.angular += x.cross(p) + state.angularMomentum.cast<Quad>();
  }
  return sum;
}

// Bodies that were left alone for a while but were moved and turned at random on top of it: the rigid motion
// gives them the momenta of free fall, and changes no relative velocity but as one rigid body would.
TEST(GroupMomentum, isKeptByARigidMotion) {
  test::Random random(7);
  for (int round = 0; round < 2000; ++round) {
    RandomGroup group(random);
    const std::vector<GroupMember> before = group.members();
    const Vec3 gravity = random.inCube(10);
    const Vec3 slope = round % 2 == 0 ? Vec3(Vec3::Zero()) : Vec3(random.inCube(20));
    const double h = random.between(0, 0.1);
    for (std::size_t i = 0; i < group.states.size(); ++i) {
      group.states[i].pose.position += random.inCube(1e-3);
      group.states[i].pose.worldFromBody = random.rotation();
      group.states[i].velocity += random.inCube(0.1);
      group.spins[i] += random.inCube(0.1);
    }
    group.turn();
    const auto change = changeTo(momentumOf(before), h, gravity, momentumOf(group.members()), slope);
    ASSERT_TRUE(change);
    for (std::size_t i = 0; i < group.states.size(); ++i) {
      group.states[i].velocity += change->velocityAt(group.states[i].pose.position);
      group.states[i].pose.position += change->shift;
      group.spins[i] += change->turning;
    }
    group.turn();
    const Momenta from = momentaOf(before);
    const Momenta to = momentaOf(group.members());
    Quad mass = 0;
    for (const MassProperties& each : group.masses) {
      mass += Quad(each.mass);
    }
    const Quad3 g = gravity.cast<Quad>();
    const Quad3 s = slope.cast<Quad>();
    const Quad t(h);
    const Quad3 place = from.place + t * from.linear + mass * (t * t / 2 * g + t * t * t / 6 * s);
    const Quad3 linear = from.linear + mass * (t * g + t * t / 2 * s);
    // Weight acts at the centre of mass: about the origin it turns the group by m x × g.
    const Quad3 angular = from.angular + (t * from.place + t * t / 2 * from.linear).cross(g) +
                          (t * t / 2 * from.place + t * t * t / 3 * from.linear).cross(s) +
                          mass * (t * t * t * t / 12) * g.cross(s);
    const double scale = static_cast<double>(mass) * 30;
    EXPECT_LT(static_cast<double>((to.place - place).norm()), 1e-15 * scale) << round;
    EXPECT_LT(static_cast<double>((to.linear - linear).norm()), 1e-15 * scale) << round;
    EXPECT_LT(static_cast<double>((to.angular - angular).norm()), 4e-15 * scale) << round;
    EXPECT_FALSE(changeTo(momentumOf(group.members()), 0, gravity, momentumOf(group.members())));
  }
}

TEST(GroupMomentum, doesNotDependOnTheOrder) {
  test::Random random(8);
  for (int round = 0; round < 500; ++round) {
    const RandomGroup group(random);
    std::vector<GroupMember> members = group.members();
    const GroupMomentum one = momentumOf(members);
    std::reverse(members.begin(), members.end());
    const GroupMomentum other = momentumOf(members);
    EXPECT_EQ(one.center, other.center);
    EXPECT_EQ(one.velocity, other.velocity);
    EXPECT_EQ(one.spin, other.spin);
    EXPECT_EQ(one.inertia, other.inertia);
  }
}

TEST(GroupMomentum, isOfBodiesThatOnlyPushEachOther) {
  const auto pair = [](int a, int b) { return ContactFeature{.a = a, .b = b}; };
  const auto body = [](std::optional<int> of) { return SpringEnd{.body = of, .point = {}}; };
  World world;
  world.bodies.resize(13);
  world.springs = {{.from = body(8), .to = body(10)},
                   {.from = body(10), .to = body(9)},
                   {.from = body(11), .to = body(std::nullopt)},
                   {.from = body(6), .to = body(12)}};
  std::vector<TouchingBody> bodies;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    world.bodies[i].mass = i == 6 ? MassProperties{} : solidBox({1, 1, 1}, 1);
    bodies.push_back({.body = &world.bodies[i], .index = static_cast<int>(i)});
  }
  const Wall wall;
  bodies.push_back(touchingBody(wall));  // 13
  // 0-3 on nothing; 1-2 with 2 on a wall; 4 on the held 6; 5 alone; 7 alone. Springs join 8, 9 and 10; 11
  // hangs from a point, 12 from 6.
  const std::vector<ContactFeature> pushing{pair(3, 0), pair(1, 2), pair(2, 13), pair(6, 4)};
  const std::vector<std::vector<std::size_t>> expected{{0, 3}, {5}, {7}, {8, 9, 10}};
  EXPECT_EQ(freeGroups(world, bodies, pushing), expected);
}

}  // namespace
}  // namespace careen
