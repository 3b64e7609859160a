#include "trajectory/export_csv.h"

#include <string>
#include <vector>

#include "core/brief.h"
#include "core/csv.h"
#include "trajectory/exporter.h"
#include "trajectory/pose_samples.h"

namespace careen {
namespace {

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

}  // namespace

void writePosesCsv(const Trajectory& trajectory, double every, const TextSink& sink) {
  const std::vector<double> times = sampleTimes(trajectory, every);
  std::string header;
  for (const std::string_view column : kPoseColumns) {
    header.append(header.empty() ? "" : ",").append(column);
  }
  sink(header + "\n");
  for (const double time : times) {
    for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
      const PoseRow pose = poseRow(trajectory, body, time);
      std::string row = rowAt(time) + "," + csvCell(trajectory.world.bodies[body].name);
      append(row, pose.position);
      append(row, pose.worldFromBody.w());
      append(row, Vec3(pose.worldFromBody.vec()));
      append(row, pose.velocity);
      append(row, pose.angularVelocity);
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

extern const Exporter kCsvExporter;
constexpr Exporter kCsvExporter = {.suffix = ".csv",
                                   .about = "a table of poses",
                                   .option = ExportOption::kEvery,
                                   .write = [](const Trajectory& run, const ExportSettings& settings,
                                               const TextSink& sink) -> std::vector<std::string> {
                                     writePosesCsv(run, settings.every, sink);
                                     return {};
                                   }};

}  // namespace careen
