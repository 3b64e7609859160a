// Models that use every notation, as they are read here and by MuJoCo.
#include "exchange/import_mjcf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/in_mujoco.h"
#include "support/random_mjcf.h"
#include "support/random_mjcf_joints.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

/// The largest differences between what MuJoCo makes of a model and what is made of it here.
struct Differences {
  double position = 0;  // [m]
  double attitude = 0;
  double size = 0;     // relative
  double mass = 0;     // relative
  double inertia = 0;  // relative
  double inertiaOfSeveral = 0;
  double moments = 0;  // relative
  double velocity = 0;
  double plane = 0;

  static void most(double& of, double found) { of = found <= of ? of : found; }  // NaN counts

  // `xml` as it is read here, with `same` as MuJoCo reads it; there, all may be fixed.
  void compare(const std::string& xml, const std::string& same) {
    const RunSetup setup =
        setupOf(parseScene(importMjcf(xml, "m.xml").text, "m.xml (its scene)", Starts::kMayOverlap));
    InMujoco other(same);
    mjModel* const model = other.model.get();
    mjData* const data = other.data.get();
    mj_kinematics(model, data);
    mj_comPos(model, data);
    mj_comVel(model, data);
    std::size_t colliding = 0;
    for (int geom = 0; geom < model->ngeom; ++geom) {
      colliding += model->geom_contype[geom] != 0 || model->geom_conaffinity[geom] != 0 ? 1 : 0;
    }
    ASSERT_EQ(colliding, setup.world.bodies.size() + setup.world.walls.size());
    const auto matrixOf = [](const mjtNum* m) {
      Mat3 matrix;
      matrix << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
      return matrix;
    };
    for (const Body& body : setup.world.bodies) {
      const int geom = mj_name2id(model, mjOBJ_GEOM, body.name.c_str());
      ASSERT_GE(geom, 0) << body.name;
      const Pose pose = boxPose(body, body.initial.pose);
      most(position, (pose.position - Eigen::Map<const Vec3>(data->geom_xpos + 3 * geom)).norm());
      most(attitude, (pose.worldFromBody - matrixOf(data->geom_xmat + 9 * geom)).norm());
      most(size, (body.halfExtents - Eigen::Map<const Vec3>(model->geom_size + 3 * geom)).norm());
      const int id = model->geom_bodyid[geom];
      if (xml == same) {
        ASSERT_EQ(isImmovable(body.mass), model->body_weldid[id] == 0) << body.name;
      }
      if (isImmovable(body.mass)) {
        continue;
      }
      most(mass, std::fabs(body.mass.mass / model->body_mass[id] - 1));
      const Mat3 axes = matrixOf(data->ximat + 9 * id);
      const Mat3 inertiaThere =
          axes * Eigen::Map<const Vec3>(model->body_inertia + 3 * id).asDiagonal() * axes.transpose();
      const Mat3 inertiaHere =
          pose.worldFromBody * body.mass.inertiaTensor() * pose.worldFromBody.transpose();
      // MuJoCo finds the principal axes of several geoms to 1e-6, and so their moments to 1e-12.
      most(model->body_geomnum[id] > 1 ? inertiaOfSeveral : inertia,
           (inertiaHere - inertiaThere).norm() / inertiaThere.norm());
      Vec3 here = body.mass.inertiaBody;
      Vec3 there = Eigen::Map<const Vec3>(model->body_inertia + 3 * id);
      std::sort(here.begin(), here.end());
      std::sort(there.begin(), there.end());
      most(moments, (here - there).norm() / there.norm());
      most(position, (body.initial.pose.position - Eigen::Map<const Vec3>(data->xipos + 3 * id)).norm());
      std::array<mjtNum, 6> speeds{};
      mj_objectVelocity(model, data, mjOBJ_GEOM, geom, speeds.data(), 0);
      most(velocity,
           (angularVelocity(body.mass, body.initial) - Vec3(speeds[0], speeds[1], speeds[2])).norm());
      most(velocity, (boxVelocity(body, body.initial) - Vec3(speeds[3], speeds[4], speeds[5])).norm());
    }
    for (const Wall& wall : setup.world.walls) {
      const int geom = mj_name2id(model, mjOBJ_GEOM, wall.name.c_str());
      ASSERT_GE(geom, 0) << wall.name;
      const Vec3 normal = matrixOf(data->geom_xmat + 9 * geom).col(2);
      most(plane, (wall.normal - normal).norm());
      most(plane, std::fabs(wall.offset - normal.dot(Eigen::Map<const Vec3>(data->geom_xpos + 3 * geom))));
    }
    const bool isOff = (model->opt.disableflags & mjDSBL_GRAVITY) != 0;
    const Vec3 gravity = isOff ? Vec3(Vec3::Zero()) : Vec3(Eigen::Map<const Vec3>(model->opt.gravity));
    most(plane, (setup.world.gravity - gravity).norm());
  }
};

void expectSmall(const Differences& found) {
  std::cout << "position " << found.position << " attitude " << found.attitude << " size " << found.size
            << " mass " << found.mass << " inertia " << found.inertia << " of several "
            << found.inertiaOfSeveral << " moments " << found.moments << " velocity " << found.velocity
            << " planes " << found.plane << '\n';
  EXPECT_LT(found.position, 5e-14);         // measured: 1.7e-14, of frames in frames
  EXPECT_LT(found.attitude, 3e-14);         // 6.1e-15
  EXPECT_LT(found.size, 2e-15);             // 4.4e-16, of boxes between two points
  EXPECT_LT(found.mass, 5e-15);             // 6.7e-16
  EXPECT_LT(found.inertia, 2e-14);          // 2.2e-15
  EXPECT_LT(found.inertiaOfSeveral, 5e-6);  // 8.3e-7
  EXPECT_LT(found.moments, 3e-12);          // 1.0e-12
  EXPECT_LT(found.velocity, 5e-13);         // 2.1e-14
  EXPECT_LT(found.plane, 5e-14);            // 8.9e-15
}

TEST(ImportMjcf, saysOfRandomModelsWhatMujocoSays) {
  Differences found;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const std::string xml = RandomMjcf(seed).text();
    ASSERT_NO_THROW(found.compare(xml, xml)) << seed << "\n" << xml;
    ASSERT_LT(std::max({found.position, found.attitude, found.inertia, found.moments, found.velocity}), 1e-6)
        << seed << "\n"
        << xml;
  }
  expectSmall(found);
}

// MuJoCo 2.2.2 has no <frame> and no <replicate>.
TEST(ImportMjcf, framesAndCopiesAreWhereFixedBodiesWouldBe) {
  Differences found;
  std::size_t frames = 0;
  std::size_t copies = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const std::string xml = RandomMjcf(seed, RandomMjcf::Frames::kWritten).text();
    const std::string same = RandomMjcf(seed, RandomMjcf::Frames::kAsBodies).text();
    frames += xml.find("<frame") != std::string::npos ? 1 : 0;
    copies += xml.find("<replicate") != std::string::npos ? 1 : 0;
    ASSERT_NO_THROW(found.compare(xml, same)) << seed << "\n" << xml << same;
    ASSERT_LT(std::max({found.position, found.attitude, found.inertia, found.moments, found.velocity}), 1e-6)
        << seed << "\n"
        << xml << same;
  }
  EXPECT_GT(frames, 300U);
  EXPECT_GT(copies, 200U);
  expectSmall(found);
}

// ---- Joints

TEST(ImportMjcf, saysOfRandomJointsWhatMujocoSays) {
  Differences found;
  double limits = 0;
  std::size_t limited = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string xml = RandomMjcfJoints(seed, RandomMjcfJoints::Limits::kYes).text();
    ASSERT_NO_THROW(found.compare(xml, xml)) << seed << "\n" << xml;
    ASSERT_LT(std::max({found.position, found.attitude, found.inertia, found.moments, found.velocity}), 1e-6)
        << seed << "\n"
        << xml;
    const RunSetup setup = setupOf(parseScene(importMjcf(xml, "m.xml").text, "m.xml", Starts::kMayOverlap));
    InMujoco other(xml);
    mj_forward(other.model.get(), other.data.get());
    for (const Joint& joint : setup.world.joints) {
      if (!joint.hasCoordinate()) {
        continue;
      }
      const int id = mj_name2id(other.model.get(), mjOBJ_JOINT, joint.name.c_str());
      ASSERT_GE(id, 0) << joint.name;
      const auto poseOf = [&](const JointEnd& end) {
        return end.body ? setup.world.bodies[static_cast<std::size_t>(*end.body)].initial.pose : Pose{};
      };
      const int place = other.model->jnt_qposadr[id];
      Differences::most(
          found.position,
          std::fabs(jointCoordinate(joint, poseOf(joint.from), poseOf(joint.to)) - other.data->qpos[place]));
      Differences::most(found.position, (joint.from.pointAt(poseOf(joint.from)) -
                                         Eigen::Map<const Vec3>(other.data->xanchor + 3 * id))
                                                .norm() *
                                            (joint.kind == Joint::Kind::kHinge ? 1 : 0));
      Differences::most(found.attitude, (joint.to.axesAt(poseOf(joint.to)).col(2) -
                                         Eigen::Map<const Vec3>(other.data->xaxis + 3 * id))
                                            .norm());
      EXPECT_EQ(std::isfinite(joint.lowest), other.model->jnt_limited[id] != 0) << xml;
      if (std::isfinite(joint.lowest)) {
        ++limited;
        Differences::most(limits, std::fabs(joint.lowest - other.model->jnt_range[2 * id]));
        Differences::most(limits, std::fabs(joint.highest - other.model->jnt_range[2 * id + 1]));
      }
      EXPECT_EQ(joint.stiffness, other.model->jnt_stiffness[id]);
      EXPECT_EQ(joint.damping, other.model->dof_damping[other.model->jnt_dofadr[id]]);
      if (joint.stiffness > 0) {
        Differences::most(limits, std::fabs(joint.rest - other.model->qpos_spring[place]));
      }
    }
  }
  std::cout << limited << " limits " << limits << '\n';
  EXPECT_GT(limited, 100U);
  EXPECT_LT(limits, 1e-15);
  expectSmall(found);
}

// Attitudes of MuJoCo are of second order in its step.
TEST(ImportMjcf, randomJointsMoveAsInMujoco) {
  double most = 0;
  double mostRatio = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string xml = RandomMjcfJoints(seed, RandomMjcfJoints::Limits::kNo).text();
    Scene scene = parseScene(importMjcf(xml, "m.xml").text, "m.xml", Starts::kMayOverlap);
    scene.settings.duration = 0.1;
    scene.settings.tolerance = 1e-9;
    const Trajectory run = record(setupOf(scene));
    const auto error = [&](double step) {
      InMujoco other(xml);
      other.model->opt.timestep = step;
      other.model->opt.integrator = mjINT_RK4;
      other.stepTo(0.1);
      double off = 0;
      for (std::size_t i = 0; i < run.world.bodies.size(); ++i) {
        const int geom = mj_name2id(other.model.get(), mjOBJ_GEOM, run.world.bodies[i].name.c_str());
        const Pose pose = run.boxPoseAt(i, 0.1);
        Differences::most(off,
                          (pose.position - Eigen::Map<const Vec3>(other.data->geom_xpos + 3 * geom)).norm());
      }
      return off;
    };
    const double coarse = error(1e-3);
    const double fine = error(2.5e-4);
    Differences::most(most, fine);
    Differences::most(mostRatio, fine > 1e-9 ? fine / coarse : 0);
  }
  std::cout << "after 0.1 s " << most << " ratio " << mostRatio << '\n';
  EXPECT_LT(most, 1e-5);
  EXPECT_LT(mostRatio, 0.1);
}

}  // namespace
}  // namespace careen
