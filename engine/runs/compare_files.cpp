#include "runs/compare_files.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <system_error>

#include "audit/audit.h"
#include "compare/films.h"
#include "core/brief.h"
#include "core/error.h"
#include "film/manifest.h"

namespace careen {
namespace {

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

// Tables are read with the scene named, or else with that of the other run, and audited.
Comparison compareRunsOrTables(const std::filesystem::path& expected, const std::filesystem::path& actual,
                               const ComparisonSettings& settings, const RunReading& tables,
                               const std::stop_token& stop) {
  const bool areBoth = isTable(expected) && isTable(actual);
  const RunReading asItIs{.notice = tables.notice};
  std::string broken;
  const auto read = [&](const std::filesystem::path& path) {
    const auto setupOfOther = [&]() -> RunSetup {
      const Trajectory other = readRun(path == expected ? actual : expected, asItIs);
      return static_cast<const RunSetup&>(other);
    };
    Trajectory run = isTable(path)
                         ? readRun(path, tables, areBoth ? std::function<RunSetup()>() : setupOfOther)
                         : readRun(path, asItIs);
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

}  // namespace

Comparison compareFiles(const std::filesystem::path& expected, const std::filesystem::path& actual,
                        const ComparisonSettings& settings, const RunReading& tables,
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
    return compareRunsOrTables(expected, actual, settings, tables, stop);
  }
  if (settings.motionTolerance > 0) {
    throw InputError("--motion: found " + brief(settings.motionTolerance) + " and " + nameOf(kind) +
                     ", expected same or any: only of runs it is known how far apart boxes are");
  }
  return kind == Kind::kPicture ? comparePictures(expected, actual, settings)
                                : compareFilms(expected, actual, settings, stop);
}

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

}  // namespace careen
