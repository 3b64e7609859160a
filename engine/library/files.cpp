// Runs beside runs, as files of other programs, and by the thousand.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "compare/report.h"
#include "compare/run_difference.h"
#include "core/error.h"
#include "core/math/arithmetic.h"
#include "core/system/file.h"
#include "core/system/processor.h"
#include "exchange/exporters.h"
#include "library/careen.h"
#include "library/run_data.h"
#include "library/translated.h"
#include "runs/compare_files.h"
#include "sweep/sweep.h"

namespace careen::v1 {

void Run::exportTo(const std::filesystem::path& path, double every) const {
  const DefaultFloatEnvironment usual;
  translated("", [&] {
    const std::string suffix = path.extension().string();
    const auto* const found = std::find_if(kExporters.begin(), kExporters.end(),
                                           [&](const Exporter* each) { return each->suffix == suffix; });
    if (found == kExporters.end()) {
      std::string known;
      for (const Exporter* const each : kExporters) {
        known.append(known.empty() ? "" : ", ").append(each->suffix);
      }
      throw InputError(path.string() + ": found a name that ends in '" + suffix +
                       "', expected one of: " + known);
    }
    AtomicFile file(path);
    ExportSettings settings{.program = version()};
    settings.every = every;
    (*found)->write(data_->trajectory, settings, [&file](std::string_view text) { file.write(text); });
    file.commit();
  });
}

Difference Run::differenceFrom(const Run& other) const {
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    const RunDifference found = differenceOf(other.data_->trajectory, data_->trajectory);
    return Difference{.incomparable = found.incomparable,
                      .same = found.sameBits,
                      .from = found.firstTime,
                      .position = found.worst.difference.position,
                      .angle = found.worst.difference.angle,
                      .box = found.worst.body,
                      .time = found.worst.time,
                      .horizon = found.horizon,
                      .firstImpact = found.firstImpact ? found.firstImpact->what : ""};
  });
}

Comparison compare(const std::filesystem::path& expected, const std::filesystem::path& actual,
                   const Allowed& allowed, const std::filesystem::path& page,
                   const std::filesystem::path& scene) {
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    ComparisonSettings settings;
    settings.program = version();
    settings.toleranceName = allowed.threshold;
    settings.tolerance = toleranceOf(allowed.threshold);
    for (const std::string& limit : allowed.limits) {
      settings.toleranceName += ", " + setLimit(settings.tolerance, limit);
    }
    settings.motionCounts = allowed.motion.has_value();
    settings.motionTolerance = allowed.motion.value_or(0);
    settings.until = allowed.until.value_or(settings.until);
    for (const std::string& region : allowed.ignored) {
      settings.ignored.add(region);
    }
    settings.threads = usableCores();
    if (!page.empty()) {
      refuseReportIn(page, expected, actual);
    }
    const careen::Comparison found = compareFiles(
        expected, actual, settings, {.scene = scene.empty() ? std::nullopt : std::optional(scene)});
    if (!page.empty()) {
      writeReport(page, found);
    }
    Comparison comparison{.same = found.verdict != Verdict::kDifferent,
                          .headline = found.headline,
                          .different = {},
                          .report = reportJson(found) + "\n"};
    for (const FrameComparison& frame : found.frames) {
      if (frame.verdict == Verdict::kDifferent) {
        comparison.different.push_back(frame.name);
      }
    }
    return comparison;
  });
}

SweepTable sweep(const Sweep& sweep) {
  return translated(sweep.family.string(), [&] {
    if (sweep.first < 0 || sweep.last < sweep.first || sweep.last - sweep.first >= kMostRuns) {
      throw InputError("found runs " + std::to_string(sweep.first) + " to " + std::to_string(sweep.last) +
                       ", expected a range from 0 on");
    }
    SweepSettings settings;
    settings.folder = sweep.folder;
    settings.runs = {.first = sweep.first, .last = sweep.last};
    settings.asked = {.questions = sweep.when, .errors = sweep.estimateErrors};
    settings.jobs = std::max(sweep.jobs.value_or(usableCores()), 1);
    settings.program = version();
    const std::string text = readFile(sweep.family);
    const SweepFigures figures = runSweep(Family(text, sweep.family.string()), text, settings);
    return SweepTable{.path = sweep.folder / "table.csv",
                      .rows = static_cast<long>(figures.rows),
                      .broken = static_cast<long>(figures.broken)};
  });
}

}  // namespace careen::v1
