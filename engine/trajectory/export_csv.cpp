#include "trajectory/export_csv.h"

#include <string>
#include <vector>

#include "core/table.h"
#include "trajectory/exporter.h"
#include "trajectory/pose_samples.h"

namespace careen {
void writePosesCsv(const Trajectory& trajectory, double every, const TextSink& sink) {
  const std::vector<double> times = sampleTimes(trajectory, every);
  CsvRow header;
  for (const std::string_view column : kPoseColumns) {
    header.add(column);
  }
  sink(header.line());
  for (const double time : times) {
    for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
      sink(CsvRow()
               .add(time)
               .add(trajectory.world.bodies[body].name)
               .addAll(poseRow(trajectory, body, time).numbers())
               .line());
    }
  }
}

void writeImpactsCsv(const Trajectory& trajectory, const TextSink& sink) {
  CsvRow header;
  header.add("time").add("a").add("b");
  for (const ImpactColumn& column : kImpactColumns) {
    header.add(column.name);
  }
  sink(header.line());
  for (const Impact& impact : trajectory.impacts) {
    CsvRow row;
    row.add(impact.time)
        .add(trajectory.world.bodies.at(static_cast<std::size_t>(impact.a.value)).name)
        .add(trajectory.partnerName(impact));
    for (const ImpactColumn& column : kImpactColumns) {
      row.add(column.of(impact));
    }
    sink(row.line());
  }
}

extern const Exporter kCsvExporter;
constexpr Exporter kCsvExporter = {
    .suffix = ".csv",
    .about = "a table of poses",
    .option = ExportOption::kEvery,
    .write = [](const Trajectory& run, const ExportSettings& settings, const TextSink& sink) -> ExportNotes {
      writePosesCsv(run, settings.every, sink);
      return {};
    }};

}  // namespace careen
