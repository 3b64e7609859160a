#include "physics/contact/island.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/geometry/separation.h"

namespace careen {
namespace {

using Mode = ContactForces::Mode;
using Kind = ContactFeature::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// [1] of the tolerance: the error allowed per step, since errors of many steps add up.
constexpr double kShare = 0x1p-4;
/// [rad] Largest rotation in one step, so that the polynomials are accurate.
constexpr double kMostTurn = 0.4;
/// [1] of the smallest half extent: how far two bodies may slip on each other in one step.
constexpr double kMostSlip = 0.25;
/// [1] Steps end short of the moment where slip would end: past it the equations change.
constexpr double kBeforeStop = 1 - 0x1p-10;
/// [1] of the time until its slip ends: how long the speed of a single sliding body matters.
constexpr double kLifetime = 4;
/// Slip of less than this many tolerances, in the time to fall one's own size, counts as stopped.
constexpr double kStopped = 16;
/// [1] Accelerations this small relative to gravity count as zero.
constexpr double kStill = 0x1p-32;
/// [1] The same relative to the accelerations by the contact forces.
constexpr double kStillLoaded = 0x1p-40;
/// [1] of a time step: the shortest smooth step. Where slip begins, friction turns into its direction the
/// faster the slower the slip is (stiff), and smooth steps would have to resolve that; a time step, implicit
/// in friction, has an error below the tolerance there.
constexpr double kStiff = 0x1p-4;
/// [1] of the current accelerations: a contact with no more tension than this is about to open.
constexpr double kTension = 0x1p-20;
/// [1] of the error allowed per step: a step that ends at an event may have a little more.
constexpr double kMostLocated = 4;
constexpr int kMostAttempts = 60;

Vec3 threeAt(const DormandPrince5::State& y, std::size_t at) { return {y[at], y[at + 1], y[at + 2]}; }

}  // namespace

double timeStepOf(const World& world, double tolerance) {
  const double gravity = world.gravity.norm();
  return gravity > 0 ? std::sqrt(tolerance / gravity) : kInfinity;
}

Island::Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
               double tolerance)
    : tolerance_(tolerance), world_(world), system_(world, std::move(bodies), std::move(features)) {
  end_ = system_.pack();
}

void Island::begin(Stepping stepping) {
  smooth_ = stepping == Stepping::kSmooth;
  if (smooth_) {
    std::fill(system_.modes().begin(), system_.modes().end(), Mode::kOn);
    system_.projectVelocities(end_);
    smooth_ = system_.findModes(end_);
    if (smooth_ && system_.projectVelocities(end_)) {  // removes the rest of the slip of sticking contacts
      smooth_ = system_.findModes(end_);
    }
    if (smooth_ && stop()) {
      smooth_ = system_.findModes(end_);
    }
    system_.unpack(end_);
  }
  known_ = false;
  listEventFunctions();
}

bool Island::pushes() const {
  return std::any_of(system_.modes().begin(), system_.modes().end(),
                     [](Mode mode) { return mode != Mode::kOff; });
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

bool Island::rests() const {
  if (!smooth_) {
    return false;
  }
  std::size_t m = 0;
  for (const TouchingBody& body : bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const double radius = body.body->halfExtents.norm();
    const double* a = &system_.forces().accelerations()[m * ContactForces::kAxes];
    const double linear = Vec3(a[0], a[1], a[2]).norm();
    const double turning = Vec3(a[3], a[4], a[5]).norm() * radius;
    const double speed = std::max(body.velocity.norm(), body.angularVelocityBody.norm() * radius);
    double load = 0;  // [m/s²] by the contact forces, whose rounding error accelerates too
    for (std::size_t c = 0; c < system_.features().size(); ++c) {
      const ContactFeature& feature = system_.features()[c];
      if (&bodies()[static_cast<std::size_t>(feature.a)] == &body ||
          (!feature.b.isWall() && &bodies()[static_cast<std::size_t>(feature.b.body())] == &body)) {
        load += system_.forces().forces()[c][0] * body.body->mass.inverseMass;
      }
    }
    if (speed > system_.restSpeed() ||
        std::max(linear, turning) > std::max(kStill * system_.gravityMagnitude(), kStillLoaded * load)) {
      return false;
    }
    ++m;
  }
  return true;
}

// ---- Steps.

double Island::longestStep() {
  double most = kInfinity;
  const bool alone = end_.size() == ContactSystem::kNumbers;
  lifetime_ = kInfinity;
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    const double turning = system_.kinematics(i).angularVelocity.norm();
    if (turning > 0) {
      most = std::min(most, kMostTurn / turning);
    }
  }
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    const double speed = system_.states()[c].slip.norm();
    if (speed > 0 && system_.features()[c].kind != Kind::kPointOnWall) {
      const auto a = static_cast<std::size_t>(system_.features()[c].a);
      const auto b = static_cast<std::size_t>(system_.features()[c].b.body());
      most = std::min(most, kMostSlip *
                                std::min(bodies()[a].body->halfExtents.minCoeff(),
                                         bodies()[b].body->halfExtents.minCoeff()) /
                                speed);
    }
    if (system_.modes()[c] == Mode::kSlip) {
      const double rate = system_.slipSpeedRate(c);
      if (speed > system_.restSpeed() && rate < 0) {
        most = std::min(most, kBeforeStop * speed / -rate);
        lifetime_ = alone ? std::min(lifetime_, kLifetime * speed / -rate) : lifetime_;
      }
    }
  }
  return most;
}

bool Island::try5(double h) {
  bool found = true;
  const auto rate = [&](const State& y, State& dy) { found = system_.rate(y, dy) && found; };
  integrator_.step(start_, startRate_, h, rate, end_);
  rate(end_, endRate_);
  integrator_.error(h, endRate_, error_);
  return found;
}

void Island::restep(double h) {
  // Constant accelerations; the correction by projection at the end is spread with the square of time.
  if (tookTimeStep_) {
    const double part = h / length_;
    for (std::size_t k = 0; k < end_.size(); ++k) {
      const double steady = startRate_[k] + endRate_[k];
      end_[k] = start_[k] + part * part * (timeStepEnd_[k] - start_[k] - 0.5 * length_ * steady) +
                h * (startRate_[k] + 0.5 * part * (endRate_[k] - startRate_[k]));
    }
    system_.projectPositions(end_);
    system_.look(end_);
    return;
  }
  if (h > 0) {
    try5(h);
  } else {
    end_ = start_;
    endRate_ = startRate_;
  }
  finish();
}

void Island::finish() {
  for (std::size_t at = 3; at < end_.size(); at += ContactSystem::kNumbers) {
    const double size = std::sqrt(end_[at] * end_[at] + end_[at + 1] * end_[at + 1] +
                                  end_[at + 2] * end_[at + 2] + end_[at + 3] * end_[at + 3]);
    for (std::size_t k = at; k < at + 4; ++k) {
      end_[k] /= size;
    }
  }
  if (system_.project(end_)) {
    system_.rate(end_, endRate_);
  }
}

// The error of a step relative to the error allowed: of positions directly, of velocities by the displacement
// they cause in the time in which the body would fall its own size, or until it has stopped.
double Island::sizeOf(const State& difference, double h) const {
  double worst = 0;
  std::size_t at = 0;
  for (const TouchingBody& body : bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const double radius = body.body->halfExtents.norm();
    const double time = system_.gravityMagnitude() > 0
                            ? std::max(h, std::min(std::sqrt(radius / system_.gravityMagnitude()), lifetime_))
                            : h;
    const Vec4 turn(difference[at + 3], difference[at + 4], difference[at + 5], difference[at + 6]);
    worst = std::max({worst, threeAt(difference, at).norm(), 2 * radius * turn.norm(),
                      time * threeAt(difference, at + 7).norm(),
                      time * radius * threeAt(difference, at + 10).norm()});
    at += ContactSystem::kNumbers;
  }
  return worst / (kShare * tolerance_);
}

bool Island::allButStands(std::size_t contact) const {
  const double speed = system_.states()[contact].slip.norm();
  const double rate = system_.slipSpeedRate(contact);
  return speed > 0 && rate < 0 && speed <= kStopped * tolerance_ * std::sqrt(-rate / system_.radius());
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

Island::Step Island::takeTimeStep(double most) {
  tookTimeStep_ = true;
  known_ = false;
  length_ = std::min(most, timeStepOf(world_, tolerance_));
  system_.look(start_);
  noteStart();
  system_.takeImpulseStep(end_, length_);
  system_.look(end_);
  endTimeStep(length_);
  Step done{.length = length_};
  locate(done);
  done.end = End::kChanges;
  endTimeStep(done.length);
  system_.unpack(end_);
  return done;
}

// Makes start_ to end_ the time step.
void Island::endTimeStep(double length) {
  length_ = length;
  timeStepEnd_ = end_;
  if (!(length_ > 0)) {
    return;
  }
  startRate_.assign(start_.size(), 0);
  endRate_.assign(start_.size(), 0);
  for (std::size_t at = 0; at < start_.size(); at += ContactSystem::kNumbers) {
    const auto fill = [&](const State& y, State& dy) {
      const Quat q(y[at + 3], y[at + 4], y[at + 5], y[at + 6]);
      const Quat turning = q * Quat(0, y[at + 10], y[at + 11], y[at + 12]);
      const std::array<double, 4> rates{turning.w(), turning.x(), turning.y(), turning.z()};
      for (std::size_t k = 0; k < 3; ++k) {
        dy[at + k] = y[at + 7 + k];
        dy[at + 7 + k] = (end_[at + 7 + k] - start_[at + 7 + k]) / length_;
        dy[at + 10 + k] = (end_[at + 10 + k] - start_[at + 10 + k]) / length_;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        dy[at + 3 + k] = 0.5 * rates[k];
      }
    };
    fill(start_, startRate_);
    fill(end_, endRate_);
  }
}

Island::Step Island::step(double most) {
  start_ = end_;
  tookTimeStep_ = false;
  if (!smooth_) {
    return takeTimeStep(most);
  }
  if (known_) {
    startRate_ = endRate_;
    system_.look(start_);
  } else if (!system_.rate(start_, startRate_)) {
    return takeTimeStep(most);
  }
  noteStart();
  if (hasTension()) {
    return takeTimeStep(most);
  }
  double h = std::min(most, longestStep());
  if (proposed_ > 0) {
    h = std::min(h, proposed_);
  }
  double error = 0;
  int attempts = 0;
  for (;; ++attempts) {
    if (attempts > kMostAttempts ||
        (attempts > 0 && system_.gravityMagnitude() > 0 && h < kStiff * timeStepOf(world_, tolerance_))) {
      end_ = start_;
      return takeTimeStep(most);
    }
    const bool found = try5(h);
    error = sizeOf(error_, h);
    if (found && error <= 1) {
      break;
    }
    h *= found && error < 1e10 ? std::max(0.2, 0.9 / std::sqrt(std::sqrt(error))) : 0.2;
  }
  proposed_ = h * (error > 1e-4 ? std::clamp(0.9 / std::sqrt(std::sqrt(error)), 0.2, 4.0) : 4.0);
  finish();
  Step done{.length = h};
  locate(done);
  // If the event was located past a moment where forces cease to exist, the end state means nothing.
  if (done.end == End::kChanges && sizeOf(error_, done.length) > kMostLocated) {
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
  restep(length);
  length_ = length;
  if (tookTimeStep_) {
    endTimeStep(length);
  }
  known_ = false;
  system_.unpack(end_);
}

ContactStep Island::motion(std::size_t body, double h) const {
  const std::size_t at = system_.placeOf(body) * ContactSystem::kNumbers;
  ContactStep step{.duration = h > 0 ? h : 1};
  const auto hermite = [h](const auto& p0, const auto& v0, const auto& a0, const auto& p1, const auto& v1,
                           const auto& a1, auto& c) {
    using Vector = std::decay_t<decltype(c[0])>;
    const Vector d = p1 - p0;
    c[0] = p0;
    c[1] = h * v0;
    c[2] = (0.5 * h * h) * a0;
    c[3] = 10 * d - h * (6 * v0 + 4 * v1) - (h * h) * (1.5 * a0 - 0.5 * a1);
    c[4] = -15 * d + h * (8 * v0 + 7 * v1) + (h * h) * (1.5 * a0 - a1);
    c[5] = 6 * d - h * (3 * v0 + 3 * v1) - (h * h) * (0.5 * a0 - 0.5 * a1);
  };
  hermite(threeAt(start_, at), threeAt(startRate_, at), threeAt(startRate_, at + 7), threeAt(end_, at),
          threeAt(endRate_, at), threeAt(endRate_, at + 7), step.position);
  struct Turn {
    Vec4 value;
    Vec4 rate;
    Vec4 acceleration;
  };
  const auto turn = [at](const State& y, const State& dy) {
    const auto quat = [](const State& from, std::size_t k) {
      return Quat(from[k], from[k + 1], from[k + 2], from[k + 3]);
    };
    const auto pure = [](const Vec3& v) { return Quat(0, v[0], v[1], v[2]); };
    const Vec4 bent = (quat(dy, at + 3) * pure(threeAt(y, at + 10))).coeffs() +
                      (quat(y, at + 3) * pure(threeAt(dy, at + 10))).coeffs();
    return Turn{quat(y, at + 3).coeffs(), quat(dy, at + 3).coeffs(), 0.5 * bent};
  };
  const Turn from = turn(start_, startRate_);
  const Turn to = turn(end_, endRate_);
  hermite(from.value, from.rate, from.acceleration, to.value, to.rate, to.acceleration, step.worldFromBody);
  return step;
}

}  // namespace careen
