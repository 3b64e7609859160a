// Joints as MuJoCo reads them.
#include "exchange/export_mjcf_joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <set>
#include <string>
#include <utility>

#include "exchange/export_mjcf.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/in_mujoco.h"
#include "support/random_jointed.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

RunSetup setupForMujoco(const std::string& text) {
  return setupOf(parseScene(text, "test", Starts::kMayOverlap));
}
MjcfJoints encodedJointsOf(const std::string& text) {
  const RunSetup setup = setupForMujoco(text);
  return encodeJoints(setup.world, treeOf(setup.world));
}
std::string boxNamed(const std::string& name, const std::string& more) {
  return R"({ "name": ")" + name + R"(", "half_extents": [0.1, 0.2, 0.2], "mass": 1)" + more + " }";
}

// ---- By hand

TEST(ExportMjcfJoints, aHingeHasItsCoordinateAndSpring) {
  const MjcfJoints joints = encodedJointsOf(R"({ "careen": 1, "duration": 1, "boxes": [)" +
                                            boxNamed("a", R"(, "position": [1, 0, 0])") + R"(],
    "joints": [ { "name": "h", "type": "hinge", "between": ["world", "a"], "at": [0.5, 0, 2], "axis": [0, 0, 1], "start": 0.25,
      "range": [-1, 1.5], "spring": { "stiffness": 3, "rest": 0.5 }, "damping": 0.125, "friction": 0.25 } ] })");
  // Of the world relative to the box about z: of the box about -z.
  EXPECT_EQ(joints.ofBody[0].substr(0, joints.ofBody[0].find(" ref")),
            R"(<joint name="h" type="hinge" pos="-0.5 0 2" axis="0 0 -1")");
  EXPECT_NE(
      joints.ofBody[0].find(
          R"(limited="true" range="-1 1.5" stiffness="3" springref="0.5" frictionloss="0.25" damping="0.125"/>)"),
      std::string::npos)
      << joints.ofBody[0];
  EXPECT_NEAR(std::stod(joints.places), 0.25, 1e-15);
  EXPECT_TRUE(joints.leftOut.empty());
}

TEST(ExportMjcfJoints, whatClosesLoopsRopesRodsAndMotors) {
  const std::string two =
      boxNamed("a", R"(, "position": [1, 0, 0])") + ", " + boxNamed("b", R"(, "position": [2, 0, 0])");
  const MjcfJoints joints =
      encodedJointsOf(R"({ "careen": 1, "duration": 1, "boxes": [)" + two + R"(], "joints": [
      { "name": "ball", "type": "ball", "between": ["a", "world"], "at": [0.5, 0, 0] },
      { "name": "slide", "type": "slider", "between": ["a", "b"], "at": [1.5, 0, 0], "axis": [1, 0, 0] },
      { "name": "weld", "type": "fixed", "between": ["b", "world"] },
      { "name": "rope", "type": "rope", "between": ["a", "world"], "points": [[0, 0, 0], [1, 0, 4]], "length": 5 },
      { "name": "rod", "type": "rod", "between": ["a", "b"], "points": [[0, 0, 0], [0, 0, 0]], "until": 0.5 } ],
    "control": { "period": 0.01, "motors": [ { "joint": "slide", "kp": 1, "max": 4 } ] } })");
  // The slider and the weld are the tree: b in the world, a in b.
  EXPECT_EQ(joints.ofBody[1], "");
  EXPECT_NE(joints.ofBody[0].find("type=\"slide\""), std::string::npos);
  EXPECT_EQ(joints.equalities,
            (std::vector<std::string>{R"(<connect name="ball" body1="a" anchor="-0.5 0 0"/>)",
                                      R"(<tendon tendon1="rod"/>)"}));
  ASSERT_EQ(joints.tendons.size(), 2U);
  EXPECT_EQ(joints.tendons[0],
            R"(<spatial name="rope" limited="true" range="0 5"><site site="joint 3 from"/>)"
            R"(<site site="joint 3 to"/></spatial>)");
  EXPECT_EQ(joints.actuators,
            std::vector<std::string>{R"(<motor joint="slide" ctrllimited="true" ctrlrange="-4 4"/>)"});
  EXPECT_EQ(joints.leftOut, (std::vector<std::string>{"what motors aim at", "when joints let go"}));
  EXPECT_EQ(joints.excludes, std::vector<std::string>{R"(<exclude body1="a" body2="b"/>)"})
      << "to MuJoCo b does not move, and so meets what is in it";
}

TEST(ExportMjcfJoints, tellsWhatLoopsAndVelocitiesItLeavesOut) {
  const std::string two = boxNamed("a", R"(, "position": [1, 0, 0], "velocity": [0, 0, 1])") + ", " +
                          boxNamed("b", R"(, "position": [2, 0, 0])");
  const std::string slider = R"("type": "slider", "axis": [1, 0, 0], "at": [1.5, 0, 0], )";
  const MjcfJoints joints =
      encodedJointsOf(R"({ "careen": 1, "duration": 1, "boxes": [)" + two + R"(], "joints": [
      { )" + slider + R"("between": ["a", "b"] }, { )" +
                      slider + R"("between": ["b", "world"] },
      { )" + slider + R"("between": ["a", "world"] } ] })");
  EXPECT_EQ(joints.leftOut, (std::vector<std::string>{"joint-2, a slider that closes a loop or long chain",
                                                      "velocities that joints do not allow"}));
}

// ---- Beside MuJoCo

struct Largest {
  double place = 0;     // [m] and of matrices, at the start
  double velocity = 0;  // [m/s], [rad/s]
  double gaps = 0;      // of what closes loops
  static void most(double& of, double found) { of = found <= of ? of : found; }  // NaN counts
};

void compareStartsWith(const RunSetup& setup, InMujoco& other, Largest& largest) {
  mjModel* const model = other.model.get();
  mjData* const data = other.data.get();
  mj_resetDataKeyframe(model, data, 0);
  mj_forward(model, data);
  for (const Body& body : setup.world.bodies) {
    const Pose pose = boxPose(body, body.initial.pose);
    Largest::most(largest.place, (other.position(body.name) - pose.position).norm());
    Largest::most(largest.place, (other.attitude(body.name) - pose.worldFromBody).norm());
    std::array<mjtNum, 6> speeds{};
    mj_objectVelocity(model, data, mjOBJ_XBODY, other.body(body.name), speeds.data(), 0);
    Largest::most(largest.velocity,
                  (angularVelocity(body.mass, body.initial) - Vec3(speeds[0], speeds[1], speeds[2])).norm());
    Largest::most(largest.velocity,
                  (boxVelocity(body, body.initial) - Vec3(speeds[3], speeds[4], speeds[5])).norm());
  }
}

TEST(ExportMjcfJoints, treesStartAsInMujoco) {
  Largest largest;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RunSetup setup = setupForMujoco(RandomJointed(seed, {.limits = true}).text());
    const MjcfFile file = encodeMjcf(setup, "test");
    ASSERT_TRUE(file.leftOut.empty()) << file.leftOut[0];
    InMujoco other(file.text);
    compareStartsWith(setup, other, largest);
    // As the model stands it starts.
    std::vector<Vec3> places;
    for (const Body& body : setup.world.bodies) {
      places.push_back(other.position(body.name));
    }
    mj_resetData(other.model.get(), other.data.get());
    mj_kinematics(other.model.get(), other.data.get());
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_LT((other.position(setup.world.bodies[i].name) - places[i]).norm(), 1e-14);
    }
    // Limits and springs by joint.
    for (const Joint& joint : setup.world.joints) {
      const int id = mj_name2id(other.model.get(), mjOBJ_JOINT, joint.name.c_str());
      ASSERT_EQ(id >= 0, joint.kind != Joint::Kind::kFixed);
      if (joint.hasCoordinate()) {
        const bool isLimited = std::isfinite(joint.lowest);
        EXPECT_EQ(other.model->jnt_limited[id] != 0, isLimited);
        if (isLimited) {
          EXPECT_EQ(other.model->jnt_range[2 * id], joint.lowest);
          EXPECT_EQ(other.model->jnt_range[2 * id + 1], joint.highest);
        }
        EXPECT_EQ(other.model->jnt_stiffness[id], joint.stiffness);
        EXPECT_EQ(other.model->qpos_spring[other.model->jnt_qposadr[id]],
                  joint.stiffness == 0 ? 0 : joint.rest);
        EXPECT_EQ(other.model->dof_damping[other.model->jnt_dofadr[id]], joint.damping);
      }
    }
  }
  std::cout << "places " << largest.place << " velocities " << largest.velocity << '\n';
  EXPECT_LT(largest.place, 1e-13);
  EXPECT_LT(largest.velocity, 1e-12);
}

// Without limits and loops, which are soft in MuJoCo. Its attitudes are of second order in its step.
TEST(ExportMjcfJoints, treesMoveAsInMujoco) {
  double most = 0;
  double mostRatio = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RunSetup setup = setupForMujoco(RandomJointed(seed, {}).text());
    const Trajectory run = record(setup);
    const std::string xml = encodeMjcf(setup, "test").text;
    const auto error = [&](double step) {
      InMujoco other(xml);
      other.model->opt.timestep = step;
      other.stepTo(0.1);
      double off = 0;
      for (std::size_t i = 0; i < run.world.bodies.size(); ++i) {
        const Pose pose = run.boxPoseAt(i, 0.1);
        const std::string& name = run.world.bodies[i].name;
        Largest::most(off, (other.position(name) - pose.position).norm());
        Largest::most(off, (other.attitude(name) - pose.worldFromBody).norm());
      }
      return off;
    };
    const double coarse = error(1e-3);
    const double fine = error(2.5e-4);
    Largest::most(most, fine);
    Largest::most(mostRatio, fine > 1e-9 ? fine / coarse : 0);
  }
  std::cout << "after 0.1 s " << most << " ratio " << mostRatio << '\n';
  EXPECT_LT(most, 1e-5);
  EXPECT_LT(mostRatio, 0.1);
}

// What overlaps touches in MuJoCo if and only if it may touch here.
TEST(ExportMjcfJoints, theSameBoxesMayTouchInMujoco) {
  std::size_t touching = 0;
  std::size_t passing = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RunSetup setup = setupForMujoco(RandomJointed(seed, {.contacts = true}).text());
    const MjcfTree tree = treeOf(setup.world);
    std::string xml = encodeMjcf(setup, "test").text;
    xml.insert(xml.find("<option"), R"(<size njmax="100" nconmax="1000"/>)");
    InMujoco other(xml);
    mj_kinematics(other.model.get(), other.data.get());
    mj_comPos(other.model.get(), other.data.get());
    mj_collision(other.model.get(), other.data.get());
    std::set<std::pair<std::string, std::string>> found;
    for (int i = 0; i < other.data->ncon; ++i) {
      const mjContact& contact = other.data->contact[i];
      const std::string one = mj_id2name(other.model.get(), mjOBJ_GEOM, contact.geom1);
      const std::string two = mj_id2name(other.model.get(), mjOBJ_GEOM, contact.geom2);
      found.insert(std::minmax(one, two));
    }
    for (std::size_t i = 0; i < setup.world.bodies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (tree.oneWith[i] != tree.oneWith[j]) {  // they can never meet
          const bool may = mayTouch(setup.world, static_cast<int>(i), static_cast<int>(j));
          const std::pair<std::string, std::string> pair =
              std::minmax(setup.world.bodies[i].name, setup.world.bodies[j].name);
          EXPECT_EQ(found.contains(pair), may) << seed << ' ' << pair.first << ' ' << pair.second;
          ++(may ? touching : passing);
        }
      }
    }
  }
  EXPECT_GT(touching, 1000U);
  EXPECT_GT(passing, 1000U);
}

// Equalities hold at the start.
TEST(ExportMjcfJoints, loopsAreClosedInMujoco) {
  double most = 0;
  int equalities = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RunSetup setup = setupForMujoco(RandomJointed(seed, {.loops = true}).text());
    InMujoco other(encodeMjcf(setup, "test").text);
    mj_forward(other.model.get(), other.data.get());
    for (int i = 0; i < other.data->ne; ++i) {
      Largest::most(most, std::fabs(other.data->efc_pos[i]));
    }
    equalities += other.model->neq;
    for (std::size_t i = 0; i < setup.world.joints.size(); ++i) {
      const Joint& joint = setup.world.joints[i];
      if (joint.kind == Joint::Kind::kRope || joint.kind == Joint::Kind::kRod) {
        const int id = mj_name2id(other.model.get(), mjOBJ_TENDON, joint.name.c_str());
        ASSERT_GE(id, 0);
        Largest::most(most, std::fabs(other.data->ten_length[id] - joint.length));
        EXPECT_EQ(other.model->tendon_limited[id] != 0, joint.kind == Joint::Kind::kRope);
      }
    }
  }
  std::cout << equalities << " equalities, open by " << most << '\n';
  EXPECT_GT(equalities, 100);
  EXPECT_LT(most, 1e-14);
}

}  // namespace
}  // namespace careen
