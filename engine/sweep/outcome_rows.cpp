#include "sweep/outcome_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <variant>

#include "core/error.h"
#include "core/table.h"
#include "question/moments.h"
#include "scene/prepare.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_samples.h"

namespace careen {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

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

// Of one with a name that the run lacks, as boxes may be of any number: none.
std::vector<double> firstMoments(const Trajectory& run, const std::vector<std::string>& questions) {
  std::vector<double> first;
  for (const std::string& text : questions) {
    std::vector<Moment> found;
    try {
      found = moments(run, readQuestion(text, run.world));
    } catch (const InputError&) {
    }
    first.push_back(found.empty() ? kNone : found.front().time);
  }
  return first;
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

void checkQuestions(const Family& family, const std::vector<std::string>& questions) {
  if (questions.empty()) {
    return;
  }
  const World world = prepare(family.member(0).scene, {.threads = 1}).setup.world;
  std::set<std::string> asked;
  for (const std::string& question : questions) {
    static_cast<void>(readQuestion(question, world));
    if (!asked.insert(question).second) {
      throw InputError("found the question '" + question + "' twice, expected each once");
    }
  }
}

std::vector<OutcomeColumn> outcomeColumns(const Family& family, const OutcomesAsked& asked) {
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
                                   {"rest_since", "s"}}) {
    columns.push_back({name, unit});
  }
  for (const std::string& question : asked.questions) {
    columns.push_back({question, "s"});
  }
  if (asked.errors) {
    for (const auto& [name, unit] :
         {std::pair("error_position", "m"), {"error_angle", "rad"}, {"error_until", "s"}}) {
      columns.push_back({name, unit});
    }
  }
  for (const char* const name : {"run_impacts", "broken", "box"}) {
    columns.push_back({name, ""});
  }
  return columns;
}

std::string outcomeHeader(const Family& family, const OutcomesAsked& asked) {
  CsvRow row;
  for (const OutcomeColumn& column : outcomeColumns(family, asked)) {
    row.add(column.name);
  }
  return row.line();
}

std::string outcomeRows(std::uint64_t run, const Family::Member& member, const Trajectory& trajectory,
                        const Audit& audit, const std::optional<ErrorEstimate>& error,
                        const OutcomesAsked& asked) {
  const std::vector<double> answers = firstMoments(trajectory, asked.questions);
  std::vector<double> errors;
  if (asked.errors) {
    errors = error ? std::vector{error->position, error->angle, error->until} : std::vector(3, kNone);
  }
  const std::vector<ImpactsOfBox> impacts = impactsOfBoxes(trajectory);
  std::string rows;
  for (std::size_t i = 0; i < trajectory.tracks.size(); ++i) {
    const Body& body = trajectory.world.bodies[i];
    if (isImmovable(body.mass)) {
      continue;
    }
    const SceneBox& box = member.scene.boxes[i];
    const PoseRow end = poseRow(trajectory, i, trajectory.settings.duration);
    rows += CsvRow()
                .add(static_cast<double>(run))
                .add(member.attempts)
                .addAll(member.drawn)
                .addAll(body.halfExtents)
                .addAll(std::array{body.mass.mass, box.material.restitution, box.material.friction})
                .addAll(poseRow(trajectory, i, 0).numbers())
                .addAll(end.numbers())
                .add(faceUp(trajectory, end.worldFromBody))
                .addAll(std::array{impacts[i].count, impacts[i].first, impacts[i].last})
                .add(restSince(trajectory.tracks[i]))
                .addAll(answers)
                .addAll(errors)
                .add(static_cast<double>(trajectory.impacts.size()))
                .add(static_cast<double>(audit.breaches.size()))
                .add(body.name)
                .line();
  }
  return rows;
}

OutcomeTable::OutcomeTable(const Family& family, const OutcomesAsked& asked, std::string_view rows,
                           const std::string& name)
    : columns(outcomeColumns(family, asked)), numbers(columns.size() - 1) {
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
  NumpyArchive archive;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    archive.add(columns[i].name, columns[i].unit, NumpyArray::of(numbers[i], {boxes.size()}));
  }
  archive.add(columns.back().name, columns.back().unit, NumpyArray::of(boxes, {boxes.size()}));
  return archive.bytes();
}

}  // namespace careen
