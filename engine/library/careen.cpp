#include "library/careen.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/math/arithmetic.h"
#include "library/run_data.h"
#include "library/translated.h"
#include "physics/world/control.h"
#include "physics/world/method.h"
#include "question/moments.h"
#include "runs/run_report.h"
#include "trajectory/energy_samples.h"
#include "trajectory/force_samples.h"
#include "trajectory/pose_samples.h"
#include "trajectory/trajectory_file.h"

namespace careen::v1 {
const char* version() { return "careen " CAREEN_VERSION; }

namespace {

State stateOf(const Body& body, const BodyState& state) {
  const Pose box = boxPose(body, state.pose);
  const Quat q(box.worldFromBody);
  return {.position = vectorOf(box.position),
          .orientation = {q.w(), q.x(), q.y(), q.z()},
          .velocity = vectorOf(boxVelocity(body, state)),
          .angularVelocity = vectorOf(angularVelocity(body.mass, state))};
}

Control controlBy(double period, const Controller& controller, const World& world) {
  std::vector<std::string> names;
  for (const Joint& joint : world.joints) {
    names.push_back(joint.name);
  }
  const std::vector<Body> bodies = world.bodies;
  Control control{.period = period};
  control.callback = [=](double time, std::span<const BodyState> states, std::span<const JointSample> samples,
                         std::span<double> efforts) {
    std::vector<State> boxes;
    for (std::size_t i = 0; i < states.size(); ++i) {
      boxes.push_back(stateOf(bodies[i], states[i]));
    }
    std::vector<JointReading> joints;
    for (std::size_t j = 0; j < samples.size(); ++j) {
      joints.push_back({.name = names[j], .coordinate = samples[j].coordinate, .rate = samples[j].rate});
    }
    const std::vector<double> answer = controller(time, boxes, joints);
    if (answer.size() != efforts.size()) {
      throw InputError("found " + std::to_string(answer.size()) + " efforts of a controller, expected " +
                       std::to_string(efforts.size()) + ", one for each joint");
    }
    for (std::size_t j = 0; j < efforts.size(); ++j) {
      if (!std::isfinite(answer[j])) {
        throw InputError("found an effort of joint " + names[j] + " that is no finite number");
      }
      efforts[j] = answer[j];
    }
  };
  return control;
}

}  // namespace

Run::Run(const Scene& scene) {
  data_ = translated(scene.name(), [&] {
    Simulation how;
    how.overrides.method = scene.method_ ? methodNamed(*scene.method_) : std::nullopt;
    how.overrides.dt = scene.step_;
    how.overrides.tolerance = scene.tolerance_;
    how.overrides.duration = scene.duration_;
    how.overrides.allowOverlap = scene.allowsOverlap_;
    how.overrides.threads = scene.threads_;
    how.until = scene.until_;
    if (scene.controller_) {
      how.change = [&](World& world) { world.control = controlBy(scene.period_, scene.controller_, world); };
    }
    return std::make_shared<Data>(simulateScene(SceneText{.text = scene.text(), .name = scene.name()}, how));
  });
}

Run Run::read(const std::filesystem::path& path, const std::filesystem::path& scene) {
  const DefaultFloatEnvironment usual;
  return Run(translated(path.string(), [&] {
    const RunReading reading{.scene = scene.empty() ? std::nullopt : std::optional(scene)};
    return std::make_shared<Data>(careen::Run{.source = path, .trajectory = readRun(path, reading)});
  }));
}

void Run::save(const std::filesystem::path& path) const {
  translated(path.string(), [&] { saveTrajectory(data_->trajectory, path); });
}

double Run::duration() const { return data_->trajectory.settings.duration; }

const std::vector<std::string>& Run::boxes() const { return data_->names; }

const std::vector<Impact>& Run::impacts() const { return data_->impacts; }

State Run::state(std::size_t box, double time) const {
  if (box >= data_->names.size()) {
    throw Error("found box " + std::to_string(box) + ", expected less than " +
                std::to_string(data_->names.size()));
  }
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    const PoseRow row = poseRow(data_->trajectory, box, time);
    const Quat& q = row.worldFromBody;
    return State{.position = vectorOf(row.position),
                 .orientation = {q.w(), q.x(), q.y(), q.z()},
                 .velocity = vectorOf(row.velocity),
                 .angularVelocity = vectorOf(row.angularVelocity)};
  });
}

Energy Run::energy(double time) const { return energies({time}).front(); }

std::vector<Energy> Run::energies(const std::vector<double>& times) const {
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // A time that is no number is before all others, where it is refused.
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return std::isnan(times[i]) ? !std::isnan(times[j]) : times[i] < times[j];
    });
    std::vector<Energy> found(times.size());
    EnergySamples samples(data_->trajectory);
    for (const std::size_t k : order) {
      const RunEnergies now = samples.at(times[k]);
      found[k] = {.translation = now.shares.translation,
                  .rotation = now.shares.rotation,
                  .gravity = now.shares.gravity,
                  .springs = now.shares.springs,
                  .jointSprings = now.shares.jointSprings,
                  .total = now.shares.sum(),
                  .motors = now.motors,
                  .changes = now.changes,
                  .impacts = now.lost.impacts,
                  .jointFriction = now.lost.jointFriction,
                  .damping = now.lost.damping,
                  .drag = now.lost.drag,
                  .remaining = now.remaining,
                  .momentum = vectorOf(now.momentum),
                  .angularMomentum = vectorOf(now.angularMomentum)};
    }
    return found;
  });
}

std::vector<Force> Run::forces(double time) const { return forces(std::vector{time}); }

std::vector<Force> Run::forces(const std::vector<double>& times) const {
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    const Trajectory& run = data_->trajectory;
    std::vector<Force> found;
    const ForceSamples samples(run);
    for (const double time : times) {
      for (const ContactPush& push : samples.at(time)) {
        found.push_back({.time = time,
                         .a = run.world.bodies[static_cast<std::size_t>(push.a.value)].name,
                         .b = careen::partnerName(run, push),
                         .point = vectorOf(push.point),
                         .normal = vectorOf(push.normal),
                         .force = vectorOf(push.force),
                         .left = push.left});
      }
    }
    return found;
  });
}

Audit Run::audit() const {
  return translated("", [&] {
    const careen::Audit& found = data_->audited().audit;
    Audit audit;
    for (const AuditKindTraits& kind : kAuditKinds) {
      const careen::AuditFigure& figure = found.figure(kind.kind);
      audit.figures.push_back({.kind = std::string(kind.name),
                               .unit = std::string(kind.unit),
                               .size = figure.size,
                               .time = figure.time,
                               .bodies = figure.bodies,
                               .promised = figure.promised});
    }
    for (const AuditBreach& breach : found.breaches) {
      audit.breaches.push_back(describe(breach, data_->trajectory));
    }
    return audit;
  });
}

std::optional<ErrorEstimate> Run::estimateError() const {
  const DefaultFloatEnvironment usual;
  return translated("", [&]() -> std::optional<ErrorEstimate> {
    if (data_->trajectory.given) {
      return std::nullopt;
    }
    const std::optional<careen::ErrorEstimate> found = careen::estimateError(data_->trajectory);
    return found ? std::optional(ErrorEstimate{.position = found->position,
                                               .angle = found->angle,
                                               .until = found->until,
                                               .holds = found->holds})
                 : std::nullopt;
  });
}

std::string Run::report() const {
  return translated("", [&] {
    const careen::Run& run = data_->audited();
    return runReportText(run, run.simulateSeconds + run.auditSeconds);
  });
}

std::vector<double> Run::when(const std::string& statement) const {
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    std::vector<double> times;
    for (const Moment& moment :
         moments(data_->trajectory, readQuestion(statement, data_->trajectory.world))) {
      times.push_back(moment.time);
    }
    return times;
  });
}

std::string Run::hash() const { return data_->trajectory.stateHash(); }

}  // namespace careen::v1
