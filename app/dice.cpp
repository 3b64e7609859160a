#include "study/dice.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "commands.h"
#include "core/brief.h"
#include "core/error.h"
#include "core/system/file.h"
#include "parsed.h"
#include "run_options.h"
#include "simulation_progress.h"
#include "status_line.h"
#include "study/dice_plots.h"
#include "study/study.h"

namespace careen {
namespace {

struct DiceOptions {
  std::vector<std::string> restitutions = {"0.5"};
  std::vector<std::string> frictions = {"0.3"};
  std::vector<std::string> heights = {"0.2"};
  std::vector<std::string> speeds = {"1"};
  std::vector<std::string> spins = {"40"};
  double throws = 10000;
  std::optional<int> threads;
  std::filesystem::path out = "dice";
  bool noPlots = false;
};

std::vector<double> numbersIn(const char* option, const std::vector<std::string>& texts, double least,
                              double most) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    numbers.push_back(
        numberIn(option, text, "numbers from " + brief(least) + " to " + brief(most), least, most));
  }
  return numbers;
}

// The first of every list, then each list's others with the first of all the rest.
std::vector<ThrowSettings> settingsOf(const DiceOptions& options) {
  if (!(options.throws >= 1 && options.throws <= 1e8) || options.throws != std::floor(options.throws)) {
    throw InputError("--throws: found " + brief(options.throws) + ", expected a whole number from 1 to 1e8");
  }
  if (options.threads && !(*options.threads >= 1 && *options.threads <= 1000)) {
    throw InputError("--threads: found " + std::to_string(*options.threads) +
                     ", expected a number from 1 to 1000");
  }
  const std::vector<std::pair<double ThrowSettings::*, std::vector<double>>> lists = {
      {&ThrowSettings::restitution, numbersIn("--restitution", options.restitutions, 0, 0.99)},
      {&ThrowSettings::friction, numbersIn("--friction", options.frictions, 0.01, 10)},
      {&ThrowSettings::height, numbersIn("--height", options.heights, 0.05, 10)},
      {&ThrowSettings::speed, numbersIn("--speed", options.speeds, 0, 100)},
      {&ThrowSettings::spin, numbersIn("--spin", options.spins, 0, 1000)}};
  ThrowSettings first;
  first.throws = static_cast<int>(options.throws);
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  first.threads = options.threads.value_or(cores);
  for (const auto& [what, numbers] : lists) {
    first.*what = numbers.front();
  }
  std::vector<ThrowSettings> all = {first};
  for (const auto& [what, numbers] : lists) {
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      all.push_back(first);
      all.back().*what = numbers[i];
    }
  }
  return all;
}

// One line that is rewritten on a terminal.
class DiceProgress {
 public:
  explicit DiceProgress(double all) : all_(all) {}

  void show(double thrown) {
    if (!line_.isOnTerminal()) {
      return;
    }
    const double left = stopwatch_.seconds() * (all_ - thrown) / thrown;
    line_.show("thrown " + brief(thrown, 15) + " of " + brief(all_, 15) + " dice, " + inTime(left) + " left");
  }
  void clear() { line_.clear(); }

 private:
  double all_;
  Stopwatch stopwatch_;
  StatusLine line_;
};

ExitCode diceCommand(const DiceOptions& options, const std::stop_token& stop) {
  const Stopwatch stopwatch;
  if (!options.noPlots) {
    checkPlotter();
  }
  const std::vector<ThrowSettings> all = settingsOf(options);
  makeFolder(options.out);
  DiceProgress progress(static_cast<double>(all.size() * kMeasuredDice.size()) * options.throws);
  double before = 0;
  std::vector<DiceResult> results;
  for (const ThrowSettings& settings : all) {
    DiceResult& result = results.emplace_back();
    result.settings = settings;
    for (const MeasuredDie& die : kMeasuredDice) {
      result.faces.push_back(
          throwDice(die.ratio, settings, stop, [&](int thrown) { progress.show(before + thrown); }));
      before += options.throws;
    }
    progress.clear();
    std::cout << "restitution " << brief(settings.restitution) << ", friction " << brief(settings.friction)
              << ", " << brief(settings.height) << " m, " << brief(settings.speed) << " m/s, "
              << brief(settings.spin) << " rad/s: " << result.within() << " of " << result.faces.size()
              << " within two standard deviations\n"
              << std::flush;  // progress
  }
  writeFile(options.out / "dice.csv", diceCsv(results));
  writeFile(options.out / "dice.md", diceMarkdown(results) + "\nMade by careen " CAREEN_VERSION ".\n");
  if (!options.noPlots) {
    for (const DicePlot& each : dicePlots(results)) {
      drawPlot(each.plot, options.out / each.of);
    }
  }
  std::cout << "dice         " << (options.out / "dice.md").string() << ", " << brief(stopwatch.seconds(), 3)
            << " s\n";
  return ExitCode::kDone;
}

}  // namespace

void addDice(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("dice", "How often cuboid dice end on each face, beside 9329 measured rolls");
  const auto options = std::make_shared<DiceOptions>();
  command.add("--throws", options->throws, "Throws of each of the fifteen shapes").showsDefault();
  command.add("--restitution", options->restitutions, "With commas between: the first is the usual one")
      .delimiter(',')
      .showsDefault();
  command.add("--friction", options->frictions, "Likewise").delimiter(',').showsDefault();
  command.add("--height", options->heights, "Likewise, height of the throw [m]")
      .delimiter(',')
      .showsDefault();
  command.add("--speed", options->speeds, "Likewise, speed along the floor [m/s]")
      .delimiter(',')
      .showsDefault();
  command.add("--spin", options->spins, "Likewise, largest angular speed [rad/s]")
      .delimiter(',')
      .showsDefault();
  command.add("--threads", options->threads, "Threads (default: one for each core)");
  command.add("-o,--out", options->out, "Folder for the tables and plots").showsDefault();
  command.addFlag("--no-plots", options->noPlots, "Tables only; gnuplot is not needed");
  command.runs([options](const std::stop_token& stop) { return diceCommand(*options, stop); });
}

}  // namespace careen
