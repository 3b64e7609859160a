#include "runs/run.h"

#include <initializer_list>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "core/math/arithmetic.h"
#include "question/until.h"
#include "scene/scene_reader.h"

namespace careen {
namespace {

constexpr double kDisagreement = 2;   // factor between the audit's figure and the method's own
constexpr double kAgreement = 1e-12;  // figures below are rounding
constexpr double kCheapPart = 0.1;    // of the run: the largest cost of an estimate by default

// "moved apart 3 pairs of boxes that overlapped and 1 box behind walls: 2 boxes by at most 0.01 m"
void tellParted(const Parted& parted, const Notice& notice) {
  if (parted.pairs + parted.behindWalls == 0) {
    return;
  }
  std::ostringstream words;
  words << "moved apart " << parted.pairs << (parted.pairs == 1 ? " pair" : " pairs")
        << " of boxes that overlapped";
  if (parted.behindWalls > 0) {
    words << " and " << parted.behindWalls << (parted.behindWalls == 1 ? " box" : " boxes")
          << " behind walls";
  }
  words << ": " << parted.moved << (parted.moved == 1 ? " box" : " boxes") << " by at most "
        << parted.furthest << " m";
  notice(words.str());
}

Question questionOf(const Simulation& how, const World& world) {
  try {
    return readQuestion(how.until, world);
  } catch (const InputError& error) {
    throw InputError(how.overrides.sign + "until: " + error.what());
  }
}

}  // namespace

Run simulateScene(const SceneText& scene, const Simulation& how, const std::stop_token& stop) {
  const DefaultFloatEnvironment usual;  // GL may be open in a window
  const RunOverrides& overrides = how.overrides;
  Scene parsed =
      parseScene(scene.text, scene.name, overrides.allowOverlap ? Starts::kMayOverlap : Starts::kApart);
  PreparedRun prepared = prepare(std::move(parsed), overrides,
                                 [&](const char* what, const std::string& given, const std::string& inScene) {
                                   how.notice(std::string(what) + " " + given +
                                              " from the command line (the scene says " + inScene + ")");
                                 });
  tellParted(prepared.parted, how.notice);
  if (how.change) {
    how.change(prepared.setup.world);
  }
  Run run;
  const Stopwatch stopwatch;
  if (how.until.empty()) {
    run.trajectory = record(std::move(prepared.setup), stop, overrides.most, how.progress);
  } else {
    RunUntil ended = recordUntil(prepared.setup, questionOf(how, prepared.setup.world), stop, overrides.most,
                                 how.progress);
    run.trajectory = std::move(ended.run);
    run.until = {.question = how.until, .time = ended.time};
  }
  run.simulateSeconds = stopwatch.seconds();
  return run;
}

Run simulateScene(const std::filesystem::path& path, const std::string& bytes, const Simulation& how,
                  const std::stop_token& stop) {
  Run run = simulateScene(sceneTextOf(path, bytes, how.notice), how, stop);
  run.source = path;
  return run;
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

void auditRun(Run& run, AuditDepth depth, const std::stop_token& stop, const AuditLimits& limits) {
  const DefaultFloatEnvironment usual;
  const Stopwatch stopwatch;
  run.audit = audit(run.trajectory, depth, stop, limits);
  run.auditSeconds = stopwatch.seconds();
}

void estimate(Run& run, std::optional<bool> asked, double wallSeconds, const std::stop_token& stop,
              const RunCallback& progress) {
  if (run.trajectory.given) {
    return;
  }
  const double expected = run.simulateSeconds * estimateCost(run.trajectory);
  if (!asked.value_or(expected > 0 && expected < kCheapPart * wallSeconds)) {
    return;
  }
  run.estimated = true;
  run.estimate = estimateError(run.trajectory, stop, progress);
}

}  // namespace careen
