#include "trajectory/export_csv.h"

#include <string>
#include <vector>

#include "core/table.h"
#include "trajectory/energy_samples.h"
#include "trajectory/exporter.h"
#include "trajectory/force_samples.h"
#include "trajectory/joint_samples.h"
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

void writeJointsCsv(const Trajectory& trajectory, double every, const TextSink& sink) {
  CsvRow header;
  header.add("time").add("joint");
  for (const std::string_view column : kJointColumns) {
    header.add(column);
  }
  sink(header.line());
  JointSamples samples(trajectory);
  for (const double time : sampleTimes(trajectory, every)) {
    const std::vector<JointSamples::Row> rows = samples.at(time);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      sink(CsvRow().add(time).add(trajectory.world.joints[samples.joints()[k]].name).addAll(rows[k]).line());
    }
  }
}

void writeEnergyCsv(const Trajectory& trajectory, double every, const TextSink& sink) {
  CsvRow header;
  header.add("time");
  for (const EnergyColumn& column : kEnergyColumns) {
    header.add(column.name);
  }
  sink(header.line());
  EnergySamples samples(trajectory);
  for (const double time : sampleTimes(trajectory, every)) {
    const RunEnergies energies = samples.at(time);
    CsvRow row;
    row.add(time);
    for (const EnergyColumn& column : kEnergyColumns) {
      row.add(column.of(energies));
    }
    sink(row.line());
  }
}

void writeForcesCsv(const Trajectory& trajectory, double every, const TextSink& sink) {
  CsvRow header;
  header.add("time").add("a").add("b");
  for (const ForceColumn& column : kForceColumns) {
    header.add(column.name);
  }
  sink(header.line());
  const ForceSamples samples(trajectory);
  for (const double time : sampleTimes(trajectory, every)) {
    for (const ContactPush& push : samples.at(time)) {
      CsvRow row;
      row.add(time)
          .add(trajectory.world.bodies[static_cast<std::size_t>(push.a.value)].name)
          .add(partnerName(trajectory, push));
      for (const ForceColumn& column : kForceColumns) {
        row.add(column.of(push));
      }
      sink(row.line());
    }
  }
}

extern const Exporter kCsvExporter;
constexpr Exporter kCsvExporter = {
    .suffix = ".csv",
    .about = "a table of poses",
    .option = ExportOption::kEvery,
    .write = [](const Trajectory& run, const ExportSettings& settings, const TextSink& sink) -> ExportNotes {
      (settings.table == ExportTable::kForces ? writeForcesCsv : writePosesCsv)(run, settings.every, sink);
      return {};
    }};

}  // namespace careen
