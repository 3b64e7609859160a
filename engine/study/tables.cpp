#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/brief.h"
#include "core/characters.h"
#include "study/results.h"
#include "study/verdicts.h"

namespace careen {
namespace {

// From red (no correct digit) over white to blue (all correct), as in the plot of the matrix.
std::string colourOf(double digits) {
  using Rgb = std::array<double, 3>;
  constexpr Rgb kNone = {178, 24, 43};
  constexpr Rgb kHalf = {247, 247, 247};
  constexpr Rgb kAll = {67, 147, 195};
  const double at = std::clamp(digits / 16, 0.0, 1.0);
  const Rgb& from = at < 0.5 ? kNone : kHalf;
  const Rgb& to = at < 0.5 ? kHalf : kAll;
  const double part = at < 0.5 ? 2 * at : 2 * at - 1;
  std::ostringstream colour;
  colour << "rgb(";
  for (std::size_t i = 0; i < 3; ++i) {
    colour << (i == 0 ? "" : ",") << std::lround(from.at(i) + part * (to.at(i) - from.at(i)));
  }
  return colour.str() + ")";
}

TableCell caseCell(const CaseResult& result) {
  TableCell cell(result.name);
  cell.section = result.name;
  return cell;
}

// One row per case, one column per contestant.
template <class CellOf>
Table tableOf(const StudyResult& study, CellOf cellOf) {
  Table table{.head = study.contestants()};
  for (const CaseResult& result : study.cases) {
    std::vector<TableCell>& row = table.rows.emplace_back();
    row.push_back(caseCell(result));
    for (const std::string& contestant : table.head) {
      row.push_back(cellOf(usualAttempt(result, contestant)));
    }
  }
  table.head.insert(table.head.begin(), "case");
  return table;
}

std::string finenessOf(const Attempt& attempt) {
  return attempt.dt > 0          ? " (dt " + brief(attempt.dt, 3) + ")"
         : attempt.tolerance > 0 ? " (tolerance " + brief(attempt.tolerance, 3) + ")"
                                 : "";
}

// One row per case with joints.
void addJoints(std::ostream& text, StudyResult study) {
  std::erase_if(study.cases, [](const CaseResult& result) {
    return std::none_of(result.attempts.begin(), result.attempts.end(),
                        [](const Attempt& attempt) { return attempt.judgement.jointGap.has_value(); });
  });
  if (!study.cases.empty()) {
    text << "\n## Joints\n\nHow far any of them is open at the times of the case [m], at the usual time "
            "step.\n\n"
         << tableOf(study, [](const Attempt* attempt) -> TableCell {
              return attempt != nullptr && attempt->judgement.jointGap ? inShort(*attempt->judgement.jointGap)
                                                                       : "–";
            }).markdown();
  }
}

// One row per published scene.
void addPublished(std::ostream& text, const StudyResult& study) {
  const StudyResult published = publishedOf(study);
  if (published.cases.empty()) {
    return;
  }
  text << "\n## Scenes that others published with their answers\n\n"
       << "Right: never further than a tenth of a half diagonal, or of a radian, from the answer, at the\n"
       << "usual time step.\n\n"
       << verdictTable(published).markdown() << "\nPublished by:\n\n";
  for (const CaseResult& result : published.cases) {
    text << "- " << onOneLine(result.name) << ": " << onOneLine(result.published) << '\n';
  }
}

void addFindings(std::ostream& text, const StudyResult& study) {
  text << "\n## Cases where another answer is both cheaper and more accurate than that of exact\n\n";
  bool any = false;
  for (const CaseResult& result : study.cases) {
    const Attempt* const exact = usualAttempt(result, "exact");
    if (exact == nullptr) {
      continue;
    }
    const std::vector<const Attempt*> better = betterThan(result, *exact);
    if (exact->failure.empty() && better.empty()) {
      continue;
    }
    any = true;
    text << "- " << onOneLine(result.name) << ": ";
    if (!exact->failure.empty()) {
      text << exact->failure << '\n';
      continue;
    }
    text << "exact has error " << inShort(exact->judgement.error) << " at " << brief(exact->cost, 3)
         << " µs/s;";
    for (const Attempt* other : better) {
      text << ' ' << other->contestant << finenessOf(*other) << ' ' << inShort(other->judgement.error)
           << " at " << brief(other->cost, 3) << " µs/s;";
    }
    text << '\n';
  }
  if (!any) {
    text << "None.\n";
  }
}

}  // namespace

std::string inShort(double value) { return brief(value, 2); }

StudyResult publishedOf(StudyResult study) {
  std::erase_if(study.cases, [](const CaseResult& result) { return result.published.empty(); });
  return study;
}

Table errorTable(const StudyResult& study) {
  return tableOf(study, [](const Attempt* attempt) -> TableCell {
    if (attempt == nullptr) {
      return "";
    }
    if (!attempt->failure.empty()) {
      return {"–", R"(class="none" title=")" + escapedForMarkup(attempt->failure) + '"'};
    }
    const double digits = correctDigits(attempt->judgement.error);
    return {inShort(attempt->judgement.error),
            "style=\"background:" + colourOf(digits) + (digits < 3 ? ";color:white\"" : "\"")};
  });
}

Table verdictTable(const StudyResult& study) {
  return tableOf(study, [](const Attempt* attempt) -> TableCell {
    const std::string verdict = verdictOf(attempt);
    return {verdict, verdict == "wrong" ? R"(class="bad")" : ""};
  });
}

Table promiseTable(const StudyResult& study) {
  Table table{.head = {"case"}};
  for (const double factor : kPromisedTolerances) {
    table.head.push_back(factor == 1 ? "tolerance of the scene" : brief(factor) + " of it");
  }
  for (const CaseResult& result : study.cases) {
    std::vector<TableCell>& row = table.rows.emplace_back();
    row.push_back(caseCell(result));
    for (const double factor : kPromisedTolerances) {
      const std::optional<double> ratio = promiseOf(result, factor);
      const bool isBroken = ratio && *ratio > 1;
      TableCell& cell = row.emplace_back(ratio ? inShort(*ratio) : "–", isBroken ? R"(class="bad")" : "");
      cell.isStrong = isBroken;
    }
  }
  return table;
}

std::string resultsCsv(const StudyResult& study) {
  Table table{.head = {"case", "contestant", "dt", "tolerance", "error", "cost_us", "spread", "repeats",
                       "front", "failure", "joint_gap"}};
  for (const CaseResult& result : study.cases) {
    for (const Attempt& attempt : result.attempts) {
      std::vector<TableCell>& row = table.rows.emplace_back();
      row = {result.name, attempt.contestant, attempt.dt > 0 ? inFull(attempt.dt) : "",
             attempt.tolerance > 0 ? inFull(attempt.tolerance) : ""};
      if (attempt.failure.empty()) {
        row.insert(row.end(), {inFull(attempt.judgement.error),
                               attempt.cost > 0 ? brief(attempt.cost, 6) : "", brief(attempt.spread, 3),
                               std::to_string(attempt.repeats), onFront(result, attempt) ? "1" : "0", "",
                               attempt.judgement.jointGap ? inFull(*attempt.judgement.jointGap) : ""});
      } else {
        row.insert(row.end(), {"", "", "", "", "0", attempt.failure, ""});
      }
    }
  }
  return table.csv();
}

std::string energyCsv(const StudyResult& study) {
  Table table{.head = {"case", "contestant", "time", "change"}};
  for (const CaseResult& result : study.cases) {
    for (const std::string& contestant : study.contestants()) {
      const Attempt* const attempt = usualAttempt(result, contestant);
      for (std::size_t k = 0; attempt != nullptr && k < attempt->judgement.energy.size(); ++k) {
        table.rows.push_back(
            {result.name, contestant, inFull(result.times[k]), inFull(attempt->judgement.energy[k])});
      }
    }
  }
  return table.csv();
}

std::string matrixCsv(const StudyResult& study) {
  Table table{.head = {"row", "column", "case", "contestant", "digits", "error"}};
  const std::vector<std::string> contestants = study.contestants();
  const Table errors = errorTable(study);
  for (std::size_t row = 0; row < study.cases.size(); ++row) {
    for (std::size_t column = 0; column < contestants.size(); ++column) {
      const Attempt* const attempt = usualAttempt(study.cases[row], contestants[column]);
      const bool answered = attempt != nullptr && attempt->failure.empty();
      table.rows.push_back({std::to_string(row), std::to_string(column), study.cases[row].name,
                            contestants[column],
                            answered ? brief(correctDigits(attempt->judgement.error), 4) : "-1",
                            errors.rows[row][column + 1].text});
    }
  }
  return table.csv();
}

std::string resultsMarkdown(const StudyResult& study) {
  std::ostringstream text;
  text << "# Speed against error\n\n"
       << "Made by `" << study.command << "` on " << study.machine << ".\n\n"
       << "## Errors at the usual time step\n\n"
       << "Largest distance from the truth in half diagonals, or angle in radians; for a pile\n"
       << "the deepest penetration in half diagonals; for energy, its largest relative change. "
       << "– means that there is no answer; results.csv has the reason.\n\n";
  text << errorTable(study).markdown()
       << "\n## Costs\n\nµs of one core per simulated second, at the usual time step.\n\n";
  const Table costs = tableOf(study, [](const Attempt* attempt) -> TableCell {
    return attempt != nullptr && attempt->failure.empty() && attempt->cost > 0 ? brief(attempt->cost, 3)
                                                                               : "–";
  });
  text << costs.markdown();
  addJoints(text, study);
  addPublished(text, study);
  text
      << "\n## Promises kept by exact\n\n"
      << "Largest distance of a point of a box from its truth, over the tolerance asked for. **Bold**: above "
         "1,\nbroken. The audit holds a pile, a crowd, to a tolerance of its own.\n\n"
      << promiseTable(study).markdown();
  addFindings(text, study);
  Table contestants{.head = {"contestant", "what it is, and what is set"}};
  for (const auto& [contestant, settings] : study.settings()) {
    contestants.rows.push_back({contestant, settings});
  }
  text << "\n## Contestants\n\n" << contestants.markdown();
  return text.str();
}

}  // namespace careen
