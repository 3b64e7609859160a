#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "runs/run.h"

namespace careen {

class CommandLine;

/// Tells on standard error what a user should know of a file.
void tellNotice(const std::string& notice);

/// How closely a run is audited, and what follows from a broken promise.
struct AuditChoice {
  std::string depth = "usual";
  bool keepGoing = false;  ///< write the run nevertheless, marked

  void addTo(const CommandLine& command);
  /// Without --keep-going.
  void addDepthTo(const CommandLine& command);
  AuditDepth auditDepth() const;
};

/// The scene of a run that is given as a table of poses (CSV or NPZ): its boxes' sizes and masses, its walls;
/// where a film is made, also a scene that says how a run is shown. And whether its clock began at another
/// time than the scene's.
struct SceneOfTable {
  std::optional<std::filesystem::path> path;
  bool mayShow = false;     ///< a run is shown as the scene says
  bool shiftsTime = false;  ///< the first row's time is 0 s

  void addTo(const CommandLine& command);
  /// Of a command that shows runs.
  void addShowingTo(const CommandLine& command);
  /// The option that was given and is of no use to a run that has its scene; null if none was.
  const char* useless() const;
  RunReading reading() const;
  /// The option that was given; null if none was.
  const char* given() const;

 private:
  void addClockTo(const CommandLine& command);
};

/// Audits the run; NumericalError, exit code 4, if it breaks a promise of its method, unless told to keep
/// going.
void auditRun(Run& run, const AuditChoice& choice, const std::stop_token& stop);

/// Whether to run the scene a second time to estimate its error.
struct EstimateChoice {
  std::optional<bool> asked;

  void addTo(const CommandLine& command);
  /// As estimate() of the engine; InputError if it is asked for of a run that cannot be repeated.
  void estimate(Run& run, double wallSeconds, const std::stop_token& stop,
                const RunCallback& progress = {}) const;
};

/// Command-line overrides of the scene file.
struct Overrides : RunOverrides {
  Overrides() { sign = "--"; }

  std::optional<std::string> methodName;
  std::optional<double> limit;  ///< of segments and impacts

  void addTo(const CommandLine& command);
  void addAllowOverlapTo(const CommandLine& command);
  void addLimitTo(const CommandLine& command);
  void addThreadsTo(const CommandLine& command);
  /// Most segments and impacts that the run may have.
  std::uint64_t mostRecords() const;
  /// With the method of that name, and this limit.
  RunOverrides read() const;
  /// The first option that was given; null if none was.
  const char* given() const;
};

/// The default scene of all commands.
std::filesystem::path defaultScene();

/// Runs a scene file, until that statement becomes true if there is one.
Run simulateFile(const std::filesystem::path& path, const Overrides& overrides, const std::stop_token& stop,
                 const RunCallback& progress = {}, const std::string& until = {});

/// As readRun() of the engine; InputError for options that mean nothing to that run.
Trajectory readRun(const std::filesystem::path& path, const SceneOfTable& scene,
                   const std::function<RunSetup()>& setup = {});

/// Runs a scene file, or reads a trajectory file or a table of poses; with the latter two nothing can be
/// overridden.
Run loadRun(const std::filesystem::path& path, const Overrides& overrides, const SceneOfTable& scene,
            const std::stop_token& stop, const RunCallback& progress = {});

}  // namespace careen
