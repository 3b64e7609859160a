#include "simulation_progress.h"

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/brief.h"

namespace careen {
namespace {

constexpr double kPrintEvery = 0.5;  // [s]

std::string simulationJson(const char* phase, const RunProgress& run) {
  nlohmann::ordered_json line = {
      {"phase", phase},           {"simulated", run.now.time},  {"duration", run.duration},
      {"impacts", run.impacts},   {"records", run.now.records}, {"flying", run.flying},
      {"touching", run.touching}, {"resting", run.resting},     {"seconds", run.now.wallSeconds},
      {"seconds_left", nullptr}};
  if (const std::optional<double> left = run.forecast.secondsUntil(run.duration)) {
    line["seconds_left"] = *left;
  }
  return line.dump();
}

std::string simulationWords(const char* title, const RunProgress& run) {
  std::string words = title + brief(run.now.time) + " of " + brief(run.duration) + " s";
  if (const std::optional<double> left = run.forecast.secondsUntil(run.duration)) {
    words += ", " + inTime(*left) + " left";
  }
  words += ", " + std::to_string(run.impacts) + " impacts";
  for (const auto& [boxes, what] :
       {std::pair(run.flying, " fly"), std::pair(run.touching, " touch"), std::pair(run.resting, " rest")}) {
    if (boxes > 0) {
      words += ", " + std::to_string(boxes) + what;
    }
  }
  return words;
}

}  // namespace

std::string inTime(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 3600;
  if (seconds < 2 * kMinute) {
    return brief(std::ceil(seconds), 3) + " s";
  }
  const auto [amount, unit] =
      seconds < 2 * kHour ? std::pair(seconds / kMinute, " min") : std::pair(seconds / kHour, " h");
  return (amount < 9.95 ? brief(amount, 2) : brief(std::round(amount), 15)) + unit;
}

RunCallback SimulationProgress::ofRun(std::uint64_t mostRecords) {
  return [this, mostRecords](const RunProgress& run) {
    if (!warned_ && run.forecast.exceeds(mostRecords, run.duration)) {
      warn(run, mostRecords);
    }
    show("simulate", "simulated ", run);
  };
}

RunCallback SimulationProgress::ofEstimate() {
  return [this](const RunProgress& run) { show("estimate", "error estimate, run again: ", run); };
}

void SimulationProgress::show(const char* phase, const char* title, const RunProgress& run) {
  if (json_ && (run.isOver || run.now.wallSeconds - printedAt_ >= kPrintEvery)) {
    printedAt_ = run.isOver ? 0 : run.now.wallSeconds;
    std::cout << simulationJson(phase, run) << std::endl;  // flushed: somebody may be waiting for it
  }
  if (run.isOver) {
    line_.clear();
  } else {
    line_.show(simulationWords(title, run));
  }
}

// Only a warning: what a run will record is not known before it has.
void SimulationProgress::warn(const RunProgress& run, std::uint64_t mostRecords) {
  warned_ = true;
  line_.clear();
  const double end = run.forecast.timeOf(static_cast<double>(mostRecords));
  std::cerr << "careen: at this rate the run will end in an error " << inTime(*run.forecast.secondsUntil(end))
            << " from now, at " << brief(end) << " s of " << brief(run.duration) << " s, with more than "
            << mostRecords
            << " pieces of motion and impacts; a shorter run, longer steps, or a higher --limit avoid that\n";
}

}  // namespace careen
