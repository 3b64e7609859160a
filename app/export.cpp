#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "exchange/export_glb.h"
#include "exchange/export_mjcf.h"
#include "run.h"
#include "scene/scene_reader.h"
#include "trajectory/export_csv.h"
#include "trajectory/export_npz.h"

namespace careen {
namespace {

constexpr double kUsualSampling = 1.0 / 60;  // [s]

struct ExportOptions {
  std::filesystem::path source;
  std::filesystem::path output;
  std::optional<double> within;
  std::optional<double> every;  // [s]
  SceneOfTable scene;
  AuditChoice audit;
};

enum class Format { kGlb, kMjcf, kNpz, kCsv, kScene };

Format formatOf(const ExportOptions& options) {
  const std::string suffix = options.output.extension().string();
  if (suffix != ".glb" && suffix != ".xml" && suffix != ".npz" && suffix != ".csv" && suffix != ".json") {
    throw InputError("--out: found '" + options.output.string() +
                     "', expected a file that ends in .glb, .xml, .npz or .csv, or in .json for a model of "
                     "MuJoCo as a scene");
  }
  const Format format = suffix == ".glb"   ? Format::kGlb
                        : suffix == ".xml" ? Format::kMjcf
                        : suffix == ".npz" ? Format::kNpz
                        : suffix == ".csv" ? Format::kCsv
                                           : Format::kScene;
  if (format == Format::kScene && !isMujocoModel(options.source)) {
    throw InputError("--out: found the scene file " + options.output.string() + " to be made of " +
                     options.source.string() + ", expected a model of MuJoCo, .xml");
  }
  if (options.within && format != Format::kGlb) {
    throw InputError("--within: found the file " + options.output.string() +
                     ", which has no keys; expected a .glb");
  }
  if (options.every && format != Format::kNpz && format != Format::kCsv) {
    throw InputError("--every: found the file " + options.output.string() +
                     ", which has no rows; expected a table");
  }
  const double within = options.within.value_or(kUsualGlbError);
  if (!(within >= kLeastGlbError && within <= kMostGlbError)) {
    throw InputError("--within: found " + brief(within) + ", expected " + brief(kLeastGlbError) + " to " +
                     brief(kMostGlbError));
  }
  if (isSameFile(options.output, options.source)) {
    throw InputError("--out: found the run itself, " + options.output.string() + ", expected another file");
  }
  return format;
}

void writeGlb(const ExportOptions& options, const Trajectory& run) {
  const GlbFile glb = encodeGlb(
      run, {.within = options.within.value_or(kUsualGlbError), .program = "careen " CAREEN_VERSION});
  writeFile(options.output, glb.bytes);
  std::cout << "keys         " << glb.keys << ", " << glb.bytes.size() << " bytes; off by at most "
            << brief(glb.positionError, 2) << " m and " << brief(glb.attitudeError, 2) << " rad\n";
}

void writeMjcf(const ExportOptions& options, const Trajectory& run) {
  const MjcfFile mjcf = encodeMjcf(run, "careen " CAREEN_VERSION);
  writeFile(options.output, mjcf.text);
  for (const std::string& words : mjcf.leftOut) {
    std::cout << "left out     " << words << '\n';
  }
}

// Boxes may overlap, as in MuJoCo: whoever runs the scene decides what then.
void writeScene(const ExportOptions& options) {
  const auto [text, name] = sceneTextOf(options.source, readFile(options.source));
  static_cast<void>(parseScene(text, name, Starts::kMayOverlap));
  writeFile(options.output, text);
}

ExitCode exportCommand(const ExportOptions& options, const std::stop_token& stop) {
  const Format format = formatOf(options);
  if (format == Format::kScene) {
    writeScene(options);
    std::cout << "written      " << printableName(options.output.string()) << '\n';
    return ExitCode::kDone;
  }
  Run run = loadRun(options.source, {}, options.scene, stop);
  auditRun(run, options.audit, stop);
  const double every = options.every.value_or(kUsualSampling);
  switch (format) {
    case Format::kGlb:
      writeGlb(options, run.trajectory);
      break;
    case Format::kMjcf:
      writeMjcf(options, run.trajectory);
      break;
    case Format::kNpz:
      writeFile(options.output, encodeNpz(run.trajectory, every));
      break;
    case Format::kCsv: {
      AtomicFile file(options.output);
      writePosesCsv(run.trajectory, every, [&file](std::string_view text) { file.write(text); });
      file.commit();
      break;
    }
    case Format::kScene:
      break;  // done above: it needs no run
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
      .add("-o,--out", options->output,
           "The file: .glb (a film for Blender, three.js and viewers of glTF), .xml (its start, for MuJoCo), "
           ".npz or .csv (tables of poses); of a model of MuJoCo also .json (a scene)")
      .required();
  command.add("--within", options->within,
              "How far a .glb may be off between its keys, in m and rad (default: 1e-4)");
  command.add("--every", options->every, "Time between two poses of a table [s] (default: 1/60)");
  options->scene.addTo(command);
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) { return exportCommand(*options, stop); });
}

}  // namespace careen
