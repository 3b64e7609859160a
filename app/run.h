#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "study/error_estimate.h"
#include "trajectory/trajectory.h"

namespace CLI {
class App;
}

namespace careen {

/// A run, where it came from and what it cost.
struct Run {
  std::filesystem::path source;  ///< the scene or trajectory file
  Trajectory trajectory;
  double simulateSeconds = 0;  ///< [s] 0 when the trajectory was read from a file
  bool estimated = false;      ///< whether its error was looked for
  std::optional<ErrorEstimate> estimate;
};

/// Whether to run the scene once more, to estimate its error.
struct EstimateChoice {
  std::optional<bool> asked;

  void addTo(CLI::App& command);
};

/// Estimates the run's error if that was asked for, or if nothing was said and it takes less than a tenth of
/// the time that all took so far.
void estimate(Run& run, const EstimateChoice& choice, double wallSeconds, const std::stop_token& stop);

/// What the command line puts in place of the scene file's own.
struct Overrides {
  std::optional<std::string> method;
  std::optional<double> dt;  ///< [s]
  std::optional<double> tolerance;
  std::optional<double> duration;  ///< [s]
  bool allowOverlap = false;       ///< boxes that overlap at the start are moved apart first

  void addTo(CLI::App& command);
  void addAllowOverlapTo(CLI::App& command);
  /// The first option that was given; null: none was.
  const char* given() const;
};

/// The scene that every command takes when none is named.
std::filesystem::path defaultScene();

/// Reads a scene file and runs it. Tells on the standard error what was overridden.
Run simulateScene(const std::filesystem::path& path, const Overrides& overrides, const std::stop_token& stop);

/// A trajectory file of any version: what one that is not whole lacks is made of the scene's text that it
/// holds.
Trajectory readRun(const std::filesystem::path& path);

/// Takes a scene file, which is run, or a trajectory file, which was; of the latter nothing can be
/// overridden.
Run loadRun(const std::filesystem::path& path, const Overrides& overrides, const std::stop_token& stop);

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace careen
