#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "command_line.h"
#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/names.h"
#include "core/number_range.h"
#include "core/system/file.h"
#include "parsed.h"
#include "run_options.h"
#include "scene/scene_reader.h"
#include "study/study.h"
#include "study/validation_run.h"

namespace careen {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct ValidateOptions {
  std::vector<std::string> measured;
  std::filesystem::path scene;
  std::string start = "fitted";
  std::string sweep;
  std::filesystem::path out = "validation";
  bool noPlots = false;
};

struct Sweep {
  Parameter parameter{};
  std::vector<double> values;
};

// "friction=0.1:0.3:0.02"
Sweep sweepOf(const std::string& text) {
  const auto fail = [&text](const std::string& expected) {
    throw InputError("--sweep: found '" + text + "', expected " + expected);
  };
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto* const known = std::find(kParameterNames.begin(), kParameterNames.end(), name);
  if (known == kParameterNames.end()) {
    fail("one of " + listed(kParameterNames) + ", and a range such as friction=0.1:0.3:0.02");
  }
  const std::string range = text.substr(std::min(equals, text.size() - 1) + 1);
  Sweep sweep{.parameter = static_cast<Parameter>(known - kParameterNames.begin()),
              .values = parsed("--sweep", range, numbersOfRange)};
  if (sweep.parameter == Parameter::kRestitution && sweep.values.back() > 1) {
    fail("a restitution of at most 1");
  }
  if (sweep.parameter == Parameter::kInertia && sweep.values.front() <= 0) {
    fail("factors of the inertia above 0");
  }
  return sweep;
}

std::vector<PoseTable> readMeasured(const std::vector<std::string>& paths) {
  std::vector<PoseTable> tables;
  std::set<std::string> names;
  for (const std::string& path : paths) {
    tables.push_back(readPoseTable(readFile(path), path));
    if (!names.insert(std::filesystem::path(path).stem().string()).second) {
      throw InputError(path + ": found two measurements of this name, expected names that differ");
    }
  }
  return tables;
}

void print(const Toss& toss, double size) {
  std::cout << printableName(std::filesystem::path(toss.name).stem().string()) << ": place "
            << brief(100 * toss.meanPlace / size, 3) << " %, at most "
            << brief(100 * toss.largestPlace / size, 3) << " %; attitude "
            << brief(toss.meanAttitude * kDegrees, 3) << "°, at most "
            << brief(toss.largestAttitude * kDegrees, 3) << "°; floor "
            << brief(100 * toss.floorPlace / size, 2) << " %; face " << toss.measuredFace << ", simulated "
            << toss.simulatedFace << "; " << toss.impacts << " impacts in " << brief(1e3 * toss.seconds, 3)
            << " ms\n"
            << std::flush;  // progress
}

ExitCode validateCommand(const ValidateOptions& options, const std::stop_token& stop) {
  const Sweep sweep = options.sweep.empty() ? Sweep{} : sweepOf(options.sweep);
  const auto [text, name] = sceneTextOf(options.scene, readFile(options.scene), tellNotice);
  const ValidationTask task{
      .scene = parseScene(text, name, Starts::kMayOverlap),
      .measured = readMeasured(options.measured),
      .start = options.start == "first" ? MeasuredStart::kFirst : MeasuredStart::kFitted,
      .swept = sweep.values.empty() ? std::nullopt : std::optional(sweep.parameter),
      .values = sweep.values,
      .folder = options.out,
      .plots = !options.noPlots,
      .program = "careen " CAREEN_VERSION};
  if (task.plots) {
    checkPlotter();
  }
  const auto tellPoint = [&](const SweepPoint& point, double size) {
    std::cout << options.sweep.substr(0, options.sweep.find('=')) << ' ' << brief(point.value) << ": place "
              << brief(100 * point.place / size, 4) << " %, attitude " << brief(point.attitude * kDegrees, 4)
              << "°\n"
              << std::flush;
  };
  const Validation found = runValidation(task, {.toss = print, .point = tellPoint}, stop);
  for (const std::string& line : summaryOf(found)) {
    std::cout << line << '\n';
  }
  std::cout << "page         " << printableName((options.out / "index.html").string()) << '\n';
  return ExitCode::kDone;
}

}  // namespace

void addValidate(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("validate", "How far simulations are from measurements with the same start");
  const auto options = std::make_shared<ValidateOptions>();
  command.add("measured", options->measured, "Tables of measured poses (CSV, NPZ), one for each toss")
      .required();
  command.add("--scene", options->scene, "Scene: the boxes' sizes and masses, friction, restitution, walls")
      .required();
  command
      .add("--start", options->start,
           "Where a simulation begins: fitted, to all rows before the first impact, or first, at the first "
           "row")
      .oneOf({"fitted", "first"})
      .showsDefault();
  command.add("--sweep", options->sweep,
              "Also with other values: friction, restitution (of every pair) or inertia (a factor), "
              "KEY=FROM:TO:STEP, such as friction=0.1:0.3:0.02");
  command.add("-o,--out", options->out, "Folder for tables, plots, page and runs").showsDefault();
  command.addFlag("--no-plots", options->noPlots, "Tables and page only; gnuplot is not needed");
  command.footer(
      "Nothing is fitted but the start. A film of both: careen render OUT/runs/NAME.careen --ghost NAME.csv");
  command.runs([options](const std::stop_token& stop) { return validateCommand(*options, stop); });
}

}  // namespace careen
