#include "study/world_description.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "physics/world/given_inertia.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

using Described = nlohmann::ordered_json;

// A quarter of a turn about z: the quaternion (1, 0, 0, 1) / √2.
TEST(WorldDescription, saysAllThatAWorldHas) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {{.name = "floor",
                  .normal = Vec3::UnitZ(),
                  .offset = -2,
                  .material = {.restitution = 0.25, .friction = 0.5}}};
  world.bodies = {makeBox({.halfExtents = Vec3(1, 2, 3),
                           .position = Vec3(4, 5, 6),
                           .velocity = Vec3(7, 8, 9),
                           .angularVelocity = Vec3(0.5, 0.25, 2),
                           .name = "crate"})};
  Body& body = world.bodies[0];
  body.material = {.restitution = 0.75, .friction = 0.125};
  body.boxCenter = Vec3(0.5, 0, -0.5);
  body.mass = solidBox(Vec3(1, 2, 3), 12);  // M/3 (b² + c²), …: 4 · 13, 4 · 10, 4 · 5
  body.initial.pose.worldFromBody = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix();
  body.initial.angularMomentum =
      angularMomentum(body.mass, body.initial.pose.worldFromBody, Vec3(0.5, 0.25, 2));
  const Described said = descriptionOf(world);
  EXPECT_EQ(said["gravity"].dump(), "[0.0,0.0,-9.81]");
  EXPECT_EQ(said["walls"].dump(),
            R"([{"normal":[0.0,0.0,1.0],"offset":-2.0,"restitution":0.25,"friction":0.5}])");
  ASSERT_EQ(said["boxes"].size(), 1U);
  const Described& box = said["boxes"][0];
  EXPECT_EQ(box["name"], "crate");
  EXPECT_EQ(box["half_extents"].dump(), "[1.0,2.0,3.0]");
  EXPECT_EQ(box["middle"].dump(), "[0.5,0.0,-0.5]");
  EXPECT_EQ(box["restitution"], 0.75);
  EXPECT_EQ(box["friction"], 0.125);
  EXPECT_EQ(box["fixed"], false);
  EXPECT_EQ(box["mass"], 12);
  EXPECT_EQ(box["position"].dump(), "[4.0,5.0,6.0]");
  EXPECT_EQ(box["velocity"].dump(), "[7.0,8.0,9.0]");
  EXPECT_EQ(box["axes"].dump(), "[1.0,0.0,0.0,0.0]");
  const auto expectNear = [&box](const char* key, const std::vector<double>& expected) {
    ASSERT_EQ(box[key].size(), expected.size()) << key;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(box[key][k].get<double>(), expected[k], 1e-14) << key;
    }
  };
  expectNear("orientation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)});
  expectNear("moments", {52, 40, 20});
  expectNear("angular_velocity", {0.5, 0.25, 2});
}

// The tensor that a reader makes of moments and axes is the body's.
TEST(WorldDescription, saysWhereTheMomentsPoint) {
  World world;
  world.bodies = {makeBox({})};
  Mat3 tensor = Vec3(2, 3, 4).asDiagonal();
  tensor(0, 1) = tensor(1, 0) = 0.5;
  world.bodies[0].mass = massWithTensor(1, tensor);
  const Described said = descriptionOf(world);
  const Described& box = said["boxes"][0];
  const auto number = [&box](const char* key, std::size_t k) { return box[key][k].get<double>(); };
  const Mat3 axes =
      Quat(number("axes", 0), number("axes", 1), number("axes", 2), number("axes", 3)).toRotationMatrix();
  const Vec3 moments(number("moments", 0), number("moments", 1), number("moments", 2));
  EXPECT_LT((axes * moments.asDiagonal() * axes.transpose() - tensor).norm(), 1e-14);
}

// A part turned by 90° about z whose middle is at (0, 2, 0) along its own axes: at (−2, 0, 0) in the body's.
TEST(WorldDescription, listsTheBoxesOfABody) {
  World world;
  world.bodies = {makeBox({})};
  EXPECT_FALSE(descriptionOf(world)["boxes"][0].contains("parts"));
  BodyPart turned{.halfExtents = Vec3(0.5, 0.25, 1), .center = Vec3(0, 2, 0), .turned = true};
  turned.bodyFromPart << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  setParts(world.bodies[0], {{.halfExtents = Vec3(1, 2, 3), .center = Vec3(0, 0, 1)}, turned});
  const Described said = descriptionOf(world);
  const Described& parts = said["boxes"][0]["parts"];
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].dump(),
            R"({"half_extents":[1.0,2.0,3.0],"middle":[0.0,0.0,1.0],"orientation":[1.0,0.0,0.0,0.0]})");
  EXPECT_EQ(parts[1]["half_extents"].dump(), "[0.5,0.25,1.0]");
  EXPECT_EQ(parts[1]["middle"].dump(), "[-2.0,0.0,0.0]");
  EXPECT_NEAR(parts[1]["orientation"][3].get<double>(), std::sqrt(0.5), 1e-15);
}

TEST(WorldDescription, saysOfFixedBoxesOnlyWhereTheyAre) {
  World world;
  world.bodies = {makeBox({.name = "table"})};
  world.bodies[0].mass = immovable();
  const Described said = descriptionOf(world);
  EXPECT_EQ(said["boxes"][0]["fixed"], true);
  EXPECT_TRUE(said["boxes"][0].contains("position"));
  EXPECT_FALSE(said["boxes"][0].contains("mass"));
  EXPECT_TRUE(said["walls"].empty());
}

}  // namespace
}  // namespace careen
