#include <algorithm>
#include <sstream>

#include "core/brief.h"
#include "core/csv.h"
#include "study/results.h"
#include "study/verdicts.h"

namespace careen {
namespace {

// A message may contain line ends; many readers of tables take one line for one row.
std::string onOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

// A cell of a table in Markdown.
std::string markdownCell(const std::string& text) {
  std::string result;
  for (const char c : onOneLine(text)) {
    result += c == '|' ? "\\|" : std::string(1, c);
  }
  return result;
}

std::string cell(const Attempt* attempt) {
  if (attempt == nullptr) {
    return "";
  }
  return attempt->failure.empty() ? inShort(attempt->judgement.error) : "–";
}

// One row per case, one column per contestant.
template <class CellOf>
void addTable(std::ostream& text, const StudyResult& study, CellOf cellOf) {
  const std::vector<std::string> contestants = study.contestants();
  text << "| case |";
  for (const std::string& contestant : contestants) {
    text << ' ' << contestant << " |";
  }
  text << "\n|---|";
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    text << "---|";
  }
  text << '\n';
  for (const CaseResult& result : study.cases) {
    text << "| " << markdownCell(result.name) << " |";
    for (const std::string& contestant : contestants) {
      text << ' ' << cellOf(usualAttempt(result, contestant)) << " |";
    }
    text << '\n';
  }
}

std::string finenessOf(const Attempt& attempt) {
  return attempt.dt > 0          ? " (dt " + brief(attempt.dt, 3) + ")"
         : attempt.tolerance > 0 ? " (tolerance " + brief(attempt.tolerance, 3) + ")"
                                 : "";
}

// One row per published scene, one column per contestant.
void addPublished(std::ostream& text, const StudyResult& study) {
  StudyResult published = study;
  std::erase_if(published.cases, [](const CaseResult& result) { return result.published.empty(); });
  if (published.cases.empty()) {
    return;
  }
  text << "\n## Scenes that others published with their answers\n\n"
       << "Right: never further than a tenth of a half diagonal, or of a radian, from the answer, at the\n"
       << "usual time step.\n\n";
  addTable(text, published, [](const Attempt* attempt) { return verdictOf(attempt); });
  text << "\nPublished by:\n\n";
  for (const CaseResult& result : published.cases) {
    text << "- " << onOneLine(result.name) << ": " << onOneLine(result.published) << '\n';
  }
}

void addPromises(std::ostream& text, const StudyResult& study) {
  text
      << "\n## Promises kept by exact\n\n"
      << "Largest distance of a point of a box from its truth, over the tolerance asked for. **Bold**: above "
         "1,\nbroken. The audit holds a pile, a crowd, to a tolerance of its own.\n\n| case |";
  for (const double factor : kPromisedTolerances) {
    text << ' ' << (factor == 1 ? "tolerance of the scene" : brief(factor) + " of it") << " |";
  }
  text << "\n|---|";
  for (std::size_t i = 0; i < kPromisedTolerances.size(); ++i) {
    text << "---|";
  }
  text << '\n';
  for (const CaseResult& result : study.cases) {
    text << "| " << markdownCell(result.name) << " |";
    for (const double factor : kPromisedTolerances) {
      const std::optional<double> ratio = promiseOf(result, factor);
      text << ' '
           << (!ratio       ? std::string("–")
               : *ratio > 1 ? "**" + inShort(*ratio) + "**"
                            : inShort(*ratio))
           << " |";
    }
    text << '\n';
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

std::string resultsCsv(const StudyResult& study) {
  std::ostringstream csv;
  csv << "case,contestant,dt,tolerance,error,cost_us,spread,repeats,front,failure\n";
  for (const CaseResult& result : study.cases) {
    for (const Attempt& attempt : result.attempts) {
      csv << csvCell(onOneLine(result.name)) << ',' << csvCell(onOneLine(attempt.contestant)) << ','
          << (attempt.dt > 0 ? inFull(attempt.dt) : "") << ','
          << (attempt.tolerance > 0 ? inFull(attempt.tolerance) : "") << ',';
      if (attempt.failure.empty()) {
        csv << inFull(attempt.judgement.error) << ',' << (attempt.cost > 0 ? brief(attempt.cost, 6) : "")
            << ',' << brief(attempt.spread, 3) << ',' << attempt.repeats << ',' << onFront(result, attempt)
            << ",\n";
      } else {
        csv << ",,,,0," << csvCell(onOneLine(attempt.failure)) << '\n';
      }
    }
  }
  return csv.str();
}

std::string energyCsv(const StudyResult& study) {
  std::ostringstream csv;
  csv << "case,contestant,time,change\n";
  const std::vector<std::string> contestants = study.contestants();
  for (const CaseResult& result : study.cases) {
    for (const std::string& contestant : contestants) {
      const Attempt* const attempt = usualAttempt(result, contestant);
      for (std::size_t k = 0; attempt != nullptr && k < attempt->judgement.energy.size(); ++k) {
        csv << csvCell(onOneLine(result.name)) << ',' << csvCell(onOneLine(contestant)) << ','
            << inFull(result.times[k]) << ',' << inFull(attempt->judgement.energy[k]) << '\n';
      }
    }
  }
  return csv.str();
}

std::string matrixCsv(const StudyResult& study) {
  std::ostringstream csv;
  csv << "row,column,case,contestant,digits,error\n";
  const std::vector<std::string> contestants = study.contestants();
  for (std::size_t row = 0; row < study.cases.size(); ++row) {
    for (std::size_t column = 0; column < contestants.size(); ++column) {
      const Attempt* const attempt = usualAttempt(study.cases[row], contestants[column]);
      const bool answered = attempt != nullptr && attempt->failure.empty();
      csv << row << ',' << column << ',' << csvCell(onOneLine(study.cases[row].name)) << ','
          << csvCell(onOneLine(contestants[column])) << ','
          << (answered ? brief(correctDigits(attempt->judgement.error), 4) : "-1") << ',' << cell(attempt)
          << '\n';
    }
  }
  return csv.str();
}

std::string resultsMarkdown(const StudyResult& study) {
  std::ostringstream text;
  text << "# Speed against error\n\n"
       << "Made by `" << study.command << "` on " << study.machine << ".\n\n"
       << "## Errors at the usual time step\n\n"
       << "Largest distance from the truth in half diagonals, or angle in radians; for a pile\n"
       << "the deepest penetration in half diagonals; for energy, its largest relative change. "
       << "– means that there is no answer; results.csv has the reason.\n\n";
  addTable(text, study, [](const Attempt* attempt) { return cell(attempt); });
  text << "\n## Costs\n\nµs of one core per simulated second, at the usual time step.\n\n";
  addTable(text, study, [](const Attempt* attempt) {
    return attempt != nullptr && attempt->failure.empty() && attempt->cost > 0 ? brief(attempt->cost, 3)
                                                                               : std::string("–");
  });
  addPublished(text, study);
  addPromises(text, study);
  addFindings(text, study);
  return text.str();
}

}  // namespace careen
