#include "trajectory/export_npz.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "trajectory/energy_samples.h"
#include "trajectory/export_csv.h"
#include "trajectory/exporter.h"
#include "trajectory/force_samples.h"
#include "trajectory/joint_samples.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_samples.h"

namespace careen {
namespace {

constexpr double kMostRows = 2e7;  // 2 GB

void addPoses(const Trajectory& run, std::vector<double> times, NumpyArchive& archive) {
  const std::size_t bodies = run.tracks.size();
  std::vector<std::string> names;
  for (const Body& body : run.world.bodies) {
    names.push_back(body.name);
  }
  std::array<std::vector<double>, kPoseColumns.size() - 2> columns;
  for (const double time : times) {
    for (std::size_t body = 0; body < bodies; ++body) {
      const auto numbers = poseRow(run, body, time).numbers();
      for (std::size_t k = 0; k < columns.size(); ++k) {
        columns.at(k).push_back(numbers.at(k));
      }
    }
  }
  const std::size_t moments = times.size();
  archive.add("time", "s", NumpyArray::of(std::move(times), {moments}));
  archive.add("box", "", NumpyArray::of(std::move(names), {bodies}));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    archive.add(std::string(kPoseColumns.at(k + 2)), std::string(kPoseUnits.at(k + 2)),
                NumpyArray::of(std::move(columns.at(k)), {moments, bodies}));
  }
}

void addImpacts(const Trajectory& run, NumpyArchive& archive) {
  const std::size_t count = run.impacts.size();
  std::vector<std::string> a;
  std::vector<std::string> b;
  for (const Impact& impact : run.impacts) {
    a.push_back(run.world.bodies.at(static_cast<std::size_t>(impact.a.value)).name);
    b.push_back(run.partnerName(impact));
  }
  archive.add("impact_a", "", NumpyArray::of(std::move(a), {count}));
  archive.add("impact_b", "", NumpyArray::of(std::move(b), {count}));
  const auto add = [&](const std::string& name, const std::string& unit, double (*of)(const Impact&)) {
    std::vector<double> numbers;
    std::transform(run.impacts.begin(), run.impacts.end(), std::back_inserter(numbers), of);
    archive.add("impact_" + name, unit, NumpyArray::of(std::move(numbers), {count}));
  };
  add("time", "s", [](const Impact& impact) { return impact.time; });
  for (const ImpactColumn& column : kImpactColumns) {
    add(column.name, column.unit, column.of);
  }
}

void addJoints(const Trajectory& run, std::span<const double> times, NumpyArchive& archive) {
  JointSamples samples(run);
  std::vector<std::string> names;
  for (const std::size_t joint : samples.joints()) {
    names.push_back(run.world.joints[joint].name);
  }
  std::array<std::vector<double>, kJointColumns.size()> columns;
  for (const double time : times) {
    for (const JointSamples::Row& row : samples.at(time)) {
      for (std::size_t k = 0; k < columns.size(); ++k) {
        columns.at(k).push_back(row.at(k));
      }
    }
  }
  constexpr std::array<const char*, kJointColumns.size()> kUnits = {"rad or m", "rad/s or m/s", "N m or N"};
  const std::size_t joints = names.size();
  archive.add("joint", "", NumpyArray::of(std::move(names), {joints}));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    archive.add("joint_" + std::string(kJointColumns.at(k)), kUnits.at(k),
                NumpyArray::of(std::move(columns.at(k)), {times.size(), joints}));
  }
}

void addEnergies(const Trajectory& run, std::span<const double> times, NumpyArchive& archive) {
  EnergySamples samples(run);
  std::array<std::vector<double>, kEnergyColumns.size()> columns;
  for (const double time : times) {
    const RunEnergies energies = samples.at(time);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      columns.at(k).push_back(kEnergyColumns.at(k).of(energies));
    }
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    archive.add("energy_" + std::string(kEnergyColumns.at(k).name), std::string(kEnergyColumns.at(k).unit),
                NumpyArray::of(std::move(columns.at(k)), {times.size()}));
  }
}

}  // namespace

std::string encodeNpz(const Trajectory& trajectory, double every) {
  const std::vector<double> times = sampleTimes(trajectory, every);
  const double rows = static_cast<double>(times.size()) * static_cast<double>(trajectory.tracks.size());
  if (rows > kMostRows) {
    throw InputError("poses are written every " + brief(every) + " s, which makes " + brief(rows) +
                     " rows, expected at most " + brief(kMostRows) + " in NPZ; --poses has no such limit");
  }
  NumpyArchive archive;
  if (!trajectory.world.joints.empty()) {
    addJoints(trajectory, times, archive);
  }
  addPoses(trajectory, times, archive);
  addEnergies(trajectory, times, archive);
  addImpacts(trajectory, archive);
  return archive.bytes();
}

std::string encodeForcesNpz(const Trajectory& trajectory, double every) {
  const ForceSamples samples(trajectory);
  std::vector<double> times;
  std::vector<std::string> a;
  std::vector<std::string> b;
  std::array<std::vector<double>, kForceColumns.size()> columns;
  for (const double time : sampleTimes(trajectory, every)) {
    for (const ContactPush& push : samples.at(time)) {
      times.push_back(time);
      a.push_back(trajectory.world.bodies[static_cast<std::size_t>(push.a.value)].name);
      b.push_back(partnerName(trajectory, push));
      for (std::size_t k = 0; k < columns.size(); ++k) {
        columns.at(k).push_back(kForceColumns.at(k).of(push));
      }
    }
  }
  NumpyArchive archive;
  const std::size_t count = times.size();
  archive.add("time", "s", NumpyArray::of(std::move(times), {count}));
  archive.add("a", "", NumpyArray::of(std::move(a), {count}));
  archive.add("b", "", NumpyArray::of(std::move(b), {count}));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    archive.add(std::string(kForceColumns.at(k).name), std::string(kForceColumns.at(k).unit),
                NumpyArray::of(std::move(columns.at(k)), {count}));
  }
  return archive.bytes();
}

extern const Exporter kNpzExporter;
constexpr Exporter kNpzExporter = {
    .suffix = ".npz",
    .about = "tables of poses, impacts, joints and energies",
    .option = ExportOption::kEvery,
    .write = [](const Trajectory& run, const ExportSettings& settings, const TextSink& sink) -> ExportNotes {
      sink(settings.table == ExportTable::kForces ? encodeForcesNpz(run, settings.every)
                                                  : encodeNpz(run, settings.every));
      return {};
    }};

}  // namespace careen
