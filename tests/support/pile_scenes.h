#pragma once

#include <cstdint>
#include <string>

#include "physics/pile/solver.h"
#include "physics/world/world.h"
#include "support/physics_worlds.h"

namespace careen::test {

/// A linear congruential generator (Knuth's MMIX constants): the same scene everywhere.
class Pourer {
 public:
  explicit Pourer(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return low + (high - low) * static_cast<double>(state_ >> 11U) * 0x1p-53;
  }
  Vec3 vector(double low, double high) {
    const double x = between(low, high);
    const double y = between(low, high);
    return {x, y, between(low, high)};
  }
  Quat attitude() {
    Quat q(1, 0, 0, 0);
    do {
      const Vec3 v = vector(-1, 1);
      q = Quat(between(-1, 1), v.x(), v.y(), v.z());
    } while (q.squaredNorm() > 1 || q.squaredNorm() < 0.01);
    return q.normalized();
  }

 private:
  std::uint64_t state_;
};

/// `count` boxes of 0.4 to 0.6 m, in layers of 6 × 6, that fall into a pit of 6 × 6 m; all lengths times
/// `scale`, at the same gravity. Larger counts get a wider pit, so that the depth stays the same.
inline World pouring(int count, double friction = 0.5, double restitution = 0, double scale = 1,
                     int across = 6) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  const double half = across * 0.5;
  const auto wall = [&](const char* name, const Vec3& normal, double offset) {
    world.walls.push_back({.name = name,
                           .normal = normal,
                           .offset = scale * offset,
                           .material = {.restitution = restitution, .friction = friction}});
  };
  wall("floor", Vec3::UnitZ(), 0);
  wall("left", Vec3::UnitX(), -half);
  wall("right", -Vec3::UnitX(), -half);
  wall("front", Vec3::UnitY(), -half);
  wall("back", -Vec3::UnitY(), -half);
  Pourer pourer(1);
  for (int i = 0; i < count; ++i) {
    const int layer = i / (across * across);
    const int x = i % across;
    const int y = i / across % across;
    Body body;
    const std::string number = std::to_string(i);
    body.name = "box-" + std::string(6 - number.size(), '0') + number;
    body.halfExtents = scale * pourer.vector(0.2, 0.3);
    body.mass = solidBox(body.halfExtents, 1000 * 8 * body.halfExtents.prod());
    body.material = {.restitution = restitution, .friction = friction};
    const double spacing = 0.98;  // no box overlaps another or a wall
    const double askewX = pourer.between(-0.02, 0.02);
    const double askewY = pourer.between(-0.02, 0.02);
    body.initial.pose.position = scale * Vec3((x + 0.5 - half) * spacing + askewX,
                                              (y + 0.5 - half) * spacing + askewY, 0.6 + 1.04 * layer);
    body.initial.pose.worldFromBody = pourer.attitude().toRotationMatrix();
    world.bodies.push_back(body);
  }
  return world;
}

/// [m/s] v_n of the row as it stands.
inline double normalSpeed(const PileSolver& solver, int row) {
  const PileSolver::RowView view = solver.row(row);
  return dot(view.axes[0], solver.velocity(view.a) + solver.omega(view.a).cross(view.armA) -
                               solver.velocity(view.b) - solver.omega(view.b).cross(view.armB));
}

}  // namespace careen::test
