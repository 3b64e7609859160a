#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "core/system/processor.h"
#include "core/system/shared_work.h"
#include "film/frame_range.h"
#include "parsed.h"
#include "picture_size.h"
#include "run_options.h"
#include "simulation_progress.h"
#include "status_line.h"
#include "sweep/sweep.h"
#include "trajectory/trajectory.h"
#include "truth/truth_film.h"

namespace careen {
namespace {

struct SweepOptions {
  std::filesystem::path family;
  std::filesystem::path folder;
  std::string runs = "0-99";
  std::string share;
  std::string keep;
  bool film = false;
  std::optional<std::string> truth;
  std::string frames;
  SizeAndRate picture;
  std::optional<int> jobs;
  bool resume = false;
  OutcomesAsked asked;
  AuditChoice audit;
};

// Films and labels of single runs, in one folder for each.
void addFiles(SweepSettings& settings, const SweepOptions& options, const DrawFilm& drawFilm) {
  if (!options.film && !options.truth) {
    const char* const given = options.picture.size      ? "--size"
                              : options.picture.rate    ? "--fps"
                              : !options.frames.empty() ? "--frames"
                                                        : nullptr;
    if (given != nullptr) {
      throw InputError(std::string(given) + ": found no frames that it is for, expected " +
                       (drawFilm ? "--film or --truth" : "--truth") + " too");
    }
    return;
  }
  PictureSettings checked;
  options.picture.applyTo(checked);
  const std::vector<FrameRange> frames =
      options.frames.empty() ? std::vector<FrameRange>() : parseFrameRanges(options.frames);
  TruthSettings truth{.folder = {}, .frames = frames, .channels = {}, .program = settings.program};
  if (options.film) {
    settings.written.emplace_back("film", "yes");
  }
  if (options.truth) {
    truth.channels = parsed("--truth", *options.truth, channelsNamed);
    settings.written.emplace_back("truth", truth.channels.text());
  }
  settings.written.emplace_back("size", options.picture.size.value_or("of the family"));
  settings.written.emplace_back("fps", options.picture.rate.value_or("of the family"));
  settings.written.emplace_back("frames", options.frames.empty() ? "all" : options.frames);
  settings.writeRun = [options, drawFilm, truth, frames](Trajectory& run, const std::filesystem::path& folder,
                                                         const std::stop_token& stop) {
    options.picture.applyTo(run.stage.picture);
    if (options.film) {
      drawFilm(run, folder, frames, stop);
    }
    if (options.truth) {
      TruthSettings here = truth;
      here.folder = folder;
      writeTruth(run, here, {}, stop);
    }
  };
}

SweepSettings settingsOf(const SweepOptions& options, const DrawFilm& drawFilm) {
  SweepSettings settings;
  settings.folder =
      options.folder.empty() ? std::filesystem::path("out") / options.family.stem() : options.folder;
  settings.runs = parsed("--runs", options.runs, parseRuns);
  if (!options.share.empty()) {
    settings.share = parsed("--share", options.share, parseShare);
  }
  settings.jobs = options.jobs.value_or(std::min(usableCores(), kMostProcesses));
  if (settings.jobs < 1 || settings.jobs > kMostProcesses) {
    throw InputError("--jobs: found " + std::to_string(settings.jobs) + ", expected 1 to " +
                     std::to_string(kMostProcesses));
  }
  settings.resume = options.resume;
  settings.keepRuns = !options.keep.empty();
  settings.audit = options.audit.auditDepth();
  settings.asked = options.asked;
  settings.program = "careen " CAREEN_VERSION;
  addFiles(settings, options, drawFilm);
  return settings;
}

// One line that is rewritten on a terminal, otherwise a line every few seconds.
class SweepReport {
 public:
  void operator()(const SweepProgress& now) {
    constexpr double kOftenEnough = 5;  // [s]
    const std::string words = "run " + std::to_string(now.done) + " of " + std::to_string(now.total) + ", " +
                              inTime(now.secondsLeft) + " left";
    const bool last = now.done == now.total;
    if (line_.isOnTerminal()) {
      last ? line_.keep(words) : line_.show(words);
    } else if (last || stopwatch_.seconds() - toldAt_ >= kOftenEnough) {
      toldAt_ = stopwatch_.seconds();
      std::cerr << words << '\n' << std::flush;
    }
  }

 private:
  StatusLine line_;
  Stopwatch stopwatch_;
  double toldAt_ = 0;  // [s]
};

ExitCode sweepCommand(const SweepOptions& options, const DrawFilm& drawFilm, const std::stop_token& stop) {
  const SweepSettings settings = settingsOf(options, drawFilm);
  const std::string text = readFile(options.family);
  const Family family(text, options.family.string());
  const Stopwatch stopwatch;
  SweepReport report;
  const SweepFigures figures = runSweep(
      family, text, settings, [&report](const SweepProgress& now) { report(now); }, stop);
  std::cout << "runs         " << figures.simulated << " in " << brief(stopwatch.seconds()) << " s, "
            << figures.skipped << " of them were there already\n";
  const std::string folder = printableName(settings.folder.string());
  if (figures.missing > 0 || settings.share.count > 1) {
    std::cout << "missing      " << figures.missing
              << " runs of other shares; then join with --resume: " << folder << '\n';
    return ExitCode::kDone;
  }
  std::cout << "table        " << folder << "/table.csv, table.npz";
  if (figures.rows > 0) {
    std::cout << ": " << figures.rows << " rows";
  }
  std::cout << '\n';
  if (settings.writeRun) {
    std::cout << "files        " << folder << "/runs: a folder for each run\n";
  }
  if (figures.broken > 0) {
    std::cerr << "careen: " << figures.broken
              << " rows of the table are of runs that break a promise of their method "
              << "(column broken)\n";
  }
  return figures.broken > 0 && !options.audit.keepGoing ? ExitCode::kNumbersFailed : ExitCode::kDone;
}

}  // namespace

void addSweep(const CommandLine& commandLine, const DrawFilm& drawFilm) {
  const CommandLine command =
      commandLine.addCommand("sweep", "Many runs of a family: a scene whose numbers may be distributions");
  const auto options = std::make_shared<SweepOptions>();
  command.add("family", options->family, "A scene with distributions, such as {\"uniform\": [0.1, 0.4]}")
      .required();
  command.add("--runs", options->runs,
              "Which runs, such as 0-9999 (default: 0-99); run k is the same everywhere");
  command.add("-o,--out", options->folder, "Folder for the table (default: out/ and the family's name)");
  const CommandOption share =
      command.add("--share", options->share,
                  "Only a part, 0/10 … 9/10, of these runs; --resume without it joins all parts");
  command.addFlag("--resume", options->resume, "Keep the runs of the same sweep that are there")
      .excludes(share);
  command.add("--keep", options->keep, "runs: each run's trajectory too, as runs/0000017.careen")
      .oneOf({"runs"});
  command
      .add("--when", options->asked.questions,
           "A column with the first moment at which this is true, such as 'a touches b' (see 'careen when')")
      .onePerUse();
  command.addFlag("--estimate-error", options->asked.errors,
                  "Columns with each run's error, from other runs: it takes two to four times as long");
  if (drawFilm) {
    command.addFlag("--film", options->film,
                    "Each run's film too, as by 'careen render', in a folder such as runs/0000017");
  }
  command.add("--truth", options->truth,
              "Labels of every pixel of each run's frames, as by 'careen truth': all, or names such as "
              "depth,instance,flow");
  command.add("--frames", options->frames, "Which frames of each run, such as 0-119,200:2 (default: all)");
  options->picture.addTo(command);
  command.add("--jobs", options->jobs, "Processes (default: one for each core)");
  options->audit.addTo(command);
  command.runs(
      [options, drawFilm](const std::stop_token& stop) { return sweepCommand(*options, drawFilm, stop); });
}

}  // namespace careen
