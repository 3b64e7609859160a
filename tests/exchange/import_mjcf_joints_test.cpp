// Joints of scenes and of MuJoCo's models, as they come in.
#include "exchange/import_mjcf_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "core/brief.h"
#include "exchange/export_mjcf.h"
#include "exchange/import_mjcf.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/in_mujoco.h"
#include "support/input_error.h"
#include "support/random_jointed.h"
#include "support/random_mjcf_joints.h"
#include "support/same_joints.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

RunSetup setupThatMayOverlap(const std::string& text) {
  return setupOf(parseScene(text, "test", Starts::kMayOverlap));
}
nlohmann::json sceneOfModel(const std::string& elements, const std::string& before = "") {
  return nlohmann::json::parse(
      importMjcf("<mujoco>" + before + "<worldbody>" + elements + "</mujoco>", "m.xml").text);
}
std::string refusalOfJoints(const std::string& elements, const std::string& before = "") {
  return inputErrorOf([&] { sceneOfModel(elements, before); });
}
const std::string kJointedBox = R"(<geom type="box" size="0.1 0.2 0.3"/>)";

std::set<std::pair<std::string, std::string>> apartIn(const World& world) {
  std::set<std::pair<std::string, std::string>> names;
  for (const auto& [a, b] : world.apart) {
    names.insert(std::minmax(world.bodies[static_cast<std::size_t>(a)].name,
                             world.bodies[static_cast<std::size_t>(b)].name));
  }
  return names;
}

// A box that a fixed joint holds in the world is a fixed one in MuJoCo: there is none in these.
TEST(ImportMjcfJoints, scenesComeBackFromMjcf) {
  JointDifference joints;
  double bodies = 0;
  double velocities = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RandomJointed::With with{.limits = true, .loops = seed % 2 == 0, .contacts = seed % 3 == 0};
    const World first = setupThatMayOverlap(RandomJointed(seed, with).text()).world;
    RunSetup setup = setupThatMayOverlap(RandomJointed(seed, with).text());
    const World second = setupThatMayOverlap(importMjcf(encodeMjcf(setup, "test").text, "m.xml").text).world;
    joints.compare(first, second);
    std::map<std::string, const Body*> found;
    for (const Body& body : second.bodies) {
      found[body.name] = &body;
    }
    ASSERT_EQ(found.size(), first.bodies.size());
    for (const Body& a : first.bodies) {
      ASSERT_TRUE(found.contains(a.name));
      const Body& b = *found[a.name];
      EXPECT_EQ(a.mass.mass, b.mass.mass) << seed << a.name;
      JointDifference::most(bodies, (a.mass.inertiaTensor() - b.mass.inertiaTensor()).norm());
      JointDifference::most(bodies, (a.initial.pose.position - b.initial.pose.position).norm());
      JointDifference::most(bodies, (a.initial.pose.worldFromBody - b.initial.pose.worldFromBody).norm());
      if (seed % 2 != 0) {  // without loops, whose velocities joints do not allow
        JointDifference::most(velocities, (a.initial.velocity - b.initial.velocity).norm());
        JointDifference::most(
            velocities, (angularVelocity(a.mass, a.initial) - angularVelocity(b.mass, b.initial)).norm());
      }
      EXPECT_EQ(a.halfExtents, b.halfExtents);
      EXPECT_NEAR(a.material.friction, b.material.friction, 1e-15);
    }
    const auto apart = apartIn(first);
    for (const auto& pair : apart) {
      EXPECT_TRUE(apartIn(second).contains(pair)) << seed << pair.first << pair.second;
    }
  }
  std::cout << joints.count << " joints, places " << joints.place << " coordinates " << joints.coordinate
            << " bodies " << bodies << " velocities " << velocities << '\n';
  EXPECT_LT(velocities, 1e-13);
  EXPECT_GT(joints.count, 1000U);
  EXPECT_GT(joints.asBalls, 5U);
  EXPECT_LT(joints.place, 1e-13);
  EXPECT_LT(joints.coordinate, 1e-13);
  EXPECT_LT(bodies, 1e-13);
}

TEST(ImportMjcfJoints, aBodyInAnotherIsJoined) {
  const nlohmann::json scene = sceneOfModel(R"(
    <body name="arm" pos="1 0 0"><joint name="shoulder" pos="-0.5 0 0" axis="0 2 0" range="-90 45" ref="30"
        damping="0.5" frictionloss="0.75" stiffness="2" springref="60"/>)" +
                                            kJointedBox + R"(
      <body name="hand" pos="1 0 0"><joint type="slide" axis="1 0 0"/>)" +
                                            kJointedBox + R"(
        <body name="ring" pos="0 0 0.1">)" + kJointedBox +
                                            R"(</body></body>
      <body name="ball" pos="0 1 0"><joint type="ball"/>)" +
                                            kJointedBox + R"(</body></body>
    <geom name="post" type="box" size="1 1 1" pos="9 0 0"/></worldbody>)");
  ASSERT_EQ(scene["joints"].size(), 4U);
  const nlohmann::json& shoulder = scene["joints"][0];
  EXPECT_EQ(shoulder["name"], "shoulder");
  EXPECT_EQ(shoulder["between"], (nlohmann::json{"arm", "world"}));
  EXPECT_EQ(shoulder["at"], (nlohmann::json{0.5, 0.0, 0.0}));
  EXPECT_EQ(shoulder["axis"], (nlohmann::json{0.0, 1.0, 0.0}));
  const double degree = std::atan(1) / 45;
  EXPECT_NEAR(shoulder["start"].get<double>(), 30 * degree, 1e-15);
  EXPECT_NEAR(shoulder["range"][0].get<double>(), -90 * degree, 1e-15);
  EXPECT_NEAR(shoulder["range"][1].get<double>(), 45 * degree, 1e-15);
  EXPECT_EQ(shoulder["spring"]["stiffness"], 2);
  EXPECT_NEAR(shoulder["spring"]["rest"].get<double>(), 60 * degree, 1e-15);
  EXPECT_EQ(shoulder["damping"], 0.5);
  EXPECT_EQ(shoulder["friction"], 0.75);
  EXPECT_EQ(scene["joints"][1]["type"], "slider");
  EXPECT_EQ(scene["joints"][1]["name"], "hand");
  EXPECT_EQ(scene["joints"][1]["between"], (nlohmann::json{"hand", "arm"}));
  EXPECT_EQ(scene["joints"][2]["type"], "fixed");
  EXPECT_EQ(scene["joints"][3]["type"], "ball");
  EXPECT_EQ(scene["joints"][3]["at"], (nlohmann::json{1.0, 1.0, 0.0}));
  // The ring is one with the hand, and so goes through the arm too.
  EXPECT_EQ(scene["pass_through"], nlohmann::json::parse(R"([["arm", "ring"]])"));
}

TEST(ImportMjcfJoints, ropesRodsAndMotors) {
  const std::string body =
      R"(<site name="hook" pos="0 0 3"/><body name="b"><joint name="j" type="slide" axis="0 0 1"/>)" +
      kJointedBox + R"(<site name="on b"/></body></worldbody>)";
  const std::string sites = R"(<site site="on b"/><site site="hook"/></spatial>)";
  const nlohmann::json scene = sceneOfModel(body + "<tendon><spatial name=\"t\" range=\"0 3.5\">" + sites +
                                                "<spatial name=\"r\">" + sites +
                                                R"(</tendon><equality><tendon tendon1="r"/></equality>
      <actuator><motor joint="j"/><position joint="j" kp="8" gear="2" forcerange="-3 3"/><velocity joint="j" kv="0.5"/></actuator>
      <keyframe><key name="start" ctrl="0 0.5 0"/></keyframe>)",
                                            R"(<option timestep="0.005"/>)");
  ASSERT_EQ(scene["joints"].size(), 3U);
  EXPECT_EQ(scene["joints"][1]["type"], "rope");
  EXPECT_EQ(scene["joints"][1]["length"], 3.5);
  EXPECT_EQ(scene["joints"][1]["points"], (nlohmann::json{{0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}}));
  EXPECT_EQ(scene["joints"][2]["type"], "rod");
  EXPECT_EQ(scene["joints"][2]["length"], 3.0);
  EXPECT_FALSE(scene.contains("springs"));
  EXPECT_EQ(scene["control"]["period"], 0.005);
  // A gear of 2: the actuator's length is 2 q, and its force doubled. 2 · 8 (0.5 − 2 q) = 32 (0.25 − q).
  ASSERT_EQ(scene["control"]["motors"].size(), 2U);
  EXPECT_EQ(scene["control"]["motors"][0],
            (nlohmann::json{{"joint", "j"}, {"kp", 32.0}, {"kd", 0.0}, {"target", 0.25}, {"max", 6.0}}));
  EXPECT_EQ(scene["control"]["motors"][1], (nlohmann::json{{"joint", "j"}, {"kp", 0.0}, {"kd", 0.5}}));
}

TEST(ImportMjcfJoints, refusesRopesThatAreTooShort) {
  const std::string body = R"(<site name="hook" pos="0 0 3"/><body name="b"><freejoint/>)" + kJointedBox +
                           R"(<site name="on b"/></body></worldbody>)";
  const std::string sites = R"(<site site="on b"/><site site="hook"/></spatial></tendon>)";
  EXPECT_NE(refusalOfJoints(body + "<tendon><spatial range=\"0 2.5\">" + sites)
                .find("found a length of 2.5 m between points that start 3 m apart"),
            std::string::npos);
  EXPECT_NE(refusalOfJoints(body + "<tendon><spatial range=\"1 5\">" + sites)
                .find("found range=\"1 5\" for <spatial>"),
            std::string::npos);
  EXPECT_NE(refusalOfJoints(body + "<tendon><spatial name=\"t\">" + sites +
                            R"(<equality><tendon tendon1="t"/></equality>
                       <keyframe><key name="start" qpos="0 0 1 1 0 0 0"/></keyframe>)")
                .find("found a length of 3 m between points that start 2 m apart"),
            std::string::npos);
}

// What MuJoCo's own parser could not nest is cut, and joined all the same.
TEST(ImportMjcfJoints, longChainsComeBack) {
  std::string boxes;
  std::string joints;
  for (int i = 0; i < 100; ++i) {
    const std::string place = inFull(-0.1 * i);
    const std::string separator = i == 0 ? "" : ", ";
    boxes += separator + R"({ "name": "b)" + std::to_string(i) +
             R"(", "half_extents": [0.05, 0.05, 0.05], "mass": 1, "position": [0, 0, )" + place + "] }";
    joints += separator + R"({ "name": "j)" + std::to_string(i) + R"(", "type": "ball", "between": ["b)" +
              std::to_string(i) + R"(", ")" + (i == 0 ? "world" : "b" + std::to_string(i - 1)) +
              R"("], "at": [0, 0, )" + inFull(0.05 - 0.1 * i) + "] }";
  }
  const RunSetup setup = setupThatMayOverlap(R"({ "careen": 1, "duration": 1, "boxes": [)" + boxes +
                                             R"(], "joints": [)" + joints + "] }");
  const MjcfFile file = encodeMjcf(setup, "test");
  EXPECT_TRUE(file.leftOut.empty());
  InMujoco other(file.text);
  EXPECT_EQ(other.model->neq, 1);
  JointDifference difference;
  difference.compare(setup.world, setupThatMayOverlap(importMjcf(file.text, "m.xml").text).world);
  EXPECT_EQ(difference.count, 100U);
  EXPECT_LT(difference.place, 1e-13);
}

// A pendulum that motors drive from 0.25 rad towards 1 rad: held for a time step here, but not in MuJoCo.
TEST(ImportMjcfJoints, actuatorsDriveAsInMujoco) {
  const auto error = [](const std::string& step) {
    const std::string xml =
        R"(<mujoco><compiler angle="radian" autolimits="true"/><option integrator="RK4" timestep=")" + step +
        R"("/><worldbody><body name="b"><joint name="j" axis="0 1 0" pos="0 0 1"/>
      <geom name="b" type="box" size="0.1 0.1 0.5" mass="1"/></body></worldbody>
    <actuator><position joint="j" kp="40" forcerange="-15 15"/><velocity joint="j" kv="2"/></actuator>
    <keyframe><key name="start" qpos="0.25" qvel="1" ctrl="1 0"/></keyframe></mujoco>)";
    Scene scene = parseScene(importMjcf(xml, "m.xml").text, "m.xml", Starts::kMayOverlap);
    scene.settings.duration = 1;
    scene.settings.tolerance = 1e-8;
    const Trajectory run = record(setupOf(scene));
    InMujoco other(xml);
    other.stepTo(1);
    const Vec3 place = run.boxPoseAt(0, 1).position;
    EXPECT_GT(place.head<2>().norm(), 0.5) << "it is driven up";
    return (place - other.position("b")).norm();
  };
  const double coarse = error("0.001");
  const double fine = error("0.00025");
  std::cout << "off by " << coarse << ", " << fine << '\n';
  EXPECT_LT(coarse, 3e-3);  // measured: 1.4e-3, of first order in the time step
  EXPECT_NEAR(fine / coarse, 0.25, 0.01);
}

// No byte of a file makes the reader do anything but read it or refuse it, and what it reads is a scene.
TEST(ImportMjcfJoints, damagedFilesEndInAMessage) {
  std::mt19937 random(11);
  std::size_t refused = 0;
  for (unsigned trial = 0; trial < 3000; ++trial) {
    std::string xml = RandomMjcfJoints(trial % 100, RandomMjcfJoints::Limits::kYes).text();
    for (unsigned i = 0; i < 1 + trial % 3; ++i) {
      damage(xml, random);
    }
    std::string scene;
    if (inputErrorOf([&] { scene = importMjcf(xml, "m.xml").text; }) != "no error") {
      ++refused;
    } else {
      EXPECT_EQ(inputErrorOf([&] { setupOf(parseScene(scene, "m.xml", Starts::kMayOverlap)); }), "no error")
          << xml;
    }
  }
  EXPECT_GT(refused, 1000U);
}

}  // namespace
}  // namespace careen
