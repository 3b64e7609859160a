#include "sweep/sweep.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/atomic_folder.h"
#include "core/system/file.h"
#include "core/system/shared_work.h"
#include "scene/prepare.h"
#include "sweep/outcome_rows.h"
#include "sweep/sweep_folder.h"
#include "trajectory/trajectory.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

/// Reads "A<separator>B".
template <class Integer>
bool readPair(const std::string& text, char separator, Integer& first, Integer& second) {
  const char* const end = text.data() + text.size();
  const std::from_chars_result one = std::from_chars(text.data(), end, first);
  if (one.ec != std::errc() || one.ptr == end || *one.ptr != separator) {
    return false;
  }
  const std::from_chars_result two = std::from_chars(one.ptr + 1, end, second);
  return two.ec == std::errc() && two.ptr == end;
}

std::string padded(std::int64_t number) {
  const std::string digits = std::to_string(number);
  constexpr std::size_t kDigits = 7;
  return std::string(kDigits - std::min(kDigits, digits.size()), '0') + digits;
}

fs::path runFolder(const SweepSettings& settings, std::int64_t run) {
  return settings.folder / "runs" / padded(run);
}

/// The blocks of a sweep and their files.
class Blocks {
 public:
  explicit Blocks(const SweepSettings& settings)
      : settings_(settings), range_(settings.runs), most_(settings.writeRun ? 1 : kRunsOfBlock) {}

  std::int64_t count() const { return (runs() + most_ - 1) / most_; }
  std::int64_t runs() const { return range_.last - range_.first + 1; }
  RunRange range(std::int64_t block) const {
    const std::int64_t first = range_.first + block * most_;
    return {.first = first, .last = std::min(range_.last, first + most_ - 1)};
  }
  std::int64_t size(std::int64_t block) const { return range(block).last - range(block).first + 1; }
  fs::path file(std::int64_t block) const {
    return settings_.folder / "rows" /
           (padded(range(block).first) + "-" + padded(range(block).last) + ".csv");
  }
  bool isThere(std::int64_t block) const {
    std::error_code none;
    // With files of its own a run is a block.
    return fs::exists(file(block), none) &&
           (!settings_.writeRun || fs::exists(runFolder(settings_, range(block).first), none));
  }
  bool isOurs(std::int64_t block) const { return block % settings_.share.count == settings_.share.index; }

 private:
  const SweepSettings& settings_;
  RunRange range_;
  std::int64_t most_;
};

std::string manifestOf(const std::string& familyText, const SweepSettings& settings) {
  Hash hash;
  hash.add(familyText);
  nlohmann::ordered_json manifest = {
      {"program", settings.program},
      {"family_hash", hash.text()},
      {"runs", std::to_string(settings.runs.first) + "-" + std::to_string(settings.runs.last)},
      {"audit", std::string(kAuditDepthNames.at(static_cast<std::size_t>(settings.audit)))}};
  if (settings.keepRuns) {
    manifest["keep"] = "runs";
  }
  if (!settings.asked.questions.empty()) {
    manifest["when"] = nlohmann::ordered_json(settings.asked.questions).dump();
  }
  if (settings.asked.errors) {
    manifest["estimate_error"] = "yes";
  }
  for (const auto& [name, what] : settings.written) {
    manifest[name] = what;
  }
  return manifest.dump(2) + "\n";
}

SweepOpening openingOf(const SweepSettings& settings) {
  return settings.share.count > 1 ? SweepOpening::kShared
         : settings.resume        ? SweepOpening::kResumed
                                  : SweepOpening::kAnew;
}

std::string simulateBlock(const Family& family, const RunRange& range, const SweepSettings& settings,
                          const std::stop_token& stop) {
  std::string rows;
  for (std::int64_t k = range.first; k <= range.last; ++k) {
    const auto run = static_cast<std::uint64_t>(k);
    const Family::Member member = family.member(run);
    try {
      Trajectory trajectory = record(prepare(member.scene, {.threads = 1}).setup, stop);
      const Audit audited = audit(trajectory, settings.audit, stop);
      const std::optional<ErrorEstimate> error =
          settings.asked.errors ? estimateError(trajectory, stop) : std::nullopt;
      rows += outcomeRows(run, member, trajectory, audited, error, settings.asked);
      if (settings.keepRuns) {
        saveTrajectory(trajectory, settings.folder / "runs" / (padded(k) + ".careen"));
      }
      if (settings.writeRun) {
        AtomicFolder folder(runFolder(settings, k));
        settings.writeRun(trajectory, folder.path(), stop);
        folder.commit();
      }
    } catch (const Error& error) {
      throw Error(error.code(), family.name() + " (run " + std::to_string(k) + "): " + error.what());
    }
  }
  return rows;
}

SweepFigures join(const Family& family, const SweepSettings& settings, const SweepFolder& folder,
                  const Blocks& blocks, SweepFigures figures) {
  std::string rows;
  for (std::int64_t block = 0; block < blocks.count(); ++block) {
    rows += readFile(blocks.file(block));
  }
  const OutcomeTable table(family, settings.asked, rows, folder.rows().string());
  figures.rows = std::ssize(table.boxes);
  const std::vector<double>& broken = table.numbers.back();
  figures.broken = std::count_if(broken.begin(), broken.end(), [](double count) { return count > 0; });
  AtomicFile csv(folder.table(".csv"));
  AtomicFile npz(folder.table(".npz"));
  csv.write(outcomeHeader(family, settings.asked));
  csv.write(rows);
  npz.write(table.archive());
  npz.commit();
  csv.commit();
  std::error_code none;
  for (std::int64_t block = 0; block < blocks.count(); ++block) {
    fs::remove(blocks.file(block), none);
  }
  return figures;
}

}  // namespace

RunRange parseRuns(const std::string& text) {
  RunRange range;
  const char* const end = text.data() + text.size();
  const std::from_chars_result one = std::from_chars(text.data(), end, range.first);
  const bool isSingle = one.ec == std::errc() && one.ptr == end;
  if (isSingle) {
    range.last = range.first;
  }
  if (!(isSingle || readPair(text, '-', range.first, range.last)) || range.first < 0 ||
      range.last < range.first || range.last > kMostRuns * 1000 || range.last - range.first >= kMostRuns) {
    throw InputError("found '" + text + "', expected numbers of runs such as 0-9999, at most " +
                     std::to_string(kMostRuns) + " of them");
  }
  return range;
}

Share parseShare(const std::string& text) {
  Share share;
  if (!readPair(text, '/', share.index, share.count) || share.count < 1 || share.count > 1'000'000 ||
      share.index < 0 || share.index >= share.count) {
    throw InputError("found '" + text + "', expected a part and how many there are, such as 0/10 … 9/10");
  }
  return share;
}

SweepFigures runSweep(const Family& family, const std::string& familyText, const SweepSettings& settings,
                      const std::function<void(const SweepProgress&)>& progress,
                      const std::stop_token& stop) {
  checkQuestions(family, settings.asked.questions);
  const Blocks blocks(settings);
  const std::string manifest = manifestOf(familyText, settings);
  SweepFigures figures;
  const SweepOpening opening = openingOf(settings);
  if (opening != SweepOpening::kAnew && SweepFolder::isFinished(settings.folder, manifest)) {
    figures.skipped = blocks.runs();
    return figures;
  }
  const SweepFolder folder(settings.folder, manifest, opening);
  std::vector<std::int64_t> missing;
  SweepProgress now;
  for (std::int64_t block = 0; block < blocks.count(); ++block) {
    if (!blocks.isOurs(block)) {
      continue;
    }
    now.total += blocks.size(block);
    if (blocks.isThere(block)) {
      now.done += blocks.size(block);
    } else {
      missing.push_back(block);
    }
  }
  figures.skipped = now.done;
  const auto begun = std::chrono::steady_clock::now();
  shareWork(
      std::ssize(missing), settings.jobs,
      [&](std::int64_t index) {
        const std::int64_t block = missing[static_cast<std::size_t>(index)];
        writeFile(blocks.file(block), simulateBlock(family, blocks.range(block), settings, stop));
      },
      [&](std::int64_t index) {
        const std::int64_t size = blocks.size(missing[static_cast<std::size_t>(index)]);
        figures.simulated += size;
        now.done += size;
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        now.secondsLeft =
            seconds / static_cast<double>(figures.simulated) * static_cast<double>(now.total - now.done);
        if (progress) {
          progress(now);
        }
      },
      stop);
  for (std::int64_t block = 0; block < blocks.count(); ++block) {
    figures.missing += blocks.isThere(block) ? 0 : blocks.size(block);
  }
  // Of several shares that end at once, none may take the others' files away.
  return figures.missing == 0 && settings.share.count == 1 ? join(family, settings, folder, blocks, figures)
                                                           : figures;
}

}  // namespace careen
