#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "core/system/file.h"
#include "core/system/process.h"
#include "core/system/scratch_folder.h"
#include "study/plot_files.h"
#include "study/plots.h"
#include "study/study.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

// One cell of the files that gnuplot reads. It cannot read a double quote inside a cell; a backslash begins
// an escape there, and control characters would end the cell or the line.
std::string cell(const std::string& text) {
  std::string result = "=";
  for (const char c : text) {
    result += c == '"'                                            ? "”"
              : c == '\\'                                         ? "\\\\"
              : static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? " "
                                                                  : std::string(1, c);
  }
  return result;
}

std::string linesOf(const std::vector<std::string>& texts) {
  std::string lines;
  for (const std::string& text : texts) {
    lines += cell(text) + '\n';
  }
  return lines;
}

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

Plot matrixOf(const StudyResult& study) {
  std::string data;
  const std::vector<std::string> contestants = study.contestants();
  for (std::size_t row = 0; row < study.cases.size(); ++row) {
    for (std::size_t column = 0; column < contestants.size(); ++column) {
      const Attempt* const attempt = usualAttempt(study.cases[row], contestants[column]);
      const bool answered = attempt != nullptr && attempt->failure.empty();
      data += std::to_string(row) + '\t' + std::to_string(column) + '\t' + cell(study.cases[row].name) +
              '\t' + cell(contestants[column]) + '\t' +
              (answered ? brief(correctDigits(attempt->judgement.error), 4) : "-1") + '\t' +
              (answered             ? inShort(attempt->judgement.error)
               : attempt == nullptr ? ""
                                    : "–") +
              '\n';
    }
  }
  return {.script = "matrix.gp", .texts = {"Correct digits at the usual step"}, .data = std::move(data)};
}

/// The least and the largest cost of the answers of a case; an answer of unknown cost is drawn over all.
struct CostRange {
  double least = 0;
  double most = 0;
};

CostRange costsOf(const CaseResult& result) {
  CostRange range;
  for (const Attempt& attempt : result.attempts) {
    if (attempt.failure.empty() && attempt.cost > 0) {
      range.least = range.least > 0 ? std::min(range.least, attempt.cost) : attempt.cost;
      range.most = std::max(range.most, attempt.cost);
    }
  }
  return range.most > 0 ? range : CostRange{.least = 1, .most = 10};
}

Plot workPrecisionOf(const CaseResult& result) {
  Plot plot{.script = "work_precision.gp",
            .texts = {result.title, result.measure == "energy" ? "error: relative change of energy"
                                                               : "error: half diagonals, or radians"},
            .data = {}};
  const CostRange costs = costsOf(result);
  std::size_t number = 0;
  for (const std::string& contestant : answering(result)) {
    plot.texts.push_back(contestant);
    ++number;
    for (const Attempt& attempt : result.attempts) {
      if (attempt.contestant == contestant && attempt.failure.empty()) {
        const std::string error = inFull(attempt.judgement.error);
        for (const double cost : attempt.cost > 0 ? std::vector<double>{attempt.cost}
                                                  : std::vector<double>{costs.least, costs.most}) {
          plot.data += std::to_string(number) + '\t' + brief(cost, 6) + '\t' + error + '\n';
        }
      }
    }
  }
  return plot;
}

Plot energyOf(const CaseResult& result) {
  Plot plot{.script = "energy.gp", .texts = {result.title}, .data = {}};
  std::size_t number = 0;
  for (const std::string& contestant : answering(result)) {
    plot.texts.push_back(contestant);
    ++number;
    const Attempt* const attempt = usualAttempt(result, contestant);
    for (std::size_t k = 0; attempt != nullptr && k < attempt->judgement.energy.size(); ++k) {
      plot.data += std::to_string(number) + '\t' + inFull(result.times.at(k)) + '\t' +
                   inFull(attempt->judgement.energy[k]) + '\n';
    }
  }
  return plot;
}

}  // namespace

// Names of files and folders never reach gnuplot, which obeys some of them: "<command" as data, "|command" as
// output.
std::string drawPlot(const Plot& plot, const fs::path& out) {
  const ScratchFolder scratch;
  for (const char* const script : {"style.gp", plot.script}) {
    writeFile(scratch / script, plotFile(script));
  }
  writeFile(scratch / "texts.txt", linesOf(plot.texts));
  writeFile(scratch / "data.txt", plot.data);
  runProgram({"gnuplot", "-d", plot.script}, scratch.path());  // -d: no settings of the user's
  std::string svg = readFile(scratch / "plot.svg");
  writeFile(out.string() + ".svg", svg);
  writeFile(out.string() + ".png", readFile(scratch / "plot.png"));
  return svg;
}

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
  makeFolder(plots);
  drawPlot(matrixOf(study), plots / kMatrixPlot);
  std::vector<std::string> drawn;
  for (const CaseResult& result : study.cases) {
    std::string all;
    if (!answering(result).empty()) {
      all += drawPlot(workPrecisionOf(result), plots / result.name);
    }
    if (showsEnergy(result)) {
      all += drawPlot(energyOf(result), plots / (result.name + kEnergyPlot));
    }
    drawn.push_back(std::move(all));
  }
  return drawn;
}

}  // namespace careen
