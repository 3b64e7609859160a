#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/table.h"
#include "study/measuring.h"

namespace careen {

/// The results of a study for one case.
struct CaseResult {
  std::string name;
  std::string title;
  std::string whyHard;
  std::string source;
  std::string measure;         ///< "poses", "energy", "reversal", "scaled"
  std::string published = {};  ///< as Case::published
  std::string stamp;           ///< hash of everything that the result depends on
  double usualStep = 0;        ///< [s]
  double usualTolerance = 0;   ///< [m]
  std::vector<double> times;
  std::vector<Attempt> attempts;
};
CaseResult resultOf(const Case& study, std::vector<Attempt> attempts, std::string stamp);

/// The file of one case; doubles are exact.
std::string encodeResult(const CaseResult& result);
/// std::nullopt if the text is not such a file.
std::optional<CaseResult> decodeResult(const std::string& text);

/// The results of a whole study.
struct StudyResult {
  std::string machine;  ///< the machine of the timings, one line
  std::string command;  ///< the command that made it
  std::vector<CaseResult> cases;

  /// In order of first appearance.
  std::vector<std::string> contestants() const;
  /// What was set, by contestant: version and settings of an engine.
  std::vector<std::pair<std::string, std::string>> settings() const;
};

/// The contestant's answer at the case's usual time step or, without a fixed time step, tolerance. Null if it
/// was never tried.
const Attempt* usualAttempt(const CaseResult& result, const std::string& contestant);
/// Whether no other answer is both cheaper and more accurate. False without an answer or its cost.
bool onFront(const CaseResult& result, const Attempt& attempt);
/// Answers of other contestants that are both cheaper and more accurate than this one.
std::vector<const Attempt*> betterThan(const CaseResult& result, const Attempt& attempt);
/// −log₁₀ of an error, from 0 (no correct digit) to 16 (all digits of a double).
double correctDigits(double error);

/// The study without the cases that nobody published.
StudyResult publishedOf(StudyResult study);
/// One row per case, with one column per contestant: errors and verdicts at the usual time step; or with one
/// per tolerance: promises.
Table errorTable(const StudyResult& study);
Table verdictTable(const StudyResult& study);
Table promiseTable(const StudyResult& study);

/// All attempts: case,contestant,dt,tolerance,error,cost_us,spread,repeats,front,failure. cost_us is µs of
/// one core per simulated second.
std::string resultsCsv(const StudyResult& study);
/// Energy over time at the usual time step: case,contestant,time,change.
std::string energyCsv(const StudyResult& study);
/// The matrix of cases and contestants: row,column,case,contestant,digits,error.
std::string matrixCsv(const StudyResult& study);
std::string resultsJson(const StudyResult& study);
std::string resultsMarkdown(const StudyResult& study);

/// "1.3e-15"; "0" for no error.
std::string inShort(double value);

}  // namespace careen
