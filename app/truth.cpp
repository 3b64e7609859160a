#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/processor.h"
#include "core/system/shared_work.h"
#include "film/frame_range.h"
#include "parsed.h"
#include "picture_size.h"
#include "run_options.h"
#include "truth/truth_film.h"

namespace careen {
namespace {

struct TruthOptions {
  std::filesystem::path source;
  std::filesystem::path folder;
  std::string channels = "all";
  std::string frames;
  SizeAndRate picture;
  std::optional<int> jobs;
  SceneOfTable scene;
  AuditChoice audit;
};

ExitCode truthCommand(TruthOptions options, const std::stop_token& stop) {
  if (options.source.empty()) {
    options.source = defaultScene();
  }
  TruthSettings settings;
  settings.folder =
      options.folder.empty() ? std::filesystem::path("out") / options.source.stem() : options.folder;
  settings.channels = parsed("--channels", options.channels, channelsNamed);
  settings.program = "careen " CAREEN_VERSION;
  if (!options.frames.empty()) {
    settings.frames = parseFrameRanges(options.frames);
  }
  settings.jobs = options.jobs.value_or(std::min(usableCores(), kMostProcesses));
  if (settings.jobs < 1 || settings.jobs > kMostProcesses) {
    throw InputError("--jobs: found " + std::to_string(settings.jobs) + ", expected 1 to " +
                     std::to_string(kMostProcesses));
  }
  PictureSettings checked;
  options.picture.applyTo(checked);
  Run run = loadRun(options.source, {}, options.scene, stop);
  auditRun(run, options.audit, stop);
  PictureSettings& picture = run.trajectory.stage.picture;
  options.picture.applyTo(picture);
  const Stopwatch stopwatch;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::int64_t frames = writeTruth(
      run.trajectory, settings,
      [&](std::int64_t done, std::int64_t total) {
        if (terminal) {
          std::cerr << "\r" << done << " of " << total << " frames" << (done == total ? "\n" : "")
                    << std::flush;
        }
      },
      stop);
  std::cout << "truth        " << frames << " frames, " << picture.width << 'x' << picture.height << ", "
            << settings.channels.text() << ", in " << stopwatch.seconds()
            << " s: " << printableName(settings.folder.string()) << '\n';
  return ExitCode::kDone;
}

}  // namespace

void addTruth(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("truth", "Labels of every pixel of a film's frames, exact, without drawing");
  const auto options = std::make_shared<TruthOptions>();
  command.add("file", options->source,
              "Scene, trajectory file or table of poses; the default scene if none is named");
  options->scene.addShowingTo(command);
  command.add("-o,--out", options->folder, "Folder (default: out/ and the file's name)");
  command.add("--channels", options->channels,
              "Names with commas between, of: depth, distance, instance, face, normal, coordinates, flow, "
              "visibility (default: all)");
  command.add("--frames", options->frames, "Which frames, such as 0-119,200:2 (default: all)");
  options->picture.addTo(command);
  command.add("--jobs", options->jobs,
              "Frames at once, each in a process of its own (default: one for each core)");
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) { return truthCommand(*options, stop); });
}

}  // namespace careen
