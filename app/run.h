#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "audit/audit.h"
#include "scene/prepare.h"
#include "study/error_estimate.h"
#include "trajectory/trajectory.h"

namespace careen {

class CommandLine;

/// A statement whose becoming true ends a run.
struct UntilTold {
  std::string question;
  std::optional<double> time = {};  ///< [s] none: never, and the run has its whole duration
};

/// A run, its origin and its cost.
struct Run {
  std::filesystem::path source;  ///< the scene or trajectory file
  Trajectory trajectory;
  std::optional<UntilTold> until;  ///< if it was asked to end then
  double simulateSeconds = 0;      ///< [s] 0 if the trajectory was read from a file
  bool estimated = false;          ///< whether estimating its error was attempted
  std::optional<ErrorEstimate> estimate;
  Audit audit;
  double auditSeconds = 0;  ///< [s]

  /// The method's own figures, or the audit's where it found more than twice as much.
  RunFigures statedFigures() const;
};

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
};

/// Estimates the run's error if asked to; by default only if that costs less than 10 % of the time spent so
/// far.
void estimate(Run& run, const EstimateChoice& choice, double wallSeconds, const std::stop_token& stop,
              const RunCallback& progress = {});

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

/// A scene's text, and its name in messages.
struct SceneText {
  std::string text;
  std::string name;
};

/// The scene that a file has: its bytes, or, of a model of MuJoCo (.xml), the scene that it is; what was left
/// out is told on standard error.
SceneText sceneTextOf(const std::filesystem::path& path, const std::string& bytes);
/// Whether the file is a model of MuJoCo, by its name.
bool isMujocoModel(const std::filesystem::path& path);

/// The default scene of all commands.
std::filesystem::path defaultScene();

/// Reads a scene file and runs it, until that statement becomes true if there is one. Reports overrides on
/// standard error.
Run simulateScene(const std::filesystem::path& path, const Overrides& overrides, const std::stop_token& stop,
                  const RunCallback& progress = {}, const std::string& until = {});

/// Whether the file is a run: a trajectory, or a table of poses.
bool isRun(const std::filesystem::path& path);
/// Whether it is a table of poses.
bool isTable(const std::filesystem::path& path);

/// What a run of this scene starts from, by method exact, which models all of it.
RunSetup setupOfScene(const std::filesystem::path& scene);

/// Reads a trajectory file of any version: what an incomplete one lacks is made from the scene text in it. Or
/// a table of poses, with its scene, or else with the setup that `setup` gives. InputError for a table
/// without either; and, if there is no `setup`, for a scene with a trajectory.
Trajectory readRun(const std::filesystem::path& path, const SceneOfTable& scene,
                   const std::function<RunSetup()>& setup = {});

/// Runs a scene file, or reads a trajectory file or a table of poses; with the latter two nothing can be
/// overridden.
Run loadRun(const std::filesystem::path& path, const Overrides& overrides, const SceneOfTable& scene,
            const std::stop_token& stop, const RunCallback& progress = {});

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace careen
