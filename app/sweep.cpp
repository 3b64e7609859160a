#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "core/system/processor.h"
#include "core/system/shared_work.h"
#include "parsed.h"
#include "run.h"
#include "sweep/sweep.h"

namespace careen {
namespace {

struct SweepOptions {
  std::filesystem::path family;
  std::filesystem::path folder;
  std::string runs = "0-99";
  std::string share;
  std::string keep;
  std::optional<int> jobs;
  bool resume = false;
  AuditChoice audit;
};

SweepSettings settingsOf(const SweepOptions& options) {
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
  settings.program = "careen " CAREEN_VERSION;
  return settings;
}

// One line that fills on a terminal, otherwise a line every few seconds.
class SweepReport {
 public:
  void operator()(const SweepProgress& now) {
    constexpr double kOftenEnough = 5;  // [s]
    if (!terminal_ && now.done != now.total && stopwatch_.seconds() - toldAt_ < kOftenEnough) {
      return;
    }
    toldAt_ = stopwatch_.seconds();
    std::cerr << (terminal_ ? "\r" : "") << "run " << now.done << " of " << now.total << ", "
              << brief(now.secondsLeft, 3) << " s left" << (terminal_ && now.done != now.total ? "   " : "\n")
              << std::flush;
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  Stopwatch stopwatch_;
  double toldAt_ = 0;  // [s]
};

ExitCode sweepCommand(const SweepOptions& options, const std::stop_token& stop) {
  const SweepSettings settings = settingsOf(options);
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
  if (figures.broken > 0) {
    std::cerr << "careen: " << figures.broken
              << " rows of the table are of runs that break a promise of their method "
              << "(column broken)\n";
  }
  return figures.broken > 0 && !options.audit.keepGoing ? ExitCode::kNumbersFailed : ExitCode::kDone;
}

}  // namespace

void addSweep(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("sweep", "Many runs of a family: a scene whose numbers may be distributions");
  const auto options = std::make_shared<SweepOptions>();
  command.add("family", options->family, "A scene with distributions, such as {\"uniform\": [0.1, 0.4]}")
      .required();
  command.add("--runs", options->runs,
              "Which runs, such as 0-9999 (default: 0-99); run k is the same everywhere");
  command.add("--out", options->folder, "Folder for the table (default: out/ and the family's name)");
  const CommandOption share =
      command.add("--share", options->share,
                  "Only a part, 0/10 … 9/10, of these runs; --resume without it joins all parts");
  command.addFlag("--resume", options->resume, "Keep the runs of the same sweep that are there")
      .excludes(share);
  command.add("--keep", options->keep, "runs: each run's trajectory too, as runs/0000017.careen")
      .oneOf({"runs"});
  command.add("--jobs", options->jobs, "Processes (default: one for each core)");
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) { return sweepCommand(*options, stop); });
}

}  // namespace careen
