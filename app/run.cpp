#include "run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <string_view>
#include <utility>

#include "command_line.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/math/arithmetic.h"
#include "core/names.h"
#include "core/system/file.h"
#include "core/system/resource.h"
#include "exchange/import_mjcf.h"
#include "parsed.h"
#include "physics/world/method.h"
#include "question/until.h"
#include "scene/plan.h"
#include "scene/prepare.h"
#include "scene/scene_reader.h"
#include "scene/shown_as.h"
#include "trajectory/given_run.h"
#include "trajectory/pose_table.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

constexpr double kDisagreement = 2;   // factor between the audit's figure and the method's own
constexpr double kAgreement = 1e-12;  // figures below are rounding
constexpr double kCheapPart = 0.1;    // of the run: the largest cost of an estimate by default

// Reports on standard error what was moved.
void tellParted(const Parted& parted) {
  if (parted.pairs + parted.behindWalls == 0) {
    return;
  }
  std::cerr << "careen: moved apart " << parted.pairs << (parted.pairs == 1 ? " pair" : " pairs")
            << " of boxes that overlapped";
  if (parted.behindWalls > 0) {
    std::cerr << " and " << parted.behindWalls << (parted.behindWalls == 1 ? " box" : " boxes")
              << " behind walls";
  }
  std::cerr << ": " << parted.moved << (parted.moved == 1 ? " box" : " boxes") << " by at most "
            << parted.furthest << " m\n";
}

Run simulateText(const std::filesystem::path& path, const std::string& bytes, const Overrides& overrides,
                 const std::stop_token& stop, const RunCallback& progress, const std::string& until) {
  const DefaultFloatEnvironment usual;  // GL may be open in a window
  const auto [text, name] = sceneTextOf(path, bytes);
  Scene scene = parseScene(text, name, overrides.allowOverlap ? Starts::kMayOverlap : Starts::kApart);
  // Scene file and command line differ: tell the user which one counts.
  PreparedRun prepared = prepare(std::move(scene), overrides.read(),
                                 [](const char* what, const std::string& given, const std::string& inFile) {
                                   std::cerr << "careen: " << what << " " << given
                                             << " from the command line (the scene says " << inFile << ")\n";
                                 });
  tellParted(prepared.parted);
  Run run;
  run.source = path;
  const Stopwatch stopwatch;
  if (until.empty()) {
    run.trajectory = record(std::move(prepared.setup), stop, overrides.mostRecords(), progress);
  } else {
    const auto read = [&](const std::string& each) { return readQuestion(each, prepared.setup.world); };
    RunUntil ended =
        recordUntil(prepared.setup, parsed("--until", until, read), stop, overrides.mostRecords(), progress);
    run.trajectory = std::move(ended.run);
    run.until = {.question = until, .time = ended.time};
  }
  run.simulateSeconds = stopwatch.seconds();
  return run;
}

// Enough of a file to tell what it is.
std::string beginningOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string begin(1024, '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  return begin;
}

// A clock that began elsewhere, such as that of Unix, would be taken for a scene that lasts so long.
PoseTable readTable(const std::string& bytes, const std::string& name, bool shiftsTime, double duration) {
  PoseTable table = readPoseTable(bytes, name);
  if (shiftsTime) {
    table.beginAtZero();
    return table;
  }
  const double first = table.firstTime();
  if (first > duration) {
    throw InputError(name + ": found a first row at " + inFull(first) +
                     " s, expected one within the scene's " + inFull(duration) +
                     " s; --shift-time counts from the first row");
  }
  const auto last = std::max_element(table.rows.begin(), table.rows.end(),
                                     [](const PoseRow& a, const PoseRow& b) { return a.time < b.time; });
  if (first > last->time - first) {
    std::cerr << "careen: " << printableName(name) << ": its first row is at " << inFull(first)
              << " s; until then the boxes go there from where the scene has them; --shift-time counts from "
                 "the first row\n";
  }
  return table;
}

Trajectory readRunOf(const std::string& bytes, const std::filesystem::path& path, const SceneOfTable& scene,
                     const std::function<RunSetup()>& setup) {
  if (!looksLikeTrajectory(bytes) && looksLikePoseTable(bytes, path.string())) {
    if (!scene.path && !setup) {
      throw InputError(path.string() +
                       ": is a table of poses, without sizes and walls; expected --scene with the scene");
    }
    RunSetup start = scene.path ? setupOfScene(*scene.path) : setup();
    const PoseTable table = readTable(bytes, path.string(), scene.shiftsTime, start.settings.duration);
    return givenRun(std::move(start), table);
  }
  if (scene.useless() != nullptr && !setup) {
    throw InputError(std::string(scene.useless()) + ": found the run " + path.string() +
                     ", which has its scene; expected a table of poses");
  }
  Trajectory run = decodeTrajectory(bytes, path.string());
  if (scene.path && scene.mayShow && !setup) {
    const auto [text, name] = sceneTextOf(*scene.path, readFile(*scene.path));
    showAs(run, text, name);
  }
  return run;
}

}  // namespace

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
  RunOverrides run = *this;
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

void estimate(Run& run, const EstimateChoice& choice, double wallSeconds, const std::stop_token& stop,
              const RunCallback& progress) {
  if (run.trajectory.given) {
    if (choice.asked.value_or(false)) {
      throw InputError("--estimate-error: found the table of poses " + run.source.string() +
                       ", expected a run that this program can repeat");
    }
    return;
  }
  const double expected = run.simulateSeconds * estimateCost(run.trajectory);
  if (!choice.asked.value_or(expected > 0 && expected < kCheapPart * wallSeconds)) {
    return;
  }
  run.estimated = true;
  run.estimate = estimateError(run.trajectory, stop, progress);
}

RunFigures Run::statedFigures() const {
  RunFigures figures = trajectory.figures;
  const auto state = [this](double& own, std::initializer_list<AuditKind> kinds) {
    for (const AuditKind kind : kinds) {
      const double found = audit.figure(kind).promised ? audit.figure(kind).size : 0;
      if (found > kDisagreement * own && found > kAgreement) {
        own = found;
      }
    }
  };
  state(figures.energyChange, {AuditKind::kEnergyRise, AuditKind::kEnergyLoss});
  state(figures.momentumChange, {AuditKind::kLinearMomentum, AuditKind::kAngularMomentum});
  state(figures.orthogonality, {AuditKind::kOrthogonality});
  state(figures.deepestPenetration, {AuditKind::kBoxOverlap, AuditKind::kWallOverlap});
  return figures;
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
  const DefaultFloatEnvironment usual;  // GL may be open in a window
  const Stopwatch stopwatch;
  run.audit = audit(run.trajectory, choice.auditDepth(), stop);
  run.auditSeconds = stopwatch.seconds();
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

bool isMujocoModel(const std::filesystem::path& path) { return path.extension() == ".xml"; }

SceneText sceneTextOf(const std::filesystem::path& path, const std::string& bytes) {
  if (!isMujocoModel(path)) {
    return {.text = bytes, .name = path.string()};
  }
  ImportedScene imported = importMjcf(bytes, path.string());
  for (const std::string& each : imported.notes) {
    std::cerr << "careen: " << printableName(path.string()) << ": " << printableName(each) << '\n';
  }
  return {.text = std::move(imported.text), .name = path.string() + " (its scene)"};
}

std::filesystem::path defaultScene() { return findResource("assets/scenes/careen.json"); }

Run simulateScene(const std::filesystem::path& path, const Overrides& overrides, const std::stop_token& stop,
                  const RunCallback& progress, const std::string& until) {
  return simulateText(path, readFile(path), overrides, stop, progress, until);
}

bool isTable(const std::filesystem::path& path) {
  const std::string begin = beginningOf(path);
  return !isMujocoModel(path) && !looksLikeTrajectory(begin) && looksLikePoseTable(begin, path.string());
}

bool isRun(const std::filesystem::path& path) {
  return looksLikeTrajectory(beginningOf(path)) || isTable(path);
}

RunSetup setupOfScene(const std::filesystem::path& scene) {
  const auto [text, name] = sceneTextOf(scene, readFile(scene));
  Scene read = parseScene(text, name, Starts::kMayOverlap);
  read.settings.method = Method::kExact;
  return setupOf(read);
}

Trajectory readRun(const std::filesystem::path& path, const SceneOfTable& scene,
                   const std::function<RunSetup()>& setup) {
  return readRunOf(readFile(path), path, scene, setup);
}

Run loadRun(const std::filesystem::path& path, const Overrides& overrides, const SceneOfTable& scene,
            const std::stop_token& stop, const RunCallback& progress) {
  const std::string bytes = readFile(path);
  if (isMujocoModel(path) || (!looksLikeTrajectory(bytes) && !looksLikePoseTable(bytes, path.string()))) {
    if (const char* const option = scene.given()) {
      throw InputError(std::string(option) + ": found the scene " + path.string() +
                       " to be run, expected a table of poses");
    }
    return simulateText(path, bytes, overrides, stop, progress, {});
  }
  if (const char* const option = overrides.given()) {
    throw InputError(std::string(option) + ": found the run " + path.string() +
                     ", expected a scene that is to be run");
  }
  Run run;
  run.source = path;
  run.trajectory = readRunOf(bytes, path, scene, {});
  return run;
}

}  // namespace careen
