#include "study/study.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "parsed.h"
#include "run_options.h"
#include "study/case.h"
#include "study/given_contestant.h"
#include "study/node_peers.h"
#include "study/verdicts.h"

namespace careen {
namespace {

struct StudyOptions {
  std::vector<std::string> cases;
  std::vector<std::string> methods;
  std::vector<std::string> runs;     // tables of poses
  std::vector<std::string> labels;   // of them
  std::vector<std::string> seconds;  // that they took
  std::filesystem::path out = "study";
  bool quick = false;
  bool resume = false;
  bool noPlots = false;
  bool list = false;
};

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) {
    all += (all.empty() ? "" : ", ") + name;
  }
  return all;
}

void checkCases(const std::vector<std::string>& chosen, const std::vector<std::string>& known) {
  for (const std::string& name : chosen) {
    if (std::filesystem::path(name).extension() != ".json" &&
        std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("found the unknown case '" + name +
                       "', expected a scene file, .json, or one of: " + joined(known));
    }
  }
}

// The named contestants, in the order of the full list.
Contestants chosenContestants(const std::vector<std::string>& names) {
  Contestants all = allContestants();
  const std::string leftOut = nodePeers().leftOut;
  if (names.empty()) {
    if (!leftOut.empty()) {
      std::cerr << leftOut << '\n';
    }
    return all;
  }
  std::vector<std::string> known;
  Contestants chosen;
  for (auto& contestant : all) {
    known.push_back(contestant->name());
    if (std::find(names.begin(), names.end(), contestant->name()) != names.end()) {
      chosen.push_back(std::move(contestant));
    }
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("--methods: found '" + name + "', expected some of: " + joined(known) +
                       (leftOut.empty() ? "" : "; " + leftOut));
    }
  }
  return chosen;
}

// Other people's answers to the one case that is studied.
void addGiven(const StudyOptions& options, const std::stop_token& stop, Contestants& contestants) {
  const auto expectAsMany = [&](const char* option, const std::vector<std::string>& texts, bool isNeeded) {
    if (texts.size() != options.runs.size() && (isNeeded || !texts.empty())) {
      throw InputError(std::string(option) + ": found " + std::to_string(texts.size()) + " for " +
                       std::to_string(options.runs.size()) + " of --run, expected one for each");
    }
  };
  expectAsMany("--label", options.labels, true);
  expectAsMany("--seconds", options.seconds, false);
  if (options.runs.empty()) {
    return;
  }
  if (options.cases.size() != 1) {
    throw InputError("--run: found " + std::to_string(options.cases.size()) +
                     " cases, expected the one that it is a run of");
  }
  const Case study = caseNamed(options.cases.front(), stop);
  for (std::size_t i = 0; i < options.runs.size(); ++i) {
    const std::string& label = options.labels[i];
    const bool isTaken = std::any_of(contestants.begin(), contestants.end(),
                                     [&](const auto& other) { return other->name() == label; });
    if (label.empty() || isTaken) {
      throw InputError("--label: found '" + label + "', expected a name that no other has");
    }
    GivenAnswer answer{.label = label, .file = options.runs[i], .seconds = {}};
    if (!options.seconds.empty()) {
      answer.seconds = numberIn("--seconds", options.seconds[i], "a positive number of seconds", kAboveZero);
    }
    contestants.push_back(givenContestant(answer, study));
  }
}

std::string commandOf(const StudyOptions& options) {
  std::string command = "careen study";
  for (const std::string& name : options.cases) {
    command += " " + name;
  }
  for (std::size_t i = 0; i < options.methods.size(); ++i) {
    command += (i == 0 ? " --methods " : ",") + options.methods[i];
  }
  for (std::size_t i = 0; i < options.runs.size(); ++i) {
    command += " --run " + options.runs[i] + " --label '" + options.labels[i] + "'";
  }
  return command + (options.quick ? " --quick" : "");
}

void printCase(const CaseResult& result, bool takenOver) {
  const Attempt* const exact = usualAttempt(result, "exact");
  std::cout << std::left << std::setw(24) << printableName(result.name);
  if (exact != nullptr && exact->failure.empty()) {
    std::cout << (result.published.empty() ? "" : verdictOf(exact) + "; ") << "exact: error " << std::setw(8)
              << inShort(exact->judgement.error) << inShort(exact->cost) << " us/s"
              << (betterThan(result, *exact).empty() ? "" : ", not the best")
              << "; audit: " << (exact->audit.empty() ? "none" : exact->audit);
  } else if (exact != nullptr) {
    std::cout << "exact: " << exact->failure;
  }
  std::cout << (takenOver ? " (taken over)" : "") << '\n';
  for (const Attempt& attempt : result.attempts) {
    if (attempt.settings.starts_with("a table of poses")) {
      std::cout << "    " << printableName(attempt.contestant) << ": "
                << (attempt.failure.empty() ? "error " + inShort(attempt.judgement.error) : attempt.failure)
                << "; audit: " << attempt.audit << '\n';
      continue;
    }
    if (attempt.audit.starts_with("BROKEN") && &attempt != exact) {
      std::cout << "    " << attempt.contestant << (attempt.dt > 0 ? " dt " : " tolerance ")
                << inShort(attempt.dt > 0 ? attempt.dt : attempt.tolerance) << ": error "
                << inShort(attempt.judgement.error) << "; audit: " << attempt.audit << '\n';
    }
  }
  std::cout << std::flush;  // progress
}

ExitCode studyCommand(const StudyOptions& options, const std::stop_token& stop) {
  const std::vector<std::string> known = caseNames();
  if (options.list) {
    for (const std::string& name : known) {
      std::cout << std::left << std::setw(24) << name << readCase(name).title << '\n';
    }
    return ExitCode::kDone;
  }
  checkCases(options.cases, known);
  Contestants contestants = chosenContestants(options.methods);
  addGiven(options, stop, contestants);
  if (!options.noPlots) {
    checkPlotter();
  }
  const StudySettings settings{.cases = options.cases.empty() ? known : options.cases,
                               .effort = options.quick ? quickEffort() : fullEffort(),
                               .version = CAREEN_VERSION,
                               .folder = options.out,
                               .resume = options.resume};
  const Stopwatch stopwatch;
  StudyResult study{
      .machine = machineLine() + ", careen " CAREEN_VERSION, .command = commandOf(options), .cases = {}};
  std::size_t number = 0;
  study.cases = runStudy(
      settings, contestants,
      [&](const CaseResult& result, bool takenOver) {
        std::cout << '[' << ++number << '/' << settings.cases.size() << "] ";
        printCase(result, takenOver);
      },
      stop);
  writeTables(study, options.out);
  const std::vector<std::string> plots =
      options.noPlots ? std::vector<std::string>{} : drawPlots(study, options.out);
  writeFile(options.out / "index.html", resultsPage(study, plots));
  std::cout << "study        " << printableName((options.out / "index.html").string()) << ", "
            << std::setprecision(3) << stopwatch.seconds() << " s\n";
  return ExitCode::kDone;
}

}  // namespace

void addStudy(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("study", "Speed against error, on cases whose truth is known");
  const auto options = std::make_shared<StudyOptions>();
  command.add("cases", options->cases, "Names of cases, or scene files of your own; all cases if none");
  command.add("--methods", options->methods, "Only these, with commas between").delimiter(',');
  command
      .add("--run", options->runs,
           "Table of poses (CSV, NPZ) of the one case that is named: takes part in it; may be repeated")
      .onePerUse();
  command.add("--label", options->labels, "Name of each --run in tables and plots").onePerUse();
  command.add("--seconds", options->seconds, "Time of one core that each --run took [s] (default: unknown)")
      .onePerUse();
  command.add("-o,--out", options->out, "Folder for tables, plots and page").showsDefault();
  command.addFlag("--quick", options->quick, "Few steps, few repeats: a minute for all");
  command.addFlag("--resume", options->resume, "Take over what is finished in the folder");
  command.addFlag("--no-plots", options->noPlots, "Tables and page only; gnuplot is not needed");
  command.addFlag("--list", options->list, "Only list the cases");
  command.runs([options](const std::stop_token& stop) { return studyCommand(*options, stop); });
}

}  // namespace careen
