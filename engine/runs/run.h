#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "audit/audit.h"
#include "runs/error_estimate.h"
#include "runs/source.h"
#include "scene/prepare.h"
#include "trajectory/trajectory.h"

namespace careen {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A statement whose becoming true ends a run.
struct UntilTold {
  std::string question;
  std::optional<double> time = {};  ///< [s] none: never, and the run has its whole duration
};

/// A run, its origin and its cost.
struct Run {
  std::filesystem::path source = {};  ///< the scene or trajectory file
  Trajectory trajectory = {};
  std::optional<UntilTold> until = {};  ///< if it was asked to end then
  double simulateSeconds = 0;           ///< [s] 0 if the trajectory was read from a file
  bool estimated = false;               ///< whether estimating its error was attempted
  std::optional<ErrorEstimate> estimate = {};
  Audit audit = {};
  double auditSeconds = 0;  ///< [s]

  /// The method's own figures, or the audit's where it found more than twice as much.
  RunFigures statedFigures() const;
};

/// How a scene is run.
struct Simulation {
  RunOverrides overrides = {};
  std::string until = {};  ///< a statement; empty: none
  RunCallback progress = {};
  /// Told, too, what replaces a value of the scene, and which boxes were moved.
  Notice notice = [](const std::string&) {};
  /// Of the world that begins: a program's controller.
  std::function<void(World&)> change = {};
};

/// Runs a scene, until the statement becomes true if there is one. InputError if it is no scene, or as
/// prepare(), recordUntil() and record() throw.
Run simulateScene(const SceneText& scene, const Simulation& how, const std::stop_token& stop = {});
/// Likewise the one that a file has, of these bytes.
Run simulateScene(const std::filesystem::path& path, const std::string& bytes, const Simulation& how,
                  const std::stop_token& stop = {});

/// Audits the run, at its cost.
void auditRun(Run& run, AuditDepth depth, const std::stop_token& stop, const AuditLimits& limits = {});

/// Estimates the run's error, if that is asked for or, where nothing is said, costs less than a tenth of the
/// time [s] spent so far. A table of poses has none.
void estimate(Run& run, std::optional<bool> asked, double wallSeconds, const std::stop_token& stop,
              const RunCallback& progress = {});

}  // namespace careen
