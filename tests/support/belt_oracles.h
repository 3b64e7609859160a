#pragma once

#include <span>
#include <stdexcept>
#include <vector>

#include "support/contact_oracles.h"
#include "support/quad_scene.h"

namespace careen::oracle {

/// Sliding as on a floor that is still, in the frame that moves with the belt.
inline QuadPoses onBelt(QuadBox box, const QuadVector& gravity, const QuadWall& plane,
                        std::span<const double> times) {
  box.velocity -= plane.belt;
  QuadPoses poses = QuadSlide(box, gravity, plane).poses(times);
  for (std::size_t k = 0; k < times.size(); ++k) {
    poses[k].position += Quad(times[k]) * plane.belt;
  }
  return poses;
}

/// Carried round by a turntable about z, as ω² r < μ g; from its velocity and spin on.
inline QuadPoses onTurntable(const QuadBox& box, const QuadVector& gravity, const QuadWall& table,
                             std::span<const double> times) {
  const Quad radius = sqrt(box.position[0] * box.position[0] + box.position[1] * box.position[1]);
  if (table.spin * table.spin * radius > -frictionOf(box, table) * gravity[2]) {
    throw std::invalid_argument("slides off");
  }
  QuadPoses poses;
  for (const double time : times) {
    const Quad half = table.spin * time / 2;
    const QuadTurn turn{cos(half), 0, 0, sin(half)};
    poses.push_back({turned(turn, box.position), careen::oracle::times(turn, box.attitude)});
  }
  return poses;
}

/// From rest on a level floor, along x: gravity has parts forward for some time. Friction holds, or rubs.
inline QuadPoses braked(const QuadBox& box, const QuadScene& scene, std::span<const double> times) {
  const Quad friction = frictionOf(box, scene.walls.at(0));
  QuadPoses poses;
  for (const double time : times) {
    Quad speed = 0;
    Quad way = 0;
    for (std::size_t k = 0; k < scene.gravities.size(); ++k) {
      const auto& [begin, gravity] = scene.gravities[k];
      const Quad next = k + 1 < scene.gravities.size() ? scene.gravities[k + 1].first : Quad(1e300);
      const Quad end = next < time ? next : Quad(time);
      const Quad rubs = -friction * gravity[2];
      if (!(end > begin) || (speed == 0 && gravity[0] <= rubs)) {
        continue;
      }
      const Quad rate = gravity[0] - rubs;
      const Quad stops = rate < 0 ? Quad(-speed / rate) : Quad(1e300);
      const Quad length = end - begin < stops ? Quad(end - begin) : stops;
      way += length * (speed + length / 2 * rate);
      speed = length < stops ? Quad(speed + length * rate) : Quad(0);
    }
    QuadVector position = box.position;
    position[0] += way;
    poses.push_back({position, box.attitude});
  }
  return poses;
}

}  // namespace careen::oracle
