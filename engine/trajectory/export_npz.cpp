#include "trajectory/export_npz.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "trajectory/exporter.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_samples.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

constexpr double kMostRows = 2e7;  // 2 GB

struct ImpactColumn {
  const char* name;
  const char* unit;
  double (*of)(const Impact& impact);
};
constexpr std::array<ImpactColumn, 10> kImpactColumns = {
    {{"impact_time", "s", [](const Impact& impact) { return impact.time; }},
     {"impact_x", "m", [](const Impact& impact) { return impact.point.x(); }},
     {"impact_y", "m", [](const Impact& impact) { return impact.point.y(); }},
     {"impact_z", "m", [](const Impact& impact) { return impact.point.z(); }},
     {"impact_nx", "1", [](const Impact& impact) { return impact.normal.x(); }},
     {"impact_ny", "1", [](const Impact& impact) { return impact.normal.y(); }},
     {"impact_nz", "1", [](const Impact& impact) { return impact.normal.z(); }},
     {"impact_approach", "m/s", [](const Impact& impact) { return impact.approach; }},
     {"impact_impulse", "N s", [](const Impact& impact) { return impact.impulse; }},
     {"impact_tangential", "N s", [](const Impact& impact) { return impact.tangential; }}}};

// In the order of kPoseColumns; 0 for time and box.
std::array<double, kPoseColumns.size()> numbersOf(const PoseRow& row) {
  const Quat& q = row.worldFromBody;
  const Vec3& v = row.velocity;
  const Vec3& w = row.angularVelocity;
  return {0,
          0,
          row.position.x(),
          row.position.y(),
          row.position.z(),
          q.w(),
          q.x(),
          q.y(),
          q.z(),
          v.x(),
          v.y(),
          v.z(),
          w.x(),
          w.y(),
          w.z()};
}

class NumpyArchive {
 public:
  void add(const std::string& name, const std::string& unit, const NumpyArray& array) {
    entries_.emplace_back(name + ".npy", encodeNumpy(array));
    units_.push_back(name);
    units_.push_back(unit);
  }
  std::string bytes() {
    const std::size_t count = units_.size() / 2;
    entries_.emplace_back("units.npy", encodeNumpy(NumpyArray::of(std::move(units_), {count, 2})));
    return zipOf(entries_);
  }

 private:
  std::vector<ZipEntry> entries_;
  std::vector<std::string> units_;  // name, unit, name, unit …
};

void addPoses(const Trajectory& run, std::vector<double> times, NumpyArchive& archive) {
  const std::size_t bodies = run.tracks.size();
  std::vector<std::string> names;
  for (const Body& body : run.world.bodies) {
    names.push_back(body.name);
  }
  std::array<std::vector<double>, kPoseColumns.size()> columns;
  for (const double time : times) {
    for (std::size_t body = 0; body < bodies; ++body) {
      const std::array<double, kPoseColumns.size()> numbers = numbersOf(poseRow(run, body, time));
      for (std::size_t k = 2; k < columns.size(); ++k) {
        columns[k].push_back(numbers[k]);
      }
    }
  }
  const std::size_t moments = times.size();
  archive.add("time", "s", NumpyArray::of(std::move(times), {moments}));
  archive.add("box", "", NumpyArray::of(std::move(names), {bodies}));
  for (std::size_t k = 2; k < columns.size(); ++k) {
    archive.add(std::string(kPoseColumns[k]), std::string(kPoseUnits[k]),
                NumpyArray::of(std::move(columns[k]), {moments, bodies}));
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
  for (const ImpactColumn& column : kImpactColumns) {
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const Impact& impact : run.impacts) {
      numbers.push_back(column.of(impact));
    }
    archive.add(column.name, column.unit, NumpyArray::of(std::move(numbers), {count}));
  }
}

}  // namespace

std::string encodeNpz(const Trajectory& trajectory, double every) {
  std::vector<double> times = sampleTimes(trajectory, every);
  const double rows = static_cast<double>(times.size()) * static_cast<double>(trajectory.tracks.size());
  if (rows > kMostRows) {
    throw InputError("poses are written every " + brief(every) + " s, which makes " + brief(rows) +
                     " rows, expected at most " + brief(kMostRows) + " in NPZ; --poses has no such limit");
  }
  NumpyArchive archive;
  addPoses(trajectory, std::move(times), archive);
  addImpacts(trajectory, archive);
  return archive.bytes();
}

extern const Exporter kNpzExporter;
constexpr Exporter kNpzExporter = {.suffix = ".npz",
                                   .about = "a table of poses, and one of impacts",
                                   .option = ExportOption::kEvery,
                                   .write = [](const Trajectory& run, const ExportSettings& settings,
                                               const TextSink& sink) -> std::vector<std::string> {
                                     sink(encodeNpz(run, settings.every));
                                     return {};
                                   }};

}  // namespace careen
