#include "sweep/outcome_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "core/brief.h"
#include "core/csv.h"
#include "core/error.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_samples.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void append(std::string& row, double value) {
  constexpr int kDigits = 17;  // round-trips a double
  row += row.empty() || row.back() == '\n' ? "" : ",";
  row += std::isnan(value) ? "nan" : brief(value, kDigits);
}

void append(std::string& row, const PoseRow& state) {
  for (const double number :
       {state.position.x(), state.position.y(), state.position.z(), state.worldFromBody.w(),
        state.worldFromBody.x(), state.worldFromBody.y(), state.worldFromBody.z(), state.velocity.x(),
        state.velocity.y(), state.velocity.z(), state.angularVelocity.x(), state.angularVelocity.y(),
        state.angularVelocity.z()}) {
    append(row, number);
  }
}

int faceUp(const Trajectory& run, const Quat& worldFromBody) {
  const Vec3 up = run.world.gravity.isZero() ? Vec3(Vec3::UnitZ()) : Vec3(-run.world.gravity);
  const Vec3 inBody = worldFromBody.conjugate() * up;
  Eigen::Index axis = 0;
  inBody.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (inBody[axis] > 0 ? 2 : 1);
}

double restSince(const Track& track) {
  double since = kNone;
  for (const Segment& segment : track.segments) {
    if (!std::holds_alternative<Rest>(segment.motion)) {
      since = kNone;
    } else if (std::isnan(since)) {
      since = segment.start;
    }
  }
  return since;
}

struct ImpactsOfBox {
  double count = 0;
  double first = kNone;
  double last = kNone;
};

std::vector<ImpactsOfBox> impactsOfBoxes(const Trajectory& run) {
  std::vector<ImpactsOfBox> all(run.tracks.size());
  const auto add = [&](int body, double time) {
    ImpactsOfBox& of = all[static_cast<std::size_t>(body)];
    of.first = of.count == 0 ? time : of.first;
    of.last = time;
    ++of.count;
  };
  for (const Impact& impact : run.impacts) {
    add(impact.a.value, impact.time);
    if (!impact.b.isWall()) {
      add(impact.b.body(), impact.time);
    }
  }
  return all;
}

// The last cell of a line, which may be quoted; lines end at an even number of quotes.
std::string nameOf(std::string_view cell) {
  if (!cell.starts_with('"')) {
    return std::string(cell);
  }
  std::string name;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    name += cell[i];
    i += cell[i] == '"' ? 1 : 0;
  }
  return name;
}

}  // namespace

std::vector<OutcomeColumn> outcomeColumns(const Family& family) {
  std::vector<OutcomeColumn> columns = {{"run", ""}, {"attempts", ""}};
  for (const std::string& path : family.columns()) {
    columns.push_back({path, ""});
  }
  for (const auto& [name, unit] : {std::pair("half_x", "m"),
                                   {"half_y", "m"},
                                   {"half_z", "m"},
                                   {"mass", "kg"},
                                   {"restitution", "1"},
                                   {"friction", "1"}}) {
    columns.push_back({name, unit});
  }
  for (const char* const when : {"start_", "end_"}) {
    for (std::size_t k = 2; k < kPoseColumns.size(); ++k) {
      columns.push_back({when + std::string(kPoseColumns[k]), std::string(kPoseUnits[k])});
    }
  }
  for (const auto& [name, unit] : {std::pair("face_up", ""),
                                   {"impacts", ""},
                                   {"first_impact", "s"},
                                   {"last_impact", "s"},
                                   {"rest_since", "s"},
                                   {"run_impacts", ""},
                                   {"broken", ""},
                                   {"box", ""}}) {
    columns.push_back({name, unit});
  }
  return columns;
}

std::string outcomeHeader(const Family& family) {
  std::string line;
  for (const OutcomeColumn& column : outcomeColumns(family)) {
    line += (line.empty() ? "" : ",") + csvCell(column.name);
  }
  return line + "\n";
}

std::string outcomeRows(std::uint64_t run, const Family::Member& member, const Trajectory& trajectory,
                        const Audit& audit) {
  const std::vector<ImpactsOfBox> impacts = impactsOfBoxes(trajectory);
  std::string rows;
  for (std::size_t i = 0; i < trajectory.tracks.size(); ++i) {
    const Body& body = trajectory.world.bodies[i];
    if (isImmovable(body.mass)) {
      continue;
    }
    append(rows, static_cast<double>(run));
    append(rows, member.attempts);
    for (const double number : member.drawn) {
      append(rows, number);
    }
    const SceneBox& box = member.scene.boxes[i];
    for (const double number : {body.halfExtents.x(), body.halfExtents.y(), body.halfExtents.z(),
                                body.mass.mass, box.material.restitution, box.material.friction}) {
      append(rows, number);
    }
    const PoseRow end = poseRow(trajectory, i, trajectory.settings.duration);
    append(rows, poseRow(trajectory, i, 0));
    append(rows, end);
    append(rows, faceUp(trajectory, end.worldFromBody));
    append(rows, impacts[i].count);
    append(rows, impacts[i].first);
    append(rows, impacts[i].last);
    append(rows, restSince(trajectory.tracks[i]));
    append(rows, static_cast<double>(trajectory.impacts.size()));
    append(rows, static_cast<double>(audit.breaches.size()));
    rows += "," + csvCell(body.name) + "\n";
  }
  return rows;
}

OutcomeTable::OutcomeTable(const Family& family, std::string_view rows, const std::string& name)
    : columns(outcomeColumns(family)), numbers(columns.size() - 1) {
  const auto fail = [&](const std::string& found) {
    throw InputError(name + ": " + found + " after " + std::to_string(boxes.size()) +
                     " rows, expected what 'careen sweep' wrote; remove it and resume");
  };
  while (!rows.empty()) {
    for (std::vector<double>& column : numbers) {
      double value = 0;
      const auto [end, error] = std::from_chars(rows.data(), rows.data() + rows.size(), value);
      if (error != std::errc() || end == rows.data() + rows.size() || *end != ',') {
        fail("found a damaged row");
      }
      column.push_back(value);
      rows.remove_prefix(static_cast<std::size_t>(end - rows.data()) + 1);
    }
    std::size_t end = 0;
    for (bool inQuotes = false; end < rows.size() && (inQuotes || rows[end] != '\n'); ++end) {
      inQuotes = inQuotes != (rows[end] == '"');
    }
    if (end == rows.size()) {
      fail("is cut short");
    }
    boxes.push_back(nameOf(rows.substr(0, end)));
    rows.remove_prefix(end + 1);
  }
}

std::string OutcomeTable::archive() const {
  std::vector<ZipEntry> entries;
  std::vector<std::string> units;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    entries.emplace_back(columns[i].name + ".npy", encodeNumpy(NumpyArray::of(numbers[i], {boxes.size()})));
  }
  entries.emplace_back("box.npy", encodeNumpy(NumpyArray::of(boxes, {boxes.size()})));
  for (const OutcomeColumn& column : columns) {
    units.push_back(column.name);
    units.push_back(column.unit);
  }
  entries.emplace_back("units.npy", encodeNumpy(NumpyArray::of(std::move(units), {columns.size(), 2})));
  return zipOf(entries);
}

}  // namespace careen
