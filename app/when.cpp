#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/system/file.h"
#include "core/table.h"
#include "question/moments.h"
#include "run_options.h"

namespace careen {
namespace {

constexpr int kDigits = 12;

struct WhenOptions {
  std::filesystem::path run;
  std::vector<std::string> questions;
  SceneOfTable scene;
  Overrides overrides;
  std::filesystem::path output;
  bool first = false;
};

std::string partnerIn(const Trajectory& run, const Moment& moment) {
  return moment.with ? nameOf(*moment.with, run.world) : "";
}

void print(const Trajectory& run, const Question& question, const std::vector<Moment>& found) {
  const bool tellsPartner = question.of.size() == 1;  // with anything
  for (const Moment& moment : found) {
    std::cout << brief(moment.time, kDigits) << " s  " << printableName(question.text);
    if (moment.with && tellsPartner) {
      std::cout << ": " << printableName(partnerIn(run, moment));
    }
    std::cout << '\n';
  }
  if (found.empty()) {
    std::cout << "never  " << printableName(question.text) << '\n';
  }
}

std::string rowsOf(const Trajectory& run, const Question& question, const std::vector<Moment>& found) {
  std::string rows;
  for (const Moment& moment : found) {
    rows += CsvRow().add(question.text).add(moment.time).add(partnerIn(run, moment)).line();
  }
  return found.empty() ? CsvRow().add(question.text).add("nan").add("").line() : rows;
}

std::vector<Question> questionsOf(const WhenOptions& options, const World& world) {
  std::vector<Question> questions;
  for (const std::string& text : options.questions) {
    questions.push_back(readQuestion(text, world));
  }
  return questions;
}

ExitCode whenCommand(const WhenOptions& options, const std::stop_token& stop) {
  if (!isRun(options.run) && !isMujocoModel(options.run)) {
    questionsOf(options, setupOfScene(options.run, tellNotice).world);  // before it is simulated
  }
  const Run run = loadRun(options.run, options.overrides, options.scene, stop);
  const std::vector<Question> questions = questionsOf(options, run.trajectory.world);
  std::string table = CsvRow().add("question").add("time").add("with").line();
  for (const Question& question : questions) {
    std::vector<Moment> found = moments(run.trajectory, question);
    if (options.first && !found.empty()) {
      found.resize(1);
    }
    print(run.trajectory, question, found);
    table += rowsOf(run.trajectory, question, found);
  }
  if (!options.output.empty()) {
    writeFile(options.output, table);
  }
  return ExitCode::kDone;
}

}  // namespace

void addWhen(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand("when", "When statements about a run become true");
  const auto options = std::make_shared<WhenOptions>();
  command.add("run", options->run, "Trajectory file, scene, or table of poses (CSV, NPZ)").required();
  command
      .add("questions", options->questions,
           "Statements, such as 'a touches b', 'a leaves floor', 'height(a) < 0.5', 'distance(a, b) > 1', "
           "'rest(a)', 'rest'")
      .required();
  command.addFlag("--first", options->first, "Only the first moment of each");
  command.add("-o,--out", options->output, "Table of all moments (CSV)");
  options->scene.addTo(command);
  options->overrides.addTo(command);
  options->overrides.addThreadsTo(command);
  command.footer(
      "Quantities: height, x, y, z, speed, spin, energy, tilt (degrees) of a box, and distance of two; < or "
      ">.\nExit codes: 0 answered, 2 a bad question or file.");
  command.runs([options](const std::stop_token& stop) { return whenCommand(*options, stop); });
}

}  // namespace careen
