#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "study/case.h"
#include "study/contestant.h"
#include "study/measuring.h"
#include "study/results.h"

namespace careen {

/// One of the cases that come with the program, by its name, or one made of a scene file.
Case caseNamed(const std::string& name, const std::stop_token& stop);

struct StudySettings {
  std::vector<std::string> cases;  ///< names, or paths of scene files
  Effort effort;
  std::string version;           ///< of the program: results of another version are not reused
  std::filesystem::path folder;  ///< folder of finished cases: cases/NAME.json
  bool resume = false;           ///< reuse the finished cases there
};

/// Called after every case; `takenOver`: the case was already finished.
using CaseDone = std::function<void(const CaseResult& result, bool takenOver)>;

/// Runs the cases one by one. Finished cases are kept if it is interrupted. InputError, before the first one
/// runs, if two have the same name or one has that of another plot of the study.
std::vector<CaseResult> runStudy(const StudySettings& settings, const Contestants& contestants,
                                 const CaseDone& done, const std::stop_token& stop);

/// All contestants: careen's methods, then other engines.
Contestants allContestants();

/// A one-line description of this machine: processor, cores, system, compiler.
std::string machineLine();

/// Writes results.csv, energy.csv, matrix.csv, results.json, results.md.
void writeTables(const StudyResult& study, const std::filesystem::path& folder);

/// Plots of a study in plots/: this, one named as each case, and for a case that measures energy one with
/// this suffix.
inline constexpr const char* kMatrixPlot = "matrix";
inline constexpr const char* kEnergyPlot = "-energy";

/// Draws the study as SVG and PNG in plots/ of `folder`: the matrix, every case, energy over time. Returns
/// the SVG of each case, in order. MachineError if gnuplot fails. Names and titles are data: gnuplot runs in
/// a folder of ours, on files whose names are fixed.
std::vector<std::string> drawPlots(const StudyResult& study, const std::filesystem::path& folder);
/// MachineError, with what to install, if gnuplot is missing.
void checkPlotter();
/// Makes the folder of a study's files, or throws MachineError.
void makeFolder(const std::filesystem::path& folder);

/// A self-contained page with all results. `plots` are those of the cases; without them it has none.
std::string resultsPage(const StudyResult& study, const std::vector<std::string>& plots);

}  // namespace careen
