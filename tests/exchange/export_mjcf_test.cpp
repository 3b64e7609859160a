// The file as MuJoCo reads it.
#include "exchange/export_mjcf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/in_mujoco.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

RunSetup setupOfText(const std::string& text) { return setupOf(parseScene(text, "test")); }

TEST(ExportMjcf, isReadByMujocoAsItWasMeant) {
  const RunSetup setup = setupOfText(R"({ "careen": 1, "name": "a & b", "duration": 1, "gravity": [0, 1, -9],
    "walls": [ { "name": "ramp", "point": [0, 0, -1], "normal": [0.6, 0, 0.8], "friction": 0.25 } ],
    "boxes": [
      { "name": "crate", "half_extents": [0.5, 0.3, 0.2], "mass": 2, "inertia": [0.1, 0.2, 0.25], "position": [1, 2, 3],
        "orientation": [0.5, 0.5, -0.5, 0.5], "velocity": [1, 2, 3], "angular_velocity": [3, -2, 1], "friction": 0.36,
        "restitution": 0.5, "color": "#ff0080" },
      { "name": "<post>", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [5, 5, 5], "friction": 0.36 } ] })");
  const MjcfFile file = encodeMjcf(setup, "test");
  EXPECT_EQ(file.leftOut, std::vector<std::string>{"restitution, up to 0.5"});
  EXPECT_NE(file.text.find("Left out: restitution"), std::string::npos);
  InMujoco found(file.text);
  mj_forward(found.model.get(), found.data.get());
  EXPECT_EQ(found.model->opt.gravity[1], 1);
  EXPECT_EQ(found.model->nq, 7);
  const int crate = found.body("crate");
  EXPECT_EQ(found.model->body_mass[crate], 2);
  EXPECT_EQ(found.model->body_inertia[3 * crate + 2], 0.25);
  EXPECT_LT((found.position("crate") - Vec3(1, 2, 3)).norm(), 1e-15);
  EXPECT_LT((found.attitude("crate") - setup.world.bodies[0].initial.pose.worldFromBody).norm(), 1e-14);
  EXPECT_LT((found.position("<post>") - Vec3(5, 5, 5)).norm(), 1e-15);
  std::array<mjtNum, 6> velocity{};
  mj_objectVelocity(found.model.get(), found.data.get(), mjOBJ_BODY, crate, velocity.data(), 0);
  EXPECT_LT((Vec3(velocity[0], velocity[1], velocity[2]) - Vec3(3, -2, 1)).norm(), 1e-13);
  EXPECT_LT((Vec3(velocity[3], velocity[4], velocity[5]) - Vec3(1, 2, 3)).norm(), 1e-13);
  // The wall's plane: its z axis is the normal, and it goes through the wall's point.
  const int wall = mj_name2id(found.model.get(), mjOBJ_GEOM, "ramp");
  ASSERT_GE(wall, 0);
  const mjtNum* const m = found.data->geom_xmat + 9 * wall;
  EXPECT_LT((Vec3(m[2], m[5], m[8]) - Vec3(0.6, 0, 0.8)).norm(), 1e-14);
  const mjtNum* const at = found.data->geom_xpos + 3 * wall;
  EXPECT_NEAR(Vec3(at[0], at[1], at[2]).dot(Vec3(0.6, 0, 0.8)), -0.8, 1e-14);
  // Pairs: crate and wall sqrt(0.36 · 0.25), crate and post 0.36.
  ASSERT_EQ(found.model->npair, 2);
  EXPECT_NEAR(found.model->pair_friction[0], 0.3, 1e-15);
  EXPECT_NEAR(found.model->pair_friction[5], 0.36, 1e-15);
}

// The motion of a scene by MuJoCo, in smaller and smaller steps.
void expectTheSameMotion(const std::string& text) {
  const Trajectory run = record(setupOfText(text));
  const auto error = [&](double step, std::size_t body) {
    InMujoco other(encodeMjcf(run, "test").text);
    other.model->opt.timestep = step;
    other.stepTo(1);
    const Pose pose = run.boxPoseAt(body, 1);
    const std::string& name = run.world.bodies[body].name;
    return std::max((other.position(name) - pose.position).norm(),
                    (other.attitude(name) - pose.worldFromBody).norm());
  };
  // MuJoCo's attitudes are of second order in its step: it converges to what careen has.
  for (std::size_t body = 0; body < 2; ++body) {
    const double coarse = error(1e-3, body);
    const double fine = error(2.5e-4, body);
    EXPECT_LT(coarse, 1e-4) << body;       // measured: 3.2e-5
    EXPECT_LT(fine, coarse / 10) << body;  // measured: a sixteenth
    EXPECT_LT(fine, 5e-6) << body;         // measured: 2e-6
  }
}

TEST(ExportMjcf, flightAndSpringsMoveAsTheyDoHere) {
  expectTheSameMotion(R"({ "careen": 1, "duration": 1, "gravity": [0, 0, -9.81], "tolerance": 1e-9,
    "boxes": [
      { "name": "flies", "half_extents": [0.5, 0.3, 0.2], "mass": 2, "position": [0, 0, 3], "velocity": [1, 2, 3],
        "orientation": { "axis": [1, 2, 3], "angle_deg": 50 }, "angular_velocity": [3, -2, 1] },
      { "name": "hangs", "half_extents": [0.2, 0.2, 0.4], "mass": 1, "position": [5, 0, 0],
        "angular_velocity": [0, 2, 1] } ],
    "springs": [ { "from": ["hangs", [0.2, 0.2, 0.4]], "to": [5, 1, 2], "stiffness": 30, "damping": 0.4, "rest_length": 0.5 } ] })");
}

// Off their middles, and about axes of their own.
TEST(ExportMjcf, loadedBoxesFlyAndHangAsTheyDoHere) {
  expectTheSameMotion(R"({ "careen": 1, "duration": 1, "gravity": [0, 0, -9.81], "tolerance": 1e-9,
    "boxes": [
      { "name": "flies", "half_extents": [0.5, 0.3, 0.2], "mass": 2, "position": [0, 0, 3], "velocity": [1, 2, 3],
        "center": [0.2, -0.1, 0.15], "inertia": [[0.1, 0.02, -0.01], [0.02, 0.2, 0.03], [-0.01, 0.03, 0.25]],
        "orientation": { "axis": [1, 2, 3], "angle_deg": 50 }, "angular_velocity": [3, -2, 1] },
      { "name": "hangs", "half_extents": [0.2, 0.2, 0.4], "mass": 1, "position": [5, 0, 0],
        "center": [0.1, 0.05, -0.2], "angular_velocity": [0, 2, 1] } ],
    "springs": [ { "from": ["hangs", [0.2, 0.2, 0.4]], "to": [5, 1, 2], "stiffness": 30, "damping": 0.4, "rest_length": 0.5 } ] })");
}

TEST(ExportMjcf, oneFrictionNeedsNoPairsAndUnequalDragIsTold) {
  const std::string scene = R"({ "careen": 1, "duration": 1, "gravity": [0, 0, -9.81],
    "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "friction": 0.5 },
    "boxes": [ { "name": "a", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [0, 0, 1], "friction": 0.5 } ],
    "drag": { "linear": 0.5, "angular": )";
  const MjcfFile unequal = encodeMjcf(setupOfText(scene + "0.25 } }"), "test");
  EXPECT_EQ(unequal.leftOut, std::vector<std::string>{"drag: linear and angular differ"});
  const MjcfFile equal = encodeMjcf(setupOfText(scene + "0.5 } }"), "test");
  EXPECT_TRUE(equal.leftOut.empty());
  std::string loaded = scene + "0.5 } }";
  loaded.insert(loaded.find(R"("friction": 0.5 } ])"), R"("center": [0, 0, 0.05], )");
  EXPECT_EQ(encodeMjcf(setupOfText(loaded), "test").leftOut,
            std::vector<std::string>{"drag: a centre of mass is not its box's middle"});
  std::string changing = scene + "0.5 } }";
  changing.replace(changing.find("[0, 0, -9.81]"), 13, R"({ "path": [[0, 0, 0, -9.81], [1, 0, 0, 0]] })");
  EXPECT_EQ(encodeMjcf(setupOfText(changing), "test").leftOut,
            std::vector<std::string>{"how gravity changes"});
  std::string belt = scene + "0.5 } }";
  belt.insert(belt.find(R"("boxes")"),
              R"("walls": [ { "point": [0, 0, -3], "normal": [0, 0, 1], "friction": 0.5,
    "surface_velocity": [1, 0, 0] } ], )");
  EXPECT_EQ(encodeMjcf(setupOfText(belt), "test").leftOut,
            std::vector<std::string>{"how surfaces move along themselves"});
  const InMujoco found(equal.text);
  EXPECT_EQ(found.model->npair, 0);
  EXPECT_EQ(found.model->ngeom, 7);
  EXPECT_EQ(found.model->dof_damping[0], 0.5);
  EXPECT_EQ(found.model->geom_friction[0], 0.5);
}

}  // namespace
}  // namespace careen
