#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/characters.h"
#include "study/plot_files.h"
#include "study/study.h"
#include "study/verdicts.h"

namespace careen {
namespace {

std::string published(const StudyResult& study) {
  const StudyResult published = publishedOf(study);
  if (published.cases.empty()) {
    return "<p>None of them was asked for.</p>\n";
  }
  Table table = verdictTable(published);
  table.head.insert(table.head.begin() + 1, "published by");
  for (std::size_t i = 0; i < published.cases.size(); ++i) {
    table.rows[i].insert(table.rows[i].begin() + 1, published.cases[i].published);
  }
  return table.html("matrix");
}

std::string attemptsOf(const CaseResult& result) {
  Table table{.head = {"contestant", "dt [s]", "tolerance [m]", "error", "joints open [m]", "audit",
                       "µs per simulated s", "spread", "repeats", "Pareto front"}};
  for (const Attempt& attempt : result.attempts) {
    std::vector<TableCell>& row = table.rows.emplace_back();
    row = {attempt.contestant, attempt.dt > 0 ? inShort(attempt.dt) : "",
           attempt.tolerance > 0 ? inShort(attempt.tolerance) : ""};
    if (attempt.failure.empty()) {
      row.insert(row.end(),
                 {inShort(attempt.judgement.error),
                  attempt.judgement.jointGap ? inShort(*attempt.judgement.jointGap) : "", attempt.audit,
                  attempt.cost > 0 ? inShort(attempt.cost) : "", inShort(attempt.spread),
                  std::to_string(attempt.repeats), onFront(result, attempt) ? "yes" : ""});
    } else {
      row.emplace_back(attempt.failure, R"(colspan="7" class="none")");
    }
  }
  return table.html();
}

// The part of an SVG file that can be embedded in a page.
std::string withoutProlog(const std::string& svg) {
  std::string result;
  for (std::size_t at = svg.find("<svg"); at != std::string::npos; at = svg.find("<svg", at)) {
    const std::size_t end = svg.find("</svg>", at);
    result += svg.substr(at, end + 6 - at) + "\n";
    at = end;
  }
  return result;
}

std::string sections(const StudyResult& study, const std::vector<std::string>& plots) {
  std::string all;
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const CaseResult& result = study.cases[i];
    all += "<section id=\"" + escapedForMarkup(result.name) + "\">\n<h2>" + escapedForMarkup(result.title) +
           "</h2>\n<p>" + escapedForMarkup(result.whyHard) +
           "</p>\n<p class=\"source\">Truth: " + escapedForMarkup(result.source) + ".</p>\n" +
           (i < plots.size() ? withoutProlog(plots[i]) : "") + "<details><summary>All attempts</summary>\n" +
           attemptsOf(result) + "</details>\n</section>\n";
  }
  return all;
}

std::string settingsOf(const StudyResult& study) {
  std::string list = "<dl>\n";
  for (const auto& [contestant, settings] : study.settings()) {
    list += "<dt>" + escapedForMarkup(contestant) + "</dt><dd>" + escapedForMarkup(settings) + "</dd>\n";
  }
  return list + "</dl>\n";
}

std::string verdict(const StudyResult& study) {
  int front = 0;
  int answered = 0;
  double worst = 0;
  std::string worstCase;
  std::string dominated;
  for (const CaseResult& result : study.cases) {
    const Attempt* const exact = usualAttempt(result, "exact");
    if (exact == nullptr || !exact->failure.empty()) {
      continue;
    }
    ++answered;
    if (exact->judgement.error >= worst) {
      worst = exact->judgement.error;
      worstCase = result.name;
    }
    if (exact->failure.empty() && betterThan(result, *exact).empty()) {
      ++front;
    } else {
      dominated += (dominated.empty() ? "" : ", ") + result.name;
    }
  }
  std::ostringstream text;
  text << "<b>exact</b> answers " << answered << " of " << study.cases.size()
       << " cases; its largest error is " << inShort(worst) << " (" << escapedForMarkup(worstCase) << "). In "
       << front << " of them no other contestant is both cheaper and more accurate"
       << (dominated.empty() ? "." : "; exceptions: " + escapedForMarkup(dominated) + ".");
  return text.str();
}

}  // namespace

std::string resultsPage(const StudyResult& study, const std::vector<std::string>& plots) {
  std::string page = plotFile("page.html");
  const std::vector<std::pair<std::string, std::string>> parts = {
      {"{{verdict}}", verdict(study)},
      {"{{machine}}", escapedForMarkup(study.machine)},
      {"{{command}}", escapedForMarkup(study.command)},
      {"{{matrix}}", errorTable(study).html("matrix")},
      {"{{published}}", published(study)},
      {"{{promises}}", promiseTable(study).html("matrix")},
      {"{{settings}}", settingsOf(study)},
      {"{{cases}}", sections(study, plots)}};
  for (const auto& [mark, text] : parts) {
    const std::size_t at = page.find(mark);
    if (at != std::string::npos) {
      page.replace(at, mark.size(), text);
    }
  }
  return page;
}

}  // namespace careen
