#include "library/careen.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <span>
#include <utility>

#include "audit/audit.h"
#include "core/error.h"
#include "core/math/arithmetic.h"
#include "core/system/file.h"
#include "library/translated.h"
#include "physics/world/control.h"
#include "physics/world/method.h"
#include "question/moments.h"
#include "scene/prepare.h"
#include "scene/scene_reader.h"
#include "trajectory/energy_samples.h"
#include "trajectory/force_samples.h"
#include "trajectory/pose_samples.h"
#include "trajectory/trajectory.h"
#include "trajectory/trajectory_file.h"
#ifdef CAREEN_RENDER
#include "render/film/film_pictures.h"
#endif

namespace careen::v1 {
namespace {

Vector vectorOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

const char* version() { return "careen " CAREEN_VERSION; }

struct Run::Data {
  explicit Data(Trajectory run) : trajectory(std::move(run)) {
    for (const Body& body : trajectory.world.bodies) {
      names.push_back(body.name);
    }
    for (const careen::Impact& each : trajectory.impacts) {
      impacts.push_back({.time = each.time,
                         .a = trajectory.world.bodies.at(static_cast<std::size_t>(each.a.value)).name,
                         .b = trajectory.partnerName(each),
                         .point = vectorOf(each.point),
                         .normal = vectorOf(each.normal),
                         .approach = each.approach,
                         .impulse = each.impulse,
                         .tangential = each.tangential});
    }
  }

  Trajectory trajectory;
  std::vector<std::string> names;
  std::vector<Impact> impacts;
};

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
  const DefaultFloatEnvironment usual;
  data_ = translated(scene.name(), [&] {
    const RunOverrides overrides{.method = scene.method_ ? methodNamed(*scene.method_) : std::nullopt,
                                 .tolerance = scene.tolerance_,
                                 .threads = scene.threads_};
    RunSetup setup = prepare(parseScene(scene.text(), scene.name()), overrides).setup;
    if (scene.controller_) {
      setup.world.control = controlBy(scene.period_, scene.controller_, setup.world);
    }
    return std::make_shared<Data>(record(setup));
  });
}

Run Run::read(const std::filesystem::path& path) {
  return Run(translated(path.string(), [&] {
    return std::make_shared<Data>(decodeTrajectory(readFile(path), path.string()));
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
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    const careen::Audit found = careen::audit(data_->trajectory, AuditDepth::kUsual);
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

#ifdef CAREEN_RENDER
namespace {

// Of the process: GL is current to one thread at a time, and the size of a run's pictures stands in the run.
std::mutex& drawing() {
  static std::mutex mutex;
  return mutex;
}

// Sets the size for as long as it lives.
class OfSize {
 public:
  OfSize(PictureSettings& picture, const std::optional<std::array<int, 2>>& size)
      : picture_(picture), before_(picture) {
    if (!size) {
      return;
    }
    for (const int side : *size) {
      if (side < 1 || side > kLargestFilm) {
        throw Error("found a picture of " + std::to_string((*size)[0]) + "x" + std::to_string((*size)[1]) +
                    ", expected 1 to " + std::to_string(kLargestFilm) + " px each");
      }
    }
    picture_.width = (*size)[0];
    picture_.height = (*size)[1];
  }
  ~OfSize() { picture_ = before_; }
  OfSize(const OfSize&) = delete;
  OfSize& operator=(const OfSize&) = delete;

 private:
  PictureSettings& picture_;
  PictureSettings before_;
};

}  // namespace

std::vector<Image> Run::frames(const std::vector<double>& filmTimes,
                               std::optional<std::array<int, 2>> size) const {
  const std::scoped_lock alone(drawing());
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    Trajectory& run = data_->trajectory;
    const OfSize sized(run.stage.picture, size);
    FilmPictures pictures(run);
    const double duration = pictures.duration();
    for (const double time : filmTimes) {
      if (!(time >= 0 && time <= duration)) {
        throw Error("found the moment " + std::to_string(time) + " s, expected one of the film, from 0 to " +
                    std::to_string(duration) + " s");
      }
    }
    pictures.makeOverlays();
    pictures.open({});
    std::vector<Image> images;
    for (const double time : filmTimes) {
      Picture drawn = pictures.draw(time);
      images.push_back({.width = drawn.width, .height = drawn.height, .rgb = std::move(drawn.rgb)});
    }
    return images;
  });
}
#else
std::vector<Image> Run::frames(const std::vector<double>& /*filmTimes*/,
                               std::optional<std::array<int, 2>> /*size*/) const {
  throw Error("this build of careen draws nothing (CAREEN_RENDER=OFF)");
}
#endif

Image Run::frame(double filmTime, std::optional<std::array<int, 2>> size) const {
  return frames({filmTime}, size).front();
}

}  // namespace careen::v1
