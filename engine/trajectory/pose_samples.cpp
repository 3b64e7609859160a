#include "trajectory/pose_samples.h"

#include <algorithm>
#include <cmath>

#include "core/brief.h"
#include "core/error.h"

namespace careen {
namespace {

constexpr double kMostSamples = 1e8;  // of a table of poses

Quat quaternionOf(const Mat3& worldFromBody) {
  Quat q(worldFromBody);
  for (const double part : {q.w(), q.x(), q.y(), q.z()}) {
    if (part != 0) {
      return part > 0 ? q : Quat(-q.w(), -q.x(), -q.y(), -q.z());
    }
  }
  return q;
}

}  // namespace

std::vector<double> sampleTimes(const Trajectory& trajectory, double every) {
  const double duration = trajectory.settings.duration;
  if (!(every > 0 && std::isfinite(every))) {
    throw InputError("poses are written every " + std::to_string(every) +
                     " s, expected a positive number of seconds");
  }
  if (duration / every > kMostSamples) {
    throw InputError("poses are written every " + brief(every) + " s, which makes more than " +
                     brief(kMostSamples) + " samples; expected a longer time between them");
  }
  constexpr double kRounding = 1e-12;  // of the time: 24 · 0.05 misses 1.2 by it
  std::vector<double> times;
  for (std::size_t k = 0;; ++k) {
    const double time = static_cast<double>(k) * every;
    if (time > duration * (1 + kRounding)) {
      return times;
    }
    times.push_back(std::min(time, duration));
  }
}

PoseRow poseRow(const Trajectory& trajectory, std::size_t body, double time) {
  const BodyState state = trajectory.state(body, time);
  const Body& moved = trajectory.world.bodies[body];
  PoseRow row;
  row.time = time;
  row.box = body;
  row.position = boxPose(moved, state.pose).position;
  row.worldFromBody = quaternionOf(state.pose.worldFromBody);
  row.velocity = boxVelocity(moved, state);
  row.angularVelocity = angularVelocity(moved.mass, state);
  return row;
}

}  // namespace careen
