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

namespace careen {
namespace {

std::string escaped(std::string_view text) { return escapedForMarkup(text); }

std::string row(const std::string& name, const std::string& expected, const std::string& actual) {
  const bool same = expected == actual;
  return std::string("<tr") + (same ? "" : " class=\"other\"") + "><th scope=\"row\">" + escaped(name) +
         "</th><td>" + escaped(expected) + "</td><td>" + escaped(actual) + "</td><td>" +
         (same ? "same" : "differs") + "</td></tr>\n";
}

std::string factsTable(const Comparison& comparison) {
  std::string rows;
  for (const Fact& fact : comparison.facts) {
    rows += row(fact.name, fact.expected, fact.actual);
  }
  if (comparison.run) {
    const RunDifference& run = *comparison.run;
    rows += row("duration [s]", inFull(run.expectedDuration), inFull(run.actualDuration));
    rows += row("impacts", std::to_string(run.expectedImpacts), std::to_string(run.actualImpacts));
    if (run.incomparable.empty()) {
      rows += row("kinetic energy at the end [J]", inFull(run.expectedEnergy), inFull(run.actualEnergy));
    }
  }
  return rows;
}

std::string impactCell(const ImpactDifference& pair, std::string (*value)(const Impact&)) {
  const std::string expected = pair.expected ? value(*pair.expected) : "–";
  const std::string actual = pair.actual ? value(*pair.actual) : "–";
  if (expected == actual) {
    return "<td>" + expected + "</td>";
  }
  return "<td class=\"other\"><del>" + expected + "</del> <ins>" + actual + "</ins></td>";
}

std::string impactBodies(const ImpactDifference& pair) {
  if (pair.expectedBodies == pair.actualBodies) {
    return "<td>" + escaped(pair.expectedBodies) + "</td>";
  }
  return "<td class=\"other\"><del>" + escaped(pair.expected ? pair.expectedBodies : "none") +
         "</del> <ins>" + escaped(pair.actual ? pair.actualBodies : "none") + "</ins></td>";
}

std::string impactsTable(const RunDifference& run) {
  std::string rows;
  for (const ImpactDifference& pair : run.impactsAround) {
    const bool first = run.firstImpact && pair.index == run.firstImpact->index;
    rows += std::string("<tr") + (first ? R"( class="first" id="first-impact")" : "") +
            "><th scope=\"row\">" + std::to_string(pair.index + 1) + (first ? " ← first" : "") + "</th>" +
            impactBodies(pair) + impactCell(pair, [](const Impact& impact) { return inFull(impact.time); }) +
            impactCell(pair, [](const Impact& impact) { return inFull(impact.approach); }) +
            impactCell(pair, [](const Impact& impact) { return inFull(impact.impulse); }) +
            impactCell(pair, [](const Impact& impact) { return inFull(impact.tangential); }) + "</tr>\n";
  }
  return rows;
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

// Replaces in one pass, so that a placeholder within a name is not replaced.
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
  const std::string facts = factsTable(comparison);
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
                 {"facts", facts},
                 {"facts-hidden", facts.empty() ? "hidden" : ""},
                 {"impacts", hasImpacts ? impactsTable(*comparison.run) : ""},
                 {"impacts-hidden", hasImpacts ? "" : "hidden"},
                 {"growth-words", comparison.run ? growthWords(*comparison.run) : ""},
                 {"equal", isEqual(comparison) ? "true" : "false"},
                 {"report", forScript(reportJson(comparison, -1))},
                 {"pictures", forScript(comparison.run ? "{}" : picturesJson(comparison))}});
}

}  // namespace careen
