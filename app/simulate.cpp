#include <filesystem>
#include <functional>
#include <iostream>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands.h"
#include "core/characters.h"
#include "core/system/file.h"
#include "exchange/exporters.h"
#include "run_options.h"
#include "runs/run_report.h"
#include "simulation_progress.h"
#include "summary.h"
#include "trajectory/export_csv.h"
#include "trajectory/export_npz.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

constexpr double kSimulatedSampling = 1.0 / 60;  // [s]

struct SimulateOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path poses;
  std::optional<double> every;  // [s]
  std::filesystem::path npz;
  std::filesystem::path impacts;
  std::filesystem::path joints;
  std::filesystem::path energy;
  std::filesystem::path forces;
  std::filesystem::path report;
  std::string log = "text";
  bool verbose = false;
  std::string until;
  Overrides overrides;
  EstimateChoice estimate;
  AuditChoice audit;
};

// All or nothing: every file is first written beside its target, and none is renamed unless all were
// written.
class Outputs {
 public:
  void add(const std::filesystem::path& path, const std::function<void(const TextSink&)>& write) {
    if (path.empty()) {
      return;
    }
    AtomicFile& file = files_.emplace_back(path);
    write([&file](std::string_view text) { file.write(text); });
  }
  void commit() {
    for (AtomicFile& file : files_) {
      file.commit();
    }
  }

 private:
  std::list<AtomicFile> files_;  // a list, because an AtomicFile must not move
};

// Before the run: nothing may be written over the scene, nor over another output.
void checkOutputs(const std::filesystem::path& source, const std::filesystem::path& output,
                  const SimulateOptions& options) {
  std::vector<std::pair<const char*, std::filesystem::path>> known = {{"the scene", source}};
  for (const auto& [option, path] :
       {std::pair("--out", output), std::pair("--poses", options.poses), std::pair("--npz", options.npz),
        std::pair("--impacts", options.impacts), std::pair("--joints", options.joints),
        std::pair("--energy", options.energy), std::pair("--forces", options.forces),
        std::pair("--report", options.report)}) {
    for (const auto& [what, other] : known) {
      if (!path.empty() && isSameFile(path, other)) {
        throw InputError(std::string(option) + ": found " + path.string() + ", which is " + what +
                         " too, expected a file of its own");
      }
    }
    if (!path.empty()) {
      known.emplace_back(option, path);
    }
  }
}

ExitCode simulateCommand(const SimulateOptions& options, const std::stop_token& stop) {
  const Stopwatch stopwatch;
  const std::filesystem::path source = options.scene.empty() ? defaultScene() : options.scene;
  const std::filesystem::path output =
      options.output.empty() ? std::filesystem::path(source.stem().string() + ".careen") : options.output;
  checkOutputs(source, output, options);
  if (options.every && options.poses.empty() && options.npz.empty() && options.joints.empty() &&
      options.energy.empty() && options.forces.empty()) {
    throw InputError(
        "--every: found none of --poses, --npz, --joints, --energy and --forces, expected one of them");
  }
  const bool logsJson = options.log == "json";
  SimulationProgress progress(logsJson);
  Run run = simulateFile(source, options.overrides, stop, progress.ofRun(options.overrides.mostRecords()),
                         options.until);
  auditRun(run, options.audit, stop);
  options.estimate.estimate(run, stopwatch.seconds() - run.auditSeconds, stop, progress.ofEstimate());

  Outputs outputs;
  outputs.add(output, [&](const TextSink& sink) { writeTrajectory(run.trajectory, sink); });
  const double every = options.every.value_or(kSimulatedSampling);
  outputs.add(options.poses, [&](const TextSink& sink) { writePosesCsv(run.trajectory, every, sink); });
  outputs.add(options.npz, [&](const TextSink& sink) { sink(encodeNpz(run.trajectory, every)); });
  outputs.add(options.impacts, [&](const TextSink& sink) { writeImpactsCsv(run.trajectory, sink); });
  outputs.add(options.joints, [&](const TextSink& sink) { writeJointsCsv(run.trajectory, every, sink); });
  outputs.add(options.energy, [&](const TextSink& sink) { writeEnergyCsv(run.trajectory, every, sink); });
  outputs.add(options.forces, [&](const TextSink& sink) {
    const Exporter& exporter =
        options.forces.extension() == kNpzExporter.suffix ? kNpzExporter : kCsvExporter;
    exporter.write(run.trajectory, {.every = every, .table = ExportTable::kForces}, sink);
  });
  outputs.add(options.report, [&](const TextSink& sink) { sink(runReportText(run, stopwatch.seconds())); });
  outputs.commit();

  std::ostream& summary = logsJson ? std::cerr : std::cout;
  printSummary(summary, run, stopwatch.seconds(), options.verbose);
  const char* between = "files        ";
  for (const std::filesystem::path& file : {output, options.poses, options.npz, options.impacts,
                                            options.joints, options.energy, options.forces, options.report}) {
    if (!file.empty()) {
      summary << between << printableName(file.string());
      between = ", ";
    }
  }
  summary << '\n';
  return ExitCode::kDone;
}

}  // namespace

void addSimulate(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand("simulate", "Run a scene and keep what happened");
  const auto options = std::make_shared<SimulateOptions>();
  command.add("scene", options->scene, "Scene file; the default scene if none is named");
  command.add("-o,--out", options->output, "Trajectory file (default: the scene file's name, .careen)");
  command.add("--poses", options->poses, "Table of poses (CSV)");
  command.add("--npz", options->npz,
              "Poses, impacts, joints, energies, names and units as NumPy loads them (NPZ)");
  command.add("--joints", options->joints, "Table of angles, ways, rates and efforts of joints (CSV)");
  command.add("--energy", options->energy,
              "Table of energies, of what was given and lost by cause, and of momenta (CSV)");
  command.add("--forces", options->forces,
              "Table of the forces of contact, point by point (.npz: NPZ, else CSV)");
  command.add("--every", options->every,
              "Time between two rows of --poses, --npz, --joints, --energy and --forces [s] (default: 1/60)");
  command.add("--impacts", options->impacts, "Table of impacts (CSV)");
  command.add("--report", options->report, "What was modelled, speed and error (JSON)");
  command
      .add("--log", options->log,
           "text, or json: lines on the standard output that tell how far the run is, and nothing else there "
           "(default: text)")
      .oneOf({"text", "json"});
  command.add("--until", options->until,
              "End the run when this becomes true, such as rest or 'a touches b' (see 'careen when')");
  command.addFlag("--verbose", options->verbose, "Print all that is known of the run, as --report has it");
  options->overrides.addTo(command);
  options->overrides.addThreadsTo(command);
  options->estimate.addTo(command);
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) { return simulateCommand(*options, stop); });
}

}  // namespace careen
