#include "trajectory/export_csv.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>

#include "core/brief.h"
#include "core/csv.h"
#include "core/error.h"

namespace careen {
namespace {

constexpr double kMostSamples = 1e8;  // of a table of poses

void append(std::string& row, double value) {
  constexpr int kDigits = 17;  // round-trips a double
  row += ',' + brief(value, kDigits);
}

void append(std::string& row, const Vec3& vector) {
  for (int i = 0; i < 3; ++i) {
    append(row, vector[i]);
  }
}

// A row starts with its time, without a comma before it.
std::string rowAt(double time) {
  std::string row;
  append(row, time);
  return row.substr(1);
}

// Sample k is at k · every; one that misses the end by rounding, as 24 · 0.05 does 1.2, is at the end.
std::optional<double> sampleTime(std::size_t sample, double every, double duration) {
  constexpr double kRounding = 1e-12;  // of the time
  const double time = static_cast<double>(sample) * every;
  if (time > duration * (1 + kRounding)) {
    return std::nullopt;
  }
  return std::min(time, duration);
}

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

void writePosesCsv(const Trajectory& trajectory, double every, const TextSink& sink) {
  if (!(every > 0 && std::isfinite(every))) {
    throw InputError("poses are written every " + std::to_string(every) +
                     " s, expected a positive number of seconds");
  }
  if (trajectory.settings.duration / every > kMostSamples) {
    throw InputError("poses are written every " + brief(every) + " s, which makes more than " +
                     brief(kMostSamples) + " samples; expected a longer time between them");
  }
  sink("time,box,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
  for (std::size_t sample = 0;; ++sample) {
    const std::optional<double> moment = sampleTime(sample, every, trajectory.settings.duration);
    if (!moment) {
      return;
    }
    const double time = *moment;
    for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
      const Body& moved = trajectory.world.bodies[body];
      const BodyState state = trajectory.state(body, time);
      const Quat q = quaternionOf(state.pose.worldFromBody);
      std::string row = rowAt(time) + "," + csvCell(moved.name);
      append(row, state.pose.position);
      append(row, q.w());
      append(row, Vec3(q.vec()));
      append(row, state.velocity);
      append(row, angularVelocity(moved.mass, state));
      sink(row + "\n");
    }
  }
}

void writeImpactsCsv(const Trajectory& trajectory, const TextSink& sink) {
  sink("time,a,b,x,y,z,nx,ny,nz,approach,impulse,tangential\n");
  for (const Impact& impact : trajectory.impacts) {
    std::string row = rowAt(impact.time) + "," +
                      csvCell(trajectory.world.bodies.at(static_cast<std::size_t>(impact.a.value)).name) +
                      "," + csvCell(trajectory.partnerName(impact));
    append(row, impact.point);
    append(row, impact.normal);
    append(row, impact.approach);
    append(row, impact.impulse);
    append(row, impact.tangential);
    sink(row + "\n");
  }
}

}  // namespace careen
