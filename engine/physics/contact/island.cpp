#include "physics/contact/island.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/world/forces.h"

// The course of an island: modes, steps and what ends them. A step alone is in island_steps.cpp.

namespace careen {
namespace {

using Mode = ContactForces::Mode;
using Kind = ContactFeature::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Slip of less than this many tolerances, in the time to fall one's own size, counts as stopped.
constexpr double kStopped = 4;
/// [1] of a tolerance, in the time to fall one's own size: slip that counts as none where contacts are found
/// anew.
constexpr double kCreeps = 0.25;
/// [1] Accelerations this small relative to what pulls count as zero: rounding errors. A box on its edge that
/// leans by 1e-12 has more.
constexpr double kStill = 0x1p-42;
/// [1] The same relative to the accelerations by contact forces beyond those that carry a body alone.
constexpr double kStillLoaded = 0x1p-40;
/// [1] of a time step: the shortest smooth step. Where slip begins, friction turns into its direction the
/// faster the slower the slip is (stiff), and smooth steps would have to resolve that; a time step, implicit
/// in friction, has an error below the tolerance there.
constexpr double kStiff = 0x1p-4;
/// [1] of the shortest smooth step: no step has an end as near.
constexpr double kNoTime = 0x1p-56;
/// [1] of the current accelerations: a contact with no more tension than this is about to open.
constexpr double kTension = 0x1p-20;
/// [1] of the error allowed per step: a step that ends at an event may have a little more.
constexpr double kMostLocated = 4;
constexpr int kMostAttempts = 60;
constexpr int kMostHalvings = 20;

// [s] In which springs move a body by the tolerance from the start; infinite if none pulls.
double timeUnderSprings(const World& world, double tolerance) {
  double time = kInfinity;
  if (world.springs.empty()) {
    return time;
  }
  for (const double acceleration : accelerationsAtStart(world)) {
    time = acceleration > 0 ? std::min(time, std::sqrt(tolerance / acceleration)) : time;
  }
  return time;
}

}  // namespace

double timeScaleOf(const World& world, double tolerance) {
  const double gravity = world.gravity.norm();
  if (gravity > 0) {
    return std::sqrt(tolerance / gravity);
  }
  double scale = kInfinity;
  for (const Body& body : world.bodies) {
    const double radius = radiusOf(body);
    const double speed =
        body.initial.velocity.norm() + radius * angularVelocity(body.mass, body.initial).norm();
    scale = speed > 0 ? std::min(scale, std::sqrt(tolerance * radius) / speed) : scale;
  }
  return std::min(scale, timeUnderSprings(world, tolerance));
}

Island::Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
               double tolerance, double timeScale)
    : tolerance_(tolerance),
      timeScale_(timeScale),
      world_(world),
      system_(world, std::move(bodies), std::move(features)),
      springs_(world, system_.bodies()) {
  end_ = system_.pack();
}

void Island::begin() {
  stepper_.reset();
  timeStepsLeft_ = 0;
  system_.look(end_);
  for (std::size_t c = 0; c < system_.modes().size(); ++c) {
    const bool isChoice = system_.features()[c].axes != 0;  // it may not have to push
    system_.modes()[c] = isChoice ? Mode::kOff : creeps(c) ? Mode::kStick : Mode::kOn;
  }
  system_.projectVelocities(end_);
  smooth_ = system_.findModes(end_);
  if (smooth_ && system_.projectVelocities(end_)) {  // removes the rest of the slip of sticking contacts
    smooth_ = system_.findModes(end_);
  }
  if (smooth_ && stop()) {
    smooth_ = system_.findModes(end_);
  }
  system_.unpack(end_);
  known_ = false;
  listEventFunctions();
}

bool Island::pushes() const {
  return std::any_of(system_.modes().begin(), system_.modes().end(),
                     [](Mode mode) { return mode != Mode::kOff; });
}

bool Island::dropIdle(std::vector<ContactFeature>& features) const {
  if (!smooth_ || timeStepsLeft_ > 0) {
    return false;
  }
  std::size_t c = 0;
  return std::erase_if(features, [&](const ContactFeature& feature) {
           return !system_.pushes(c++) && feature.axes != 0;
         }) > 0;
}

// Some contact force is tensile, and its friction would drive the slip: the modes found are inconsistent.
bool Island::hasTension() const {
  for (std::size_t w = 0; w < eventFunctions_.size(); ++w) {
    if (eventFunctions_[w].kind == EventFunction::Kind::kPush &&
        atStart_[w] < -kTension * system_.forces().scale()) {
      return true;
    }
  }
  return false;
}

// All contacts are open for good: the bodies are in free flight.
bool Island::isClear() const {
  const std::vector<ContactFeature>& features = system_.features();
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (system_.pushes(c) ||
        system_.states()[c].gap < kTouching * touching(static_cast<std::size_t>(features[c].a))) {
      return false;
    }
  }
  return !features.empty();
}

bool Island::mayLose() const {
  const std::vector<ContactFeature>& features = system_.features();
  return tookTimeStep_ || world_.drag ||
         std::any_of(world_.springs.begin(), world_.springs.end(),
                     [](const Spring& spring) { return spring.damping > 0; }) ||
         std::any_of(features.begin(), features.end(),
                     [](const ContactFeature& feature) { return feature.material.friction > 0; });
}

// [m/s²] The largest acceleration of a body by the forces of its contacts, all in one direction: their
// rounding errors accelerate too.
double Island::load() const {
  std::vector<double> loads(bodies().size(), 0.0);
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    const ContactFeature& feature = system_.features()[c];
    const auto add = [&](std::size_t body) {
      loads[body] += system_.forces().forces()[c][0] * bodies()[body].body->mass.inverseMass;
    };
    add(static_cast<std::size_t>(feature.a));
    if (!feature.b.isWall()) {
      add(static_cast<std::size_t>(feature.b.body()));
    }
  }
  return loads.empty() ? 0 : *std::max_element(loads.begin(), loads.end());
}

bool Island::rests() const {
  if (!smooth_) {
    return false;
  }
  const double still = std::max(kStill * system_.pull(), kStillLoaded * (load() - system_.pull()));  // [m/s²]
  std::size_t m = 0;
  for (const TouchingBody& body : bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const double radius = radiusOf(*body.body);
    const double* a = &system_.forces().accelerations()[m * ContactForces::kAxes];
    const double linear = Vec3(a[0], a[1], a[2]).norm();
    const double turning = Vec3(a[3], a[4], a[5]).norm() * radius;
    const double speed = std::max(body.velocity.norm(), body.angularVelocityBody.norm() * radius);
    if (speed > system_.restSpeed() || std::max(linear, turning) > still) {
      return false;
    }
    ++m;
  }
  return true;
}

bool Island::allButStands(std::size_t contact) const {
  const double speed = system_.states()[contact].slip.norm();
  const double rate = system_.slipSpeedRate(contact);
  return speed > 0 && rate < 0 && speed <= kStopped * tolerance_ * std::sqrt(-rate / system_.radius());
}

// Slip this slow is what time steps and impacts leave of sticking contacts: its direction means nothing, and
// friction would end it at once.
bool Island::creeps(std::size_t contact) const {
  return system_.features()[contact].material.friction > 0 &&
         system_.states()[contact].slip.norm() <=
             kCreeps * tolerance_ * std::sqrt(system_.pull() / system_.radius());
}

// Stops slip that has nearly ended: integrated up to its end it would take ever shorter steps.
bool Island::stop() {
  const std::vector<Mode> kept = system_.modes();
  bool stopped = false;
  for (std::size_t c = 0; c < kept.size(); ++c) {
    if (kept[c] == Mode::kSlip && allButStands(c)) {
      system_.modes()[c] = Mode::kStick;
      stopped = true;
    }
  }
  if (stopped) {
    system_.projectVelocities(end_);
    system_.modes() = kept;
  }
  return stopped;
}

Island::Step Island::step(double most, double mostWork) {
  mostWork_ = mostWork;
  start_ = end_;
  if (!smooth_ || timeStepsLeft_ > 0) {
    return takeTimeStep(most);
  }
  tookTimeStep_ = false;
  stepper_.reset();
  if (pushes()) {
    springs_.end();
  } else {
    springs_.begin(start_);
  }
  if (known_) {
    startRate_ = endRate_;
    startTurned_ = endTurned_;
    system_.look(start_);
  } else if (!system_.rate(start_, startRate_)) {
    return takeTimeStep(most);
  } else {
    startTurned_ = system_.forces().isTurned();
  }
  noteStart();
  if (hasTension()) {
    return takeTimeStep(most);
  }
  away_ = awayFromEquilibrium();
  double h = std::min(most, longestStep());
  if (proposed_ > 0) {
    h = std::min(h, proposed_);
  }
  double error = 0;
  int attempts = 0;
  // Undamped springs that nothing pushes against may be as stiff as they are: a time step would damp them.
  const bool isSpring = !springs_.empty() && !pushes();
  const double shortest = std::isfinite(timeScale_) && !isSpring ? kStiff * timeScale_ : 0;
  for (;; ++attempts) {
    if (attempts > kMostAttempts || (attempts > 0 && h < shortest)) {
      end_ = start_;
      return takeTimeStep(most);
    }
    const bool found = try5(h);
    error = sizeOf(error_, h);
    if (found && error <= 1) {
      const double between = errorBetween(h);
      if (between <= 1) {
        break;
      }
      h *= std::max(0.2, 0.9 / std::sqrt(std::sqrt(between)));
      continue;
    }
    h *= found && error < 1e10 ? std::max(0.2, 0.9 / std::sqrt(std::sqrt(error))) : 0.2;
  }
  proposed_ = h * (error > 1e-4 ? std::clamp(0.9 / std::sqrt(std::sqrt(error)), 0.2, 4.0) : 4.0);
  finish(h);
  Step done{.length = h};
  locate(done);
  // Where forces grow fast the polynomials between both ends may leave the contacts that hold at them.
  const auto jumps = [&] {
    return done.length < h &&
           (done.length < kNoTime * shortest || (done.length < shortest && isMovedByCorrection(done.length)));
  };
  for (int halvings = 0; halvings < kMostHalvings && !jumps() && dips(done.length); ++halvings) {
    done = {.length = 0.5 * done.length};
    restep(done.length);
    locate(done);
  }
  // If the event was located past a moment where forces cease to exist, the end state means nothing, or its
  // accelerations are so large that the polynomial between swings. If contacts contradict each other, what
  // parts some makes others deeper, at every moment anew.
  const bool swings =
      done.length < h && ((done.end == End::kChanges && sizeOf(error_, done.length) > kMostLocated) ||
                          errorBetween(done.length) > kMostLocated);
  if (swings || jumps() || gainsEnergy()) {
    end_ = start_;
    return takeTimeStep(most);
  }
  if (done.end == End::kGoesOn && (stop() || isClear())) {
    done.end = End::kChanges;
  }
  length_ = done.length;
  system_.unpack(end_);
  if (done.end == End::kGoesOn && rests()) {
    done.end = End::kChanges;
  }
  known_ = done.end == End::kGoesOn;
  for (const ContactState& state : system_.states()) {
    deepest_ = std::max(deepest_, -state.gap);
  }
  return done;
}

void Island::cutTo(double length) {
  if (tookTimeStep_) {
    stepper_->cutTo(length);
    adopt();
    return;
  }
  restep(length);
  length_ = length;
  known_ = false;
  system_.unpack(end_);
}

ContactResiduals Island::takeResiduals() {
  ContactResiduals all = system_.takeResiduals();
  if (stepper_) {
    all.add(stepper_->takeResiduals());
  }
  return all;
}

}  // namespace careen
