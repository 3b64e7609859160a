#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "sweep/family.h"
#include "sweep/outcome_rows.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Runs from `first` to `last`, both included.
struct RunRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};
/// "0-9999", or "17". InputError otherwise, and beyond kMostRuns runs.
RunRange parseRuns(const std::string& text);
inline constexpr std::int64_t kMostRuns = 10'000'000;

/// Part `index` of `count` equal ones: a task of a job array.
struct Share {
  int index = 0;
  int count = 1;
};
/// "2/10": the third of ten. InputError otherwise.
Share parseShare(const std::string& text);

struct SweepSettings {
  std::filesystem::path folder;
  RunRange runs;
  Share share;
  int jobs = 1;           ///< processes, each with a block of runs at a time
  bool resume = false;    ///< keep the blocks that are there
  bool keepRuns = false;  ///< each run's trajectory, in runs/
  AuditDepth audit = AuditDepth::kUsual;
  OutcomesAsked asked;
  /// Writes other files of a run, such as its film, into `folder`: runs/0000017, which appears whole or not
  /// at all, before the run's row. It may change the run. None: there is no such folder.
  std::function<void(Trajectory& run, const std::filesystem::path& folder, const std::stop_token& stop)>
      writeRun;
  /// What that depends on, as names and values for sweep.json, which must be the same to resume.
  std::vector<std::pair<std::string, std::string>> written;
  std::string program;  ///< name and version
};

struct SweepProgress {
  std::int64_t done = 0;  ///< runs, those of before included
  std::int64_t total = 0;
  double secondsLeft = 0;  ///< [s] at the rate so far
};

struct SweepFigures {
  std::int64_t simulated = 0;  ///< runs, in this call
  std::int64_t skipped = 0;    ///< runs that were there
  std::int64_t missing = 0;    ///< of other shares
  std::int64_t rows = 0;       ///< of the table; 0 without one
  std::int64_t broken = 0;     ///< rows of the table whose run breaks a promise of its method
};

/// Simulates the runs of a family and writes one table of them, table.csv and table.npz (outcome_rows.h).
/// While it works, blocks of kRunsOfBlock runs, of one with writeRun, are files in `rows`, each whole or not
/// there; shares write theirs into the same folder, or into others whose files are copied together. Then the
/// same without a share, resumed, simulates what is missing, makes the table of all blocks and removes them.
/// The table's bytes depend on the family and the runs alone. sweep.json says what the folder is of;
/// InputError if it is of something else, or if another process works there, unless both are shares.
/// InputError too if a question is none about run 0. Throws the errors of runs, whose names they begin with;
/// what is done stays.
///
/// Runs are simulated in forked processes, so writeRun may fork others that open GL, if this process has not.
SweepFigures runSweep(const Family& family, const std::string& familyText, const SweepSettings& settings,
                      const std::function<void(const SweepProgress&)>& progress = {},
                      const std::stop_token& stop = {});

inline constexpr std::int64_t kRunsOfBlock = 50;

}  // namespace careen
