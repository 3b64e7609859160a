#include <algorithm>
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

std::string cellOf(const Attempt* attempt) {
  if (attempt == nullptr) {
    return "<td></td>";
  }
  if (!attempt->failure.empty()) {
    return R"(<td class="none" title=")" + escapedForMarkup(attempt->failure) + "\">–</td>";
  }
  const double digits = correctDigits(attempt->judgement.error);
  return "<td style=\"background:" + colourOf(digits) + (digits < 3 ? ";color:white" : "") + "\">" +
         inShort(attempt->judgement.error) + "</td>";
}

std::string headOf(const std::vector<std::string>& contestants) {
  std::string row = "<tr><th>case</th>";
  for (const std::string& contestant : contestants) {
    row += "<th>" + escapedForMarkup(contestant) + "</th>";
  }
  return row + "</tr>\n";
}

std::string matrix(const StudyResult& study) {
  const std::vector<std::string> contestants = study.contestants();
  std::string table = "<table class=\"matrix\">\n" + headOf(contestants);
  for (const CaseResult& result : study.cases) {
    table += "<tr><th><a href=\"#" + escapedForMarkup(result.name) + "\">" + escapedForMarkup(result.name) +
             "</a></th>";
    for (const std::string& contestant : contestants) {
      table += cellOf(usualAttempt(result, contestant));
    }
    table += "</tr>\n";
  }
  return table + "</table>\n";
}

std::string published(const StudyResult& study) {
  const std::vector<std::string> contestants = study.contestants();
  std::string rows;
  for (const CaseResult& result : study.cases) {
    if (result.published.empty()) {
      continue;
    }
    rows += "<tr><th><a href=\"#" + escapedForMarkup(result.name) + "\">" + escapedForMarkup(result.name) +
            "</a></th><td>" + escapedForMarkup(result.published) + "</td>";
    for (const std::string& contestant : contestants) {
      const std::string verdict = verdictOf(usualAttempt(result, contestant));
      rows += (verdict == "wrong" ? "<td class=\"bad\">" : "<td>") + verdict + "</td>";
    }
    rows += "</tr>\n";
  }
  if (rows.empty()) {
    return "<p>None of them was asked for.</p>\n";
  }
  std::string head = headOf(contestants);
  head.insert(head.find("</th>") + 5, "<th>published by</th>");
  return "<table class=\"matrix\">\n" + head + rows + "</table>\n";
}

std::string promises(const StudyResult& study) {
  std::string table = "<table class=\"matrix\">\n<tr><th>case</th>";
  for (const double factor : kPromisedTolerances) {
    table += "<th>" + (factor == 1 ? "tolerance of the scene" : inShort(factor) + " of it") + "</th>";
  }
  table += "</tr>\n";
  for (const CaseResult& result : study.cases) {
    table += "<tr><th><a href=\"#" + escapedForMarkup(result.name) + "\">" + escapedForMarkup(result.name) +
             "</a></th>";
    for (const double factor : kPromisedTolerances) {
      const std::optional<double> ratio = promiseOf(result, factor);
      table +=
          (ratio && *ratio > 1 ? "<td class=\"bad\">" : "<td>") + (ratio ? inShort(*ratio) : "–") + "</td>";
    }
    table += "</tr>\n";
  }
  return table + "</table>\n";
}

std::string attemptsOf(const CaseResult& result) {
  std::ostringstream table;
  table << "<table><tr><th>contestant</th><th>dt [s]</th><th>tolerance "
           "[m]</th><th>error</th><th>audit</th><th>µs per "
           "simulated "
           "s</th><th>spread</th>"
           "<th>repeats</th><th>Pareto front</th></tr>\n";
  for (const Attempt& attempt : result.attempts) {
    table << "<tr><th>" << escapedForMarkup(attempt.contestant) << "</th><td>"
          << (attempt.dt > 0 ? inShort(attempt.dt) : "") << "</td><td>"
          << (attempt.tolerance > 0 ? inShort(attempt.tolerance) : "") << "</td>";
    if (attempt.failure.empty()) {
      table << "<td>" << inShort(attempt.judgement.error) << "</td><td>" << escapedForMarkup(attempt.audit)
            << "</td><td>" << (attempt.cost > 0 ? inShort(attempt.cost) : "") << "</td><td>"
            << inShort(attempt.spread) << "</td><td>" << attempt.repeats << "</td><td>"
            << (onFront(result, attempt) ? "yes" : "") << "</td></tr>\n";
    } else {
      table << R"(<td colspan="6" class="none">)" << escapedForMarkup(attempt.failure) << "</td></tr>\n";
    }
  }
  table << "</table>\n";
  return table.str();
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
  std::vector<std::pair<std::string, std::string>> known;
  for (const CaseResult& result : study.cases) {
    for (const Attempt& attempt : result.attempts) {
      const std::pair<std::string, std::string> entry(attempt.contestant, attempt.settings);
      if (std::find(known.begin(), known.end(), entry) == known.end()) {
        known.push_back(entry);
      }
    }
  }
  std::string list = "<dl>\n";
  for (const auto& [contestant, settings] : known) {
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
      {"{{matrix}}", matrix(study)},
      {"{{published}}", published(study)},
      {"{{promises}}", promises(study)},
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
