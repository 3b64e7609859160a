#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "command_line.h"
#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/names.h"
#include "core/system/file.h"
#include "run.h"
#include "scene/scene_reader.h"
#include "study/study.h"
#include "study/validation.h"
#include "study/validation_page.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

constexpr std::size_t kMostPoints = 1000;  // of a sweep
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
  std::vector<double> parts;
  for (std::size_t at = equals == std::string::npos ? text.size() + 1 : equals + 1; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    double number = 0;
    const auto [last, error] = std::from_chars(text.data() + at, text.data() + end, number);
    if (error != std::errc() || last != text.data() + end || !std::isfinite(number)) {
      fail("numbers FROM:TO:STEP");
    }
    parts.push_back(number);
    at = end + 1;
  }
  if (parts.size() != 3 || !(parts[0] >= 0 && parts[1] >= parts[0] && parts[2] > 0)) {
    fail("FROM:TO:STEP with 0 <= FROM <= TO and STEP above 0");
  }
  Sweep sweep{.parameter = static_cast<Parameter>(known - kParameterNames.begin()), .values = {}};
  if (sweep.parameter == Parameter::kRestitution && parts[1] > 1) {
    fail("a restitution of at most 1");
  }
  if (sweep.parameter == Parameter::kInertia && parts[0] <= 0) {
    fail("factors of the inertia above 0");
  }
  constexpr double kRounding = 1e-9;  // of a step: 0.1 + 10 · 0.02 misses 0.3
  if (!((parts[1] - parts[0]) / parts[2] < kMostPoints)) {
    fail("at most " + std::to_string(kMostPoints) + " values");
  }
  for (std::size_t k = 0;; ++k) {
    const double value = parts[0] + static_cast<double>(k) * parts[2];
    if (value > parts[1] + kRounding * parts[2]) {
      return sweep;
    }
    sweep.values.push_back(std::min(value, parts[1]));
  }
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
  const auto [text, name] = sceneTextOf(options.scene, readFile(options.scene));
  const Scene scene = parseScene(text, name, Starts::kMayOverlap);
  const std::vector<PoseTable> measured = readMeasured(options.measured);
  if (!options.noPlots) {
    checkPlotter();
  }
  const RunSetup setup = setupOfMeasured(scene);
  ValidationSettings settings;
  settings.start = options.start == "first" ? MeasuredStart::kFirst : MeasuredStart::kFitted;
  Validation found{.program = "careen " CAREEN_VERSION,
                   .scene = scene.name,
                   .size = sizeOf(setup.world),
                   .tosses = {},
                   .swept = {},
                   .sweep = {},
                   .sceneValue = {}};
  const std::filesystem::path runs = options.out / "runs";
  makeFolder(runs);
  for (const PoseTable& table : measured) {
    Trajectory run;
    found.tosses.push_back(validate(setup, table, settings, stop, &run));
    print(found.tosses.back(), found.size);
    saveTrajectory(run, runs / (std::filesystem::path(table.name).stem().string() + ".careen"));
  }
  if (!sweep.values.empty()) {
    found.swept = sweep.parameter;
    found.sceneValue = valueOf(setup.world, sweep.parameter);
    settings.floorRuns = 0;
    for (const double value : sweep.values) {
      settings.setting = Setting{.parameter = sweep.parameter, .value = value};
      std::vector<Toss> tosses;
      for (const PoseTable& table : measured) {
        tosses.push_back(validate(setup, table, settings, stop));
      }
      found.sweep.push_back({.value = value,
                             .place = spreadOf(tosses, &Toss::meanPlace).mean,
                             .attitude = spreadOf(tosses, &Toss::meanAttitude).mean});
      std::cout << options.sweep.substr(0, options.sweep.find('=')) << ' ' << brief(value) << ": place "
                << brief(100 * found.sweep.back().place / found.size, 4) << " %, attitude "
                << brief(found.sweep.back().attitude * kDegrees, 4) << "°\n"
                << std::flush;
    }
    writeFile(options.out / "sweep.csv", sweepCsv(found.sweep, sweep.parameter));
  }
  writeFile(options.out / "results.csv", tossesCsv(found.tosses, found.size));
  writeFile(options.out / "errors.csv", errorsCsv(found.tosses));
  writeFile(options.out / "report.json", validationJson(found));
  const std::vector<std::string> plots =
      options.noPlots ? std::vector<std::string>{} : drawValidation(found, options.out / "plots");
  writeFile(options.out / "index.html", validationPage(found, plots));
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
