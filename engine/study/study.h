#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "study/contestant.h"
#include "study/measuring.h"
#include "study/results.h"

namespace careen {

struct StudySettings {
  std::vector<std::string> cases;  ///< names, or paths of scene files
  Effort effort;
  std::string version;           ///< of the program: results of another are not taken over
  std::filesystem::path folder;  ///< where a finished case is kept, in cases/NAME.json
  bool resume = false;           ///< take over what is finished there
};

/// Told after every case; `takenOver`: it was finished already.
using CaseDone = std::function<void(const CaseResult& result, bool takenOver)>;

/// Runs the cases one by one. What is finished when it is interrupted stays.
std::vector<CaseResult> runStudy(const StudySettings& settings, const Contestants& contestants,
                                 const CaseDone& done, const std::stop_token& stop);

/// All contestants there are: careen's methods, then other engines.
Contestants allContestants();

/// One line about this machine: processor, cores, system, compiler.
std::string machineLine();

/// results.csv, energy.csv, matrix.csv, results.json, results.md.
void writeTables(const StudyResult& study, const std::filesystem::path& folder);

/// Draws from the tables in `folder`, as SVG and PNG in plots/: the matrix, every case, energy against time.
/// The SVG of each case, in order. MachineError if gnuplot fails.
std::vector<std::string> drawPlots(const StudyResult& study, const std::filesystem::path& folder);
/// MachineError, saying what to install, if plots cannot be drawn here.
void checkPlotter();

/// A page that shows all of it and needs no network. `plots` are those of the cases; none if it is empty.
std::string resultsPage(const StudyResult& study, const std::vector<std::string>& plots);

}  // namespace careen
