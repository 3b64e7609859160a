#include "compare.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>

#include "commands.h"
#include "compare/report.h"
#include "compare/report_words.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/names.h"
#include "core/system/processor.h"
#include "film/manifest.h"
#include "parsed.h"
#include "run.h"

namespace careen {
namespace {

constexpr int kMostThreads = 256;
constexpr std::size_t kMostFramesTold = 10;

/// A number of a threshold that may be given.
struct Override {
  std::string_view name;  // as idiff's options, where it has one
  double Tolerance::*value;
  double most;
};

constexpr double kAny = Tolerance::kAny;
constexpr std::array<Override, 10> kOverrides = {{{"fail", &Tolerance::fail, 1},
                                                  {"failpercent", &Tolerance::failPercent, 100},
                                                  {"hardfail", &Tolerance::hardFail, kAny},
                                                  {"warn", &Tolerance::warn, 1},
                                                  {"warnpercent", &Tolerance::warnPercent, 100},
                                                  {"hardwarn", &Tolerance::hardWarn, kAny},
                                                  {"changedpercent", &Tolerance::changedPercent, 100},
                                                  {"edgepercent", &Tolerance::edgePercent, 100},
                                                  {"ssim", &Tolerance::leastSsim, 1},
                                                  {"windowssim", &Tolerance::leastWindowSsim, 1}}};

// NAME=NUMBER.
void allow(const std::string& text, ComparisonSettings& settings) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const auto* const found = std::find_if(kOverrides.begin(), kOverrides.end(), [&](const Override& each) {
    return each.name == std::string_view(text).substr(0, equals);
  });
  if (found == kOverrides.end()) {
    std::string known;
    for (const Override& each : kOverrides) {
      known.append(known.empty() ? "" : ", ").append(each.name);
    }
    throw InputError("--allow: found '" + text + "', expected NAME=NUMBER, with one of: " + known);
  }
  const char* const begin = text.data() + std::min(equals + 1, text.size());
  double limit = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), limit);
  if (error != std::errc() || end != text.data() + text.size() || !(limit >= 0 && limit <= found->most)) {
    throw InputError("--allow: found '" + text + "', expected " + std::string(found->name) + "=0 " +
                     (found->most < kAny ? "to " + brief(found->most) : "or more"));
  }
  settings.tolerance.*found->value = limit;
  settings.toleranceName.append(", ").append(found->name).append("=").append(brief(limit));
}

double motionToleranceOf(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !(value > 0) || !std::isfinite(value)) {
    throw InputError("--motion: found '" + text +
                     "', expected same, any, or how far apart boxes may be, in their sizes or radians");
  }
  return value;
}

enum class Kind { kPicture, kFolder, kRun };

Kind kindOf(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    return Kind::kFolder;
  }
  std::ifstream stream(path, std::ios::binary);
  if (stream.peek() == std::ifstream::traits_type::eof()) {
    throw InputError(path.string() + (std::filesystem::exists(path, none) ? ": is empty" : ": is not there") +
                     ", expected a picture, a folder of frames, or a run");
  }
  return isRun(path) ? Kind::kRun : Kind::kPicture;
}

const char* nameOf(Kind kind) {
  return kind == Kind::kPicture ? "a picture" : kind == Kind::kFolder ? "a folder" : "a run";
}

// What the films' manifests say, if both folders have one.
struct Films {
  std::vector<Fact> facts;
  std::optional<bool> sameMotion;
  bool any = false;  ///< one of the folders has a manifest
};

Films filmsIn(const std::filesystem::path& expected, const std::filesystem::path& actual) {
  Films films;
  const std::optional<FilmManifest> one = readManifest(expected);
  const std::optional<FilmManifest> other = readManifest(actual);
  films.any = one || other;
  if (one && other) {
    films.sameMotion = one->stateHash == other->stateHash;
    films.facts = {{"scene hash", one->sceneHash, other->sceneHash},
                   {"state hash", one->stateHash, other->stateHash},
                   {"program", one->program, other->program},
                   {"renderer", one->renderer, other->renderer},
                   {"libraries", one->libraries, other->libraries},
                   {"frames per second", one->picture.rate.text(), other->picture.rate.text()},
                   {"frames of the film", std::to_string(one->frameCount), std::to_string(other->frameCount)},
                   {"look", nameOf(one->picture.look), nameOf(other->picture.look)},
                   {"antialiasing", nameOf(one->picture.antialiasing), nameOf(other->picture.antialiasing)},
                   {"shutter", one->picture.shutter.text(), other->picture.shutter.text()},
                   {"overlays", one->picture.overlays.text(), other->picture.overlays.text()},
                   {"alpha", one->picture.alpha ? "yes" : "no", other->picture.alpha ? "yes" : "no"},
                   {"light", one->picture.light.text(), other->picture.light.text()}};
  }
  return films;
}

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

// Tables are read with the scene named, or else with that of the other run, and audited.
Comparison compareRunsOrTables(const std::filesystem::path& expected, const std::filesystem::path& actual,
                               const ComparisonSettings& settings, const SceneOfTable& scene,
                               const std::stop_token& stop) {
  const bool areBoth = isTable(expected) && isTable(actual);
  if (scene.given() != nullptr && !isTable(expected) && !isTable(actual)) {
    throw InputError(std::string(scene.given()) +
                     ": found two runs, which have their scenes; expected a table of poses");
  }
  std::string broken;
  const auto read = [&](const std::filesystem::path& path) {
    const auto setupOfOther = [&]() -> RunSetup { return readRun(path == expected ? actual : expected, {}); };
    Trajectory run = isTable(path)
                         ? readRun(path, scene, areBoth ? std::function<RunSetup()>() : setupOfOther)
                         : readRun(path, {});
    if (run.given && path == actual) {
      const Audit found = audit(run, AuditDepth::kFull, stop);
      broken = found.breaches.empty() ? "" : describe(found.breaches.front(), run);
    }
    return run;
  };
  Comparison comparison = compareRuns(expected, actual, settings, read);
  comparison.run->firstBroken = broken;
  return comparison;
}

bool liesIn(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto placeOf = [](const std::filesystem::path& each) {
    // "a/" has an empty last element
    const std::filesystem::path place =
        std::filesystem::weakly_canonical(std::filesystem::absolute(each)).lexically_normal();
    return place.has_filename() ? place : place.parent_path();
  };
  const std::filesystem::path inner = placeOf(path);
  const std::filesystem::path outer = placeOf(folder);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// A report must not mix with what is compared, nor with a film.
void refuseReportIn(const std::filesystem::path& report, const std::filesystem::path& expected,
                    const std::filesystem::path& actual) {
  for (const std::filesystem::path& compared : {expected, actual}) {
    if (liesIn(report, compared)) {
      throw InputError("--out: found " + report.string() + ", which is or lies in " + compared.string() +
                       ", expected a folder outside of what is compared");
    }
  }
  std::error_code none;
  if (std::filesystem::exists(report / kManifestName, none)) {
    throw InputError("--out: found " + report.string() + ", which holds a film, expected another folder");
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
    allow(each, settings);
  }
  settings.motionCounts = motion != "any";
  if (motion != "any" && motion != "same") {
    settings.motionTolerance = motionToleranceOf(motion);
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

Comparison compare(const std::filesystem::path& expected, const std::filesystem::path& actual,
                   const ComparisonSettings& settings, const SceneOfTable& scene,
                   const std::stop_token& stop) {
  const Kind kind = kindOf(expected);
  if (const Kind other = kindOf(actual); other != kind) {
    throw InputError("found " + std::string(nameOf(kind)) + " and " + nameOf(other) +
                     ", expected two pictures, two folders or two runs");
  }
  if (kind == Kind::kRun && !settings.ignored.empty()) {
    throw InputError("--ignore: found two runs, expected pictures");
  }
  if (kind == Kind::kRun) {
    return compareRunsOrTables(expected, actual, settings, scene, stop);
  }
  if (settings.motionTolerance > 0) {
    throw InputError("--motion: found " + brief(settings.motionTolerance) + " and " + nameOf(kind) +
                     ", expected same or any: only of runs it is known how far apart boxes are");
  }
  if (scene.given() != nullptr) {
    throw InputError(std::string(scene.given()) + ": found " + nameOf(kind) + ", expected a table of poses");
  }
  if (kind == Kind::kPicture) {
    return comparePictures(expected, actual, settings);
  }
  Films films = filmsIn(expected, actual);
  ComparisonSettings ofFolders = settings;
  ofFolders.subfolders = !films.any;  // labels and reports may lie in a film's sub-folders
  Comparison comparison = compareFolders(expected, actual, ofFolders, films.sameMotion, {}, stop);
  comparison.facts = std::move(films.facts);
  return comparison;
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
    if (!arguments->report.empty()) {
      refuseReportIn(arguments->report, arguments->expected, arguments->actual);
    }
    const Comparison comparison = compare(arguments->expected, arguments->actual,
                                          arguments->options.settings(), arguments->scene, stop);
    tell(comparison, logsFrames);
    if (const std::filesystem::path& folder = arguments->report; !folder.empty()) {
      writeReport(folder, comparison);
      (logsFrames ? std::cerr : std::cout)
          << "report: " << std::filesystem::absolute(folder / "index.html").lexically_normal().string()
          << '\n';
    }
    return exitCodeOf(comparison);
  });
}

}  // namespace careen
