#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/brief.h"
#include "physics/world/world.h"

namespace careen {

/// A table of poses (CSV) as another program might write it, after the start: columns in another order, no
/// rows of fixed boxes, every other quaternion of the other sign. `states` are [time][body].
inline std::string tableOf(const World& world, std::span<const double> times,
                           const std::vector<std::vector<BodyState>>& states) {
  std::string text = "box,time,qx,qy,qz,qw,x,y,z,wx,wy,wz,vx,vy,vz\n";
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] == 0 && k + 1 < times.size()) {
      continue;
    }
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const Body& body = world.bodies[i];
      if (isImmovable(body.mass)) {
        continue;
      }
      const BodyState& state = states[k][i];
      Quat q(state.pose.worldFromBody);
      q.coeffs() *= k % 2 == 0 ? 1 : -1;
      const Vec3 spin = angularVelocity(body.mass, state);
      text += body.name + "," + brief(times[k], 17);
      for (const double number : {q.x(), q.y(), q.z(), q.w(), state.pose.position.x(),
                                  state.pose.position.y(), state.pose.position.z(), spin.x(), spin.y(),
                                  spin.z(), state.velocity.x(), state.velocity.y(), state.velocity.z()}) {
        text += "," + brief(number, 17);
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace careen
