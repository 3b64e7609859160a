#include "run_options.h"

#include <cstdint>
#include <iostream>
#include <utility>

#include "audit/audit.h"
#include "command_line.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/names.h"
#include "core/system/file.h"
#include "core/system/resource.h"
#include "parsed.h"
#include "physics/world/method.h"

namespace careen {

void tellNotice(const std::string& notice) { std::cerr << "careen: " << printableName(notice) << '\n'; }

void Overrides::addTo(const CommandLine& command) {
  command.add("--method", methodName, "Method of motion in place of the scene's");
  command.add("--dt", dt, "Step in place of the scene's [s], for methods that step");
  command.add("--tolerance", tolerance,
              "Tolerance in place of the scene's, for methods that choose their own");
  command.add("--duration", duration, "Length of the run in place of the scene's [s]");
  addAllowOverlapTo(command);
  addLimitTo(command);
}

void Overrides::addAllowOverlapTo(const CommandLine& command) {
  command.addFlag("--allow-overlap", allowOverlap,
                  "Move boxes that overlap at the start apart, in place of refusing the scene");
}

void Overrides::addLimitTo(const CommandLine& command) {
  command.add("--limit", limit,
              "Most segments and impacts of the run (default: 5000000, 2 GB); methods that step may take 200 "
              "steps of a box for each");
}

void Overrides::addThreadsTo(const CommandLine& command) {
  command.add(
      "--threads", threads,
      "Threads that share the steps of large crowds; they change nothing but the time (default: one for "
      "each core)");
}

RunOverrides Overrides::read() const {
  auto run = static_cast<const RunOverrides&>(*this);
  if (methodName) {
    const auto place = [](const std::string& name) { return indexAmong(name, kMethodNames); };
    run.method = kMethods.at(parsed("--method", *methodName, place)).method;
  }
  run.most = mostRecords();
  return run;
}

std::uint64_t Overrides::mostRecords() const {
  if (!limit) {
    return kMostRecords;
  }
  if (!(*limit >= 1 && *limit < 1e18)) {
    throw InputError("--limit: found " + brief(*limit) + ", expected 1 or more, below 1e18");
  }
  return static_cast<std::uint64_t>(*limit);
}

const char* Overrides::given() const {
  return methodName     ? "--method"
         : dt           ? "--dt"
         : tolerance    ? "--tolerance"
         : duration     ? "--duration"
         : allowOverlap ? "--allow-overlap"
                        : nullptr;
}

void EstimateChoice::addTo(const CommandLine& command) {
  const CommandOption yes = command.addFlag(
      "--estimate-error", [this] { asked = true; },
      "Run it a second time to tell how wrong it is (default: if that takes less than a tenth of the whole)");
  command
      .addFlag(
          "--no-estimate-error", [this] { asked = false; }, "Do not")
      .excludes(yes);
}

void EstimateChoice::estimate(Run& run, double wallSeconds, const std::stop_token& stop,
                              const RunCallback& progress) const {
  if (run.trajectory.given && asked.value_or(false)) {
    throw InputError("--estimate-error: found the table of poses " + run.source.string() +
                     ", expected a run that this program can repeat");
  }
  careen::estimate(run, asked, wallSeconds, stop, progress);
}

void SceneOfTable::addTo(const CommandLine& command) {
  command.add("--scene", path,
              "Scene of a run that is a table of poses (CSV, NPZ): sizes, masses, walls, camera");
  addClockTo(command);
}

void SceneOfTable::addClockTo(const CommandLine& command) {
  command.addFlag("--shift-time", shiftsTime,
                  "The table's times count from its first row: its clock began at another time");
}

void SceneOfTable::addShowingTo(const CommandLine& command) {
  mayShow = true;
  command.add(
      "--scene", path,
      "How a run is shown: a scene whose camera, film, look, light and overlays it takes; of a run that is a "
      "table of poses (CSV, NPZ) all of its scene");
  addClockTo(command);
}

const char* SceneOfTable::useless() const {
  const char* const clock = shiftsTime ? "--shift-time" : nullptr;
  return path && mayShow ? clock : given();
}

RunReading SceneOfTable::reading() const {
  return {.scene = path, .shiftsTime = shiftsTime, .notice = tellNotice};
}

const char* SceneOfTable::given() const { return path ? "--scene" : shiftsTime ? "--shift-time" : nullptr; }

AuditDepth AuditChoice::auditDepth() const {
  return static_cast<AuditDepth>(indexAmong(depth, kAuditDepthNames));
}

void AuditChoice::addTo(const CommandLine& command) {
  addDepthTo(command);
  command.addFlag("--keep-going", keepGoing,
                  "Write a run that breaks a promise of its method, marked, and exit with 0, in place of 4");
}

void AuditChoice::addDepthTo(const CommandLine& command) {
  const std::vector<std::string> depths(kAuditDepthNames.begin(), kAuditDepthNames.end());
  command
      .add("--audit", depth,
           "How closely the run is audited: usual, full (every segment of every box), none (default: usual)")
      .oneOf(depths);
}

void auditRun(Run& run, const AuditChoice& choice, const std::stop_token& stop) {
  auditRun(run, choice.auditDepth(), stop);
  // Nobody promised anything of a table; `audit` is the command that holds it to something.
  if (run.audit.breaches.empty() || choice.keepGoing || run.trajectory.given) {
    return;
  }
  std::string broken;
  for (const AuditBreach& breach : run.audit.breaches) {
    broken += (broken.empty() ? "" : "\n  ") + describe(breach, run.trajectory);
  }
  throw NumericalError("the run of " + run.source.string() +
                       " breaks what its method promises; nothing is written without --keep-going:\n  " +
                       broken);
}

std::filesystem::path defaultScene() { return findResource("assets/scenes/careen.json"); }

namespace {

Run simulateBytes(const std::filesystem::path& path, const std::string& bytes, const Overrides& overrides,
                  const std::stop_token& stop, const RunCallback& progress, const std::string& until) {
  const Simulation how{
      .overrides = overrides.read(), .until = until, .progress = progress, .notice = tellNotice};
  return simulateScene(path, bytes, how, stop);
}

Trajectory readBytes(const std::filesystem::path& path, const std::string& bytes, const SceneOfTable& scene,
                     const std::function<RunSetup()>& setup) {
  if (scene.useless() != nullptr && !setup && isRun(path, bytes) && !isTable(path, bytes)) {
    throw InputError(std::string(scene.useless()) + ": found the run " + path.string() +
                     ", which has its scene; expected a table of poses");
  }
  return readRun(path, bytes, scene.reading(), setup);
}

}  // namespace

Run simulateFile(const std::filesystem::path& path, const Overrides& overrides, const std::stop_token& stop,
                 const RunCallback& progress, const std::string& until) {
  return simulateBytes(path, readFile(path), overrides, stop, progress, until);
}

Trajectory readRun(const std::filesystem::path& path, const SceneOfTable& scene,
                   const std::function<RunSetup()>& setup) {
  return readBytes(path, readFile(path), scene, setup);
}

Run loadRun(const std::filesystem::path& path, const Overrides& overrides, const SceneOfTable& scene,
            const std::stop_token& stop, const RunCallback& progress) {
  const std::string bytes = readFile(path);  // once: it may come through a pipe
  if (!isRun(path, bytes)) {
    if (const char* const option = scene.given()) {
      throw InputError(std::string(option) + ": found the scene " + path.string() +
                       " to be run, expected a table of poses");
    }
    return simulateBytes(path, bytes, overrides, stop, progress, {});
  }
  if (const char* const option = overrides.given()) {
    throw InputError(std::string(option) + ": found the run " + path.string() +
                     ", expected a scene that is to be run");
  }
  return {.source = path, .trajectory = readBytes(path, bytes, scene, {})};
}

}  // namespace careen
