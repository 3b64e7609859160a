#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "core/system/process.h"
#include "core/system/resource.h"
#include "study/study.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) {
    all += (all.empty() ? "" : " ") + word;
  }
  return all;
}

std::string script(const std::string& name) { return findResource("assets/plots/" + name).string(); }

// Contestants with at least one answer to draw.
std::vector<std::string> answering(const CaseResult& result) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const Attempt& attempt : result.attempts) {
    if (attempt.failure.empty() && known.insert(attempt.contestant).second) {
      names.push_back(attempt.contestant);
    }
  }
  return names;
}

bool showsEnergy(const CaseResult& result) {
  return result.measure == "energy" && !answering(result).empty();
}

}  // namespace

void checkPlotter() {
  try {
    runProgram({"gnuplot", "--version"});
  } catch (const MachineError& error) {
    throw MachineError(std::string(error.what()) +
                       "; the plots need gnuplot: install gnuplot-nox, or give --no-plots");
  }
}

void writeTables(const StudyResult& study, const fs::path& folder) {
  writeFile(folder / "results.csv", resultsCsv(study));
  writeFile(folder / "energy.csv", energyCsv(study));
  writeFile(folder / "matrix.csv", matrixCsv(study));
  writeFile(folder / "results.json", resultsJson(study));
  writeFile(folder / "results.md", resultsMarkdown(study));
}

std::vector<std::string> drawPlots(const StudyResult& study, const fs::path& folder) {
  const fs::path plots = folder / "plots";
  fs::create_directories(plots);
  runProgram({"gnuplot", "-c", script("matrix.gp"), (folder / "matrix.csv").string(),
              std::to_string(study.cases.size()), std::to_string(study.contestants().size()),
              (plots / "matrix").string()});
  std::vector<std::string> drawn;
  for (const CaseResult& result : study.cases) {
    std::string all;
    const std::vector<std::string> contestants = answering(result);
    if (!contestants.empty()) {
      const fs::path out = plots / result.name;
      runProgram({"gnuplot", "-c", script("work_precision.gp"), (folder / "results.csv").string(),
                  result.name, result.title, joined(contestants), out.string(),
                  result.measure == "energy" ? "error: relative change of energy"
                                             : "error: half diagonals, or radians"});
      all += readFile(out.string() + ".svg");
    }
    if (showsEnergy(result)) {
      const fs::path out = plots / (result.name + "-energy");
      runProgram({"gnuplot", "-c", script("energy.gp"), (folder / "energy.csv").string(), result.name,
                  result.title, joined(contestants), out.string()});
      all += readFile(out.string() + ".svg");
    }
    drawn.push_back(std::move(all));
  }
  return drawn;
}

}  // namespace careen
