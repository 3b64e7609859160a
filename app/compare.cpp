#include "compare.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "commands.h"
#include "compare/report.h"
#include "compare/report_words.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/names.h"
#include "core/system/processor.h"
#include "parsed.h"
#include "run_options.h"
#include "runs/compare_files.h"

namespace careen {
namespace {

constexpr int kMostThreads = 256;
constexpr std::size_t kMostFramesTold = 10;

void printFrame(std::ostream& out, const FrameComparison& frame) {
  const char* const only = frame.verdict == Verdict::kWarning ? "warning: " : "";
  for (const std::string& reason : frame.reasons) {
    out << "  " << only << printableName(frame.name + ": " + reason) << '\n';
  }
}

void printRun(std::ostream& out, const RunDifference& run) {
  for (const std::string& reason : run.incomparable) {
    out << "  " << printableName(reason) << '\n';
  }
  if (run.firstTime) {
    out << "  first difference of a state at " << brief(*run.firstTime) << " s\n";
  }
  if (run.worst.difference.relative > 0) {
    out << "  largest difference" << (run.horizon ? " before that horizon" : "") << ' '
        << brief(run.worst.difference.position) << " m, " << brief(run.worst.difference.angle) << " rad, at "
        << brief(run.worst.time) << " s, " << printableName(run.worst.body) << '\n';
  }
  if (run.firstImpact) {
    out << "  first impact that differs, number " << run.firstImpact->index + 1 << ": "
        << printableName(run.firstImpact->what) << '\n';
  }
  if (run.firstOtherEvent && run.firstOtherEvent->what != run.firstImpact->what) {
    out << "  first other impact, number " << run.firstOtherEvent->index + 1 << ": "
        << printableName(run.firstOtherEvent->what) << '\n';
  }
  if (run.lastImpact) {
    out << "  after impact number " << run.lastImpact->index + 1 << ": "
        << printableName(run.lastImpact->what) << '\n';
  }
  if (!run.firstBroken.empty()) {
    out << "  broken first, " << printableName(run.firstBroken) << '\n';
  }
  if (run.expectedDuration != run.actualDuration && !run.until) {
    out << "  they last " << brief(run.expectedDuration) << " and " << brief(run.actualDuration) << " s\n";
  }
  if (!run.sameBits && run.incomparable.empty()) {
    out << "  impacts " << run.expectedImpacts << " and " << run.actualImpacts
        << ", kinetic energy at the end " << brief(run.expectedEnergy) << " and " << brief(run.actualEnergy)
        << " J\n";
  }
}

void print(std::ostream& out, const Comparison& comparison) {
  constexpr std::array<const char*, 3> kVerdicts = {"same", "same, with a warning", "differs"};
  out << kVerdicts.at(static_cast<std::size_t>(comparison.verdict)) << ": "
      << printableName(comparison.headline);
  if (!comparison.frames.empty()) {
    out << " (" << comparison.toleranceName << ')';
  }
  out << '\n';
  if (!comparison.ignored.empty()) {
    out << "  not compared: " << printableName(joined(comparison.ignored.names())) << '\n';
  }
  if (comparison.run) {
    printRun(out, *comparison.run);
  }
  std::size_t told = 0;
  std::size_t untold = 0;
  for (const FrameComparison& frame : comparison.frames) {
    if (frame.verdict != Verdict::kSame && told < kMostFramesTold) {
      printFrame(out, frame);
      ++told;
    } else if (frame.verdict != Verdict::kSame) {
      ++untold;
    }
  }
  if (untold > 0) {
    out << "  and " << untold << " frames more\n";
  }
  if (comparison.verdict != Verdict::kSame) {
    for (const Fact& fact : comparison.facts) {
      if (fact.expected != fact.actual) {
        out << "  " << printableName(fact.name + ": " + fact.expected + ", found " + fact.actual) << '\n';
      }
    }
  }
}

}  // namespace

void CompareOptions::addTo(const CommandLine& command) {
  command.add("--threshold", threshold, "What may differ, by name: " + listed(kToleranceNames))
      .showsDefault();
  command
      .add("--allow", allowed,
           "Other numbers than those of the threshold, such as failpercent=5,ssim=0.9 (see 'careen help "
           "comparing')")
      .delimiter(',');
  command
      .add("--motion", motion,
           "Of runs and films: same, bit for bit; any; or how far apart boxes may be in runs, in their "
           "half diagonals or radians")
      .showsDefault();
  command.add("--until", until, "Of runs: compare up to this moment, s");
  command
      .add(
          "--ignore", ignored,
          "Of pictures: what does not count, x,y,width,height in pixels or a PNG that is white there; may be "
          "repeated")
      .onePerUse();
  command.addFlag("--flip", flip, "Measure FLIP, too, which takes longer");
}

ComparisonSettings CompareOptions::settings() const {
  ComparisonSettings settings;
  settings.program = "careen " CAREEN_VERSION;
  settings.toleranceName = threshold;
  settings.tolerance = parsed("--threshold", threshold, toleranceOf);
  for (const std::string& each : allowed) {
    settings.toleranceName += ", " + parsed("--allow", each, [&](const std::string& text) {
                                return setLimit(settings.tolerance, text);
                              });
  }
  settings.motionCounts = motion != "any";
  if (motion != "any" && motion != "same") {
    settings.motionTolerance =
        numberIn("--motion", motion, "same, any, or how far apart boxes may be, in their sizes or radians",
                 kAboveZero);
  }
  if (until) {
    if (!(*until > 0)) {
      throw InputError("--until: found " + brief(*until) + ", expected more than 0 s");
    }
    settings.until = *until;
  }
  for (const std::string& region : ignored) {
    settings.ignored.add(region);
  }
  settings.flip = flip;
  settings.only = only;
  settings.threads = threads.value_or(std::min(usableCores(), kMostThreads));
  if (settings.threads < 1 || settings.threads > kMostThreads) {
    throw InputError("--threads: found " + std::to_string(settings.threads) + ", expected 1 to " +
                     std::to_string(kMostThreads));
  }
  return settings;
}

void tell(const Comparison& comparison, bool logsFrames) {
  if (logsFrames) {
    for (const FrameComparison& frame : comparison.frames) {
      std::cout << frameJson(frame) << '\n';
    }
  }
  std::ostream& out = logsFrames ? std::cerr : std::cout;
  print(out, comparison);
  out.flush();  // the verdict is printed even if a later step fails
}

ExitCode exitCodeOf(const Comparison& comparison) {
  return comparison.verdict == Verdict::kDifferent ? ExitCode::kDifferent : ExitCode::kDone;
}

void addCompare(const CommandLine& commandLine) {
  struct Arguments {
    std::filesystem::path expected, actual;
    CompareOptions options;
    SceneOfTable scene;
    std::filesystem::path report;  // empty: no report
    std::string log = "text";
  };
  const CommandLine command =
      commandLine.addCommand("compare", "Whether two pictures, folders of frames, or runs are the same");
  const auto arguments = std::make_shared<Arguments>();
  command
      .add("expected", arguments->expected, "Picture (PNG), folder of frames, run.careen, or table of poses")
      .required();
  command.add("actual", arguments->actual, "What is to be the same").required();
  arguments->scene.addTo(command);
  arguments->options.addTo(command);
  command.add("-o,--out", arguments->report, "Folder for a report: index.html, report.json, junit.xml");
  command.add("--threads", arguments->options.threads,
              "Frames compared side by side; as many as there are cores");
  command.add("--log", arguments->log, "text, or json: a line for each frame on the standard output")
      .oneOf({"text", "json"});
  command.runs([arguments](const std::stop_token& stop) {
    const bool logsFrames = arguments->log == "json";
    const std::filesystem::path& expected = arguments->expected;
    const std::filesystem::path& actual = arguments->actual;
    const std::filesystem::path& folder = arguments->report;
    if (!folder.empty()) {
      refuseReportIn(folder, expected, actual);
    }
    if (arguments->scene.given() != nullptr && !isTable(expected) && !isTable(actual)) {
      throw InputError(std::string(arguments->scene.given()) + ": found no table of poses, which it is for");
    }
    const Comparison comparison =
        compareFiles(expected, actual, arguments->options.settings(), arguments->scene.reading(), stop);
    tell(comparison, logsFrames);
    if (!folder.empty()) {
      writeReport(folder, comparison);
      (logsFrames ? std::cerr : std::cout)
          << "report: " << std::filesystem::absolute(folder / "index.html").lexically_normal().string()
          << '\n';
    }
    return exitCodeOf(comparison);
  });
}

}  // namespace careen
