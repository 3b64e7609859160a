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

namespace careen {
namespace {

/// The largest differences between what MuJoCo makes of a model and what is made of it here.
struct Differences {
  double position = 0;  // [m]
  double attitude = 0;
  double size = 0;     // relative
  double mass = 0;     // relative
  double inertia = 0;  // relative
  double velocity = 0;
  double plane = 0;

  static void most(double& of, double found) { of = found <= of ? of : found; }  // NaN counts

  void compare(const std::string& xml) {
    const RunSetup setup =
        setupOf(parseScene(importMjcf(xml, "m.xml").text, "m.xml (its scene)", Starts::kMayOverlap));
    InMujoco other(xml);
    mjModel* const model = other.model.get();
    mjData* const data = other.data.get();
    mj_forward(model, data);
    ASSERT_EQ(static_cast<std::size_t>(model->ngeom), setup.world.bodies.size() + setup.world.walls.size());
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
      ASSERT_EQ(isImmovable(body.mass), model->body_dofnum[id] == 0) << body.name;
      if (isImmovable(body.mass)) {
        continue;
      }
      most(mass, std::fabs(body.mass.mass / model->body_mass[id] - 1));
      const Mat3 axes = matrixOf(data->ximat + 9 * id);
      const Mat3 inertiaThere =
          axes * Eigen::Map<const Vec3>(model->body_inertia + 3 * id).asDiagonal() * axes.transpose();
      const Mat3 inertiaHere =
          pose.worldFromBody * body.mass.inertiaTensor() * pose.worldFromBody.transpose();
      most(inertia, (inertiaHere - inertiaThere).norm() / inertiaThere.norm());
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
    most(plane, (setup.world.gravity - Eigen::Map<const Vec3>(model->opt.gravity)).norm());
  }
};

TEST(ImportMjcf, saysOfRandomModelsWhatMujocoSays) {
  Differences found;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const std::string xml = RandomMjcf(seed).text();
    ASSERT_NO_THROW(found.compare(xml)) << seed << "\n" << xml;
    ASSERT_LT(std::max({found.position, found.attitude, found.inertia, found.velocity}), 1e-6) << seed << "\n"
                                                                                               << xml;
  }
  std::cout << "position " << found.position << " attitude " << found.attitude << " size " << found.size
            << " mass " << found.mass << " inertia " << found.inertia << " velocity " << found.velocity
            << " planes " << found.plane << '\n';
  EXPECT_LT(found.position, 3e-14);  // measured: 5.1e-15
  EXPECT_LT(found.attitude, 3e-14);  // 3.7e-15
  EXPECT_EQ(found.size, 0);
  EXPECT_LT(found.mass, 2e-15);      // 3.3e-16
  EXPECT_LT(found.inertia, 2e-14);   // 2.3e-15
  EXPECT_LT(found.velocity, 5e-13);  // 5.3e-14
  EXPECT_LT(found.plane, 3e-14);     // 4.4e-15
}

}  // namespace
}  // namespace careen
