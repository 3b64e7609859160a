#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "exchange/export_glb.h"
#include "exchange/exporters.h"
#include "parsed.h"
#include "run_options.h"
#include "scene/scene_reader.h"
#include "study/force_plot.h"

namespace careen {
namespace {

struct ExportOptions {
  std::filesystem::path source;
  std::filesystem::path output;
  std::optional<double> within;
  std::optional<double> every;  // [s]
  bool forces = false;
  bool realTime = false;
  SceneOfTable scene;
  AuditChoice audit;
};

// ".glb, .xml or .csv", with what `words` adds to each.
template <class Words>
std::string listedExporters(Words words) {
  std::string list;
  for (std::size_t i = 0; i < kExporters.size(); ++i) {
    list += (i == 0 ? "" : i + 1 < kExporters.size() ? ", " : " or ") + words(*kExporters.at(i));
  }
  return list;
}

// Null for a scene file that is made of a model.
const Exporter* exporterFor(const ExportOptions& options) {
  const std::string suffix = options.output.extension().string();
  const auto found = std::find_if(kExporters.begin(), kExporters.end(),
                                  [&](const Exporter* each) { return each->suffix == suffix; });
  if (found != kExporters.end()) {
    return *found;
  }
  if (suffix != ".json") {
    throw InputError("--out: found '" + options.output.string() + "', expected a file that ends in " +
                     listedExporters([](const Exporter& each) { return std::string(each.suffix); }) +
                     ", or in .json for a model of MuJoCo as a scene");
  }
  if (!isMujocoModel(options.source)) {
    throw InputError("--out: found the scene file " + options.output.string() + " to be made of " +
                     options.source.string() + ", expected a model of MuJoCo, .xml");
  }
  return nullptr;
}

void check(const ExportOptions& options, ExportOption taken) {
  if (options.within && taken != ExportOption::kWithin) {
    throw InputError("--within: found the file " + options.output.string() +
                     ", which has no keys; expected a .glb");
  }
  if (options.every && taken != ExportOption::kEvery) {
    throw InputError("--every: found the file " + options.output.string() +
                     ", which has no rows; expected a table");
  }
  if (options.realTime && taken != ExportOption::kWithin) {
    throw InputError("--real-time: found the file " + options.output.string() +
                     ", which is no film; expected a .glb");
  }
  if (options.within) {
    parsed("--within", *options.within, checkGlbError);
  }
  if (options.forces && taken != ExportOption::kEvery) {
    throw InputError("--forces: found the file " + options.output.string() +
                     ", which has no rows; expected a table, .svg or .png");
  }
  if (isSameFile(options.output, options.source)) {
    throw InputError("--out: found the run itself, " + options.output.string() + ", expected another file");
  }
}

// Boxes may overlap, as in MuJoCo: whoever runs the scene decides what then.
void writeScene(const ExportOptions& options) {
  const auto [text, name] = sceneTextOf(options.source, readFile(options.source), tellNotice);
  static_cast<void>(parseScene(text, name, Starts::kMayOverlap));
  writeFile(options.output, text);
}

void writeRun(const ExportOptions& options, const Exporter& exporter, const std::stop_token& stop) {
  Run run = loadRun(options.source, {}, options.scene, stop);
  auditRun(run, options.audit, stop);
  if (options.realTime) {
    run.trajectory.stage.timeMap = {};
  }
  AtomicFile file(options.output);
  ExportSettings settings{.program = "careen " CAREEN_VERSION};
  settings.within = options.within.value_or(settings.within);
  settings.every = options.every.value_or(settings.every);
  settings.table = options.forces ? ExportTable::kForces : ExportTable::kPoses;
  const ExportNotes notes =
      exporter.write(run.trajectory, settings, [&file](std::string_view text) { file.write(text); });
  file.commit();
  for (const std::string& note : notes) {
    std::cout << note << '\n';
  }
}

bool isPlot(const std::filesystem::path& file) {
  return file.extension() == ".svg" || file.extension() == ".png";
}

// As both kinds of picture.
ExitCode plotForces(const ExportOptions& options, const std::stop_token& stop) {
  check(options, ExportOption::kEvery);
  Run run = loadRun(options.source, {}, options.scene, stop);
  auditRun(run, options.audit, stop);
  const std::filesystem::path stem = options.output.parent_path() / options.output.stem();
  drawPlot(forcePlot(run.trajectory, options.every.value_or(ExportSettings{}.every)), stem);
  std::cout << "written      " << printableName(stem.string()) << ".svg, .png\n";
  return ExitCode::kDone;
}

ExitCode exportCommand(const ExportOptions& options, const std::stop_token& stop) {
  if (options.forces && isPlot(options.output)) {
    return plotForces(options, stop);
  }
  const Exporter* const exporter = exporterFor(options);
  check(options, exporter != nullptr ? exporter->option : ExportOption::kNone);
  if (exporter != nullptr) {
    writeRun(options, *exporter, stop);
  } else {
    writeScene(options);
  }
  std::cout << "written      " << printableName(options.output.string()) << '\n';
  return ExitCode::kDone;
}

}  // namespace

void addExport(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand("export", "A run as a file of other programs");
  const auto options = std::make_shared<ExportOptions>();
  command.add("run", options->source, "Trajectory file, table of poses, scene, or model of MuJoCo (.xml)")
      .required();
  command
      .add("-o,--out", options->output, "The file: " + listedExporters([](const Exporter& each) {
                                          return std::string(each.suffix) + " (" + std::string(each.about) +
                                                 ")";
                                        }) + "; of a model of MuJoCo also .json (a scene)")
      .required();
  command.add("--within", options->within,
              "How far a .glb may be off between its keys, in m and rad (default: 1e-4)");
  command.addFlag("--real-time", options->realTime,
                  "A .glb shows the whole run in the scene's time, in place of the film's");
  command.add("--every", options->every, "Time between two poses of a table [s] (default: 1/60)");
  command.addFlag("--forces", options->forces,
                  "The forces of contact in place of poses, as a table, or as a plot: .svg and .png");
  options->scene.addTo(command);
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) { return exportCommand(*options, stop); });
}

}  // namespace careen
