#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "compare/page_files.h"
#include "compare/page_pictures.h"
#include "compare/report.h"
#include "compare/report_words.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/table.h"

namespace careen {
namespace {

constexpr const char* kOther = R"(class="other")";

std::string escaped(std::string_view text) { return escapedForMarkup(text); }

void addFact(Table& table, const std::string& name, const std::string& expected, const std::string& actual) {
  const bool same = expected == actual;
  const char* const kind = same ? "" : kOther;
  table.rows.push_back({name, {expected, kind}, {actual, kind}, {same ? "same" : "differs", kind}});
}

Table factsTable(const Comparison& comparison) {
  Table table{.head = {"", "expected", "actual", ""}};
  for (const Fact& fact : comparison.facts) {
    addFact(table, fact.name, fact.expected, fact.actual);
  }
  if (comparison.run) {
    const RunDifference& run = *comparison.run;
    addFact(table, "duration [s]", inFull(run.expectedDuration), inFull(run.actualDuration));
    addFact(table, "impacts", std::to_string(run.expectedImpacts), std::to_string(run.actualImpacts));
    if (run.incomparable.empty()) {
      addFact(table, "kinetic energy at the end [J]", inFull(run.expectedEnergy), inFull(run.actualEnergy));
    }
  }
  return table;
}

TableCell changed(const std::string& expected, const std::string& actual) {
  TableCell cell(actual, expected == actual ? "" : kOther);
  cell.replaced = expected == actual ? "" : expected;
  return cell;
}

Table impactsTable(const RunDifference& run) {
  Table table{.head = {"impact", "bodies", "time [s]", "approach [m/s]", "impulse [N s]", "friction [N s]"}};
  for (const ImpactDifference& pair : run.impactsAround) {
    const bool first = run.firstImpact && pair.index == run.firstImpact->index;
    std::vector<TableCell>& row = table.rows.emplace_back();
    row.emplace_back(std::to_string(pair.index + 1) + (first ? " ← first" : ""),
                     first ? R"(id="first-impact")" : "");
    row.push_back(
        changed(pair.expected ? pair.expectedBodies : "none", pair.actual ? pair.actualBodies : "none"));
    for (double Impact::*const value :
         {&Impact::time, &Impact::approach, &Impact::impulse, &Impact::tangential}) {
      row.push_back(changed(pair.expected ? inFull((*pair.expected).*value) : "–",
                            pair.actual ? inFull((*pair.actual).*value) : "–"));
    }
  }
  return table;
}

std::string growthWords(const RunDifference& run) {
  std::string words;
  if (run.firstTime) {
    words += "The runs diverge at " + brief(*run.firstTime) + " s. ";
  }
  if (run.growthPerImpact) {
    words +=
        "The difference grows " + brief(*run.growthPerImpact) + "-fold from impact to impact, on average. ";
  }
  if (run.horizon) {
    words +=
        "The horizon is at " + brief(*run.horizon) +
        " s: from then on a box is off by more than a hundredth of its half diagonal, or of a radian, and "
        "positions do not tell which run is right. Energies and counts still do.";
  } else if (run.firstTime) {
    words += "The difference stays within a hundredth of a box to the end: there is no horizon.";
  }
  return words;
}

std::string badge(Verdict verdict) {
  return verdict == Verdict::kSame ? "✓ Same" : verdict == Verdict::kWarning ? "! Warning" : "✕ Different";
}

// Escapes what would end a script element.
std::string forScript(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string scripts() {
  std::string all;
  for (const char* name : {"strip.js", "frames.js", "viewer.js", "run.js", "page.js"}) {
    all += pageFile(name);
  }
  return all;
}

// In one pass, so that a name that looks like a part is left as it is.
std::string filled(const std::string& skeleton, const std::map<std::string, std::string>& parts) {
  std::string page;
  std::size_t at = 0;
  for (std::size_t mark = skeleton.find("{{"); mark != std::string::npos; mark = skeleton.find("{{", at)) {
    const std::size_t end = skeleton.find("}}", mark);
    page += skeleton.substr(at, mark - at) + parts.at(skeleton.substr(mark + 2, end - mark - 2));
    at = end + 2;
  }
  return page + skeleton.substr(at);
}

}  // namespace

std::string reportPage(const Comparison& comparison) {
  const Table facts = factsTable(comparison);
  const bool hasImpacts = comparison.run && !comparison.run->impactsAround.empty();
  return filled(pageFile("page.html"),
                {{"style", pageFile("page.css")},
                 {"script", scripts()},
                 {"verdict", nameOf(comparison.verdict)},
                 {"badge", badge(comparison.verdict)},
                 {"headline", escaped(comparison.headline)},
                 {"reason", escaped(reasonOf(comparison))},
                 {"expected", escaped(comparison.expected.string())},
                 {"actual", escaped(comparison.actual.string())},
                 {"tolerance", escaped(comparison.toleranceName)},
                 {"program", escaped(comparison.program)},
                 {"ignored", escaped(joined(comparison.ignored.names()))},
                 {"ignored-hidden", comparison.ignored.empty() ? "hidden" : ""},
                 {"facts", facts.html("facts")},
                 {"facts-hidden", facts.rows.empty() ? "hidden" : ""},
                 {"impacts", hasImpacts ? impactsTable(*comparison.run).html("impacts") : ""},
                 {"impacts-hidden", hasImpacts ? "" : "hidden"},
                 {"growth-words", comparison.run ? growthWords(*comparison.run) : ""},
                 {"equal", isEqual(comparison) ? "true" : "false"},
                 {"report", forScript(reportJson(comparison, -1))},
                 {"pictures", forScript(comparison.run ? "{}" : picturesJson(comparison))}});
}

}  // namespace careen
