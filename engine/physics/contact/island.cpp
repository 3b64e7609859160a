#include "physics/contact/island.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact/three_at.h"
#include "physics/geometry/separation.h"
#include "physics/motion/hermite_step.h"

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
/// [1] of a tolerance, in the time to fall one's own size: slip that counts as none where contacts are found
/// anew.
constexpr double kCreeps = 0.25;
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
/// [1] of the energy of motion: a step that gains more is wrong.
constexpr double kGained = 0x1p-4;
/// A trial step too long for its forces diverges; squares of larger numbers would overflow.
constexpr double kDiverged = 0x1p200;
constexpr int kMostAttempts = 60;
constexpr int kMostHalvings = 20;

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
  return scale;
}

Island::Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
               double tolerance)
    : tolerance_(tolerance), world_(world), system_(world, std::move(bodies), std::move(features)) {
  end_ = system_.pack();
}

void Island::begin() {
  stepper_.reset();
  timeStepsLeft_ = 0;
  system_.look(end_);
  for (std::size_t c = 0; c < system_.modes().size(); ++c) {
    system_.modes()[c] = creeps(c) ? Mode::kStick : Mode::kOn;
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
    const double radius = radiusOf(*body.body);
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
  const auto rate = [&](const State& y, State& dy) {
    if (std::any_of(y.begin(), y.end(), [](double each) { return !(std::fabs(each) < kDiverged); })) {
      dy.assign(y.size(), 0.0);
      found = false;
      return;
    }
    found = system_.rate(y, dy) && found;
  };
  integrator_.step(start_, startRate_, h, rate, end_);
  rate(end_, endRate_);
  integrator_.error(h, endRate_, error_);
  return found;
}

void Island::restep(double h) {
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
  if (system_.project(end_, ContactSystem::kMostMoved * tolerance_)) {
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
    const double radius = radiusOf(*body.body);
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

// The motions of the last step, of that length, of the bodies that move.
std::vector<ContactStep> Island::motions(double h) const {
  std::vector<ContactStep> path;
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    if (!bodies()[i].isHeld()) {
      path.push_back(motion(i, h));
    }
  }
  return path;
}

Island::State Island::stateWithin(std::span<const ContactStep> path, double time) const {
  State state;
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    if (bodies()[i].isHeld()) {
      continue;
    }
    const MassProperties& mass = bodies()[i].body->mass;
    const BodyState at = stateAt(Motion(path[system_.placeOf(i)]), mass, time);
    const Quat turned(at.pose.worldFromBody);
    const Vec3 spin = mass.inverseInertiaTimes(at.pose.worldFromBody.transpose() * at.angularMomentum);
    for (const Vec3& part : {at.pose.position, Vec3(turned.w(), turned.x(), turned.y())}) {
      state.insert(state.end(), part.begin(), part.end());
    }
    state.push_back(turned.z());
    for (const Vec3& part : {at.velocity, spin}) {
      state.insert(state.end(), part.begin(), part.end());
    }
  }
  return state;
}

// The error of the motion halfway through a step, relative to the error allowed. The polynomial has the right
// accelerations at both ends; halfway they differ by e, and where that goes with t³(h − t)³ the position
// there differs by e h²/24.
double Island::errorBetween(double h) {
  double fastest = 0;  // [m/s²]
  for (std::size_t at = 7; at < end_.size(); at += ContactSystem::kNumbers) {
    fastest = std::max({fastest, threeAt(startRate_, at).norm(), threeAt(endRate_, at).norm()});
  }
  if (fastest * h * h < tolerance_) {
    return 0;
  }
  const std::vector<ContactStep> path = motions(h);
  State rate;
  system_.rate(stateWithin(path, 0.5 * h), rate);
  double worst = 0;
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    if (!bodies()[i].isHeld()) {
      const std::size_t at = system_.placeOf(i) * ContactSystem::kNumbers;
      const std::array<Vec3, 6>& c = path[system_.placeOf(i)].position;
      const Vec3 bend = 2 * c[2] + 3 * c[3] + 3 * c[4] + 2.5 * c[5];  // h² times the acceleration halfway
      worst = std::max(worst, (h * h * threeAt(rate, at + 7) - bend).norm());
    }
  }
  system_.rate(end_, endRate_);  // event functions are those of the end
  return worst / 24 / tolerance_;
}

// Contacts give no energy. A step that gained some passed a moment at which the forces are without bound, in
// a wedge for one, and went on with forces that pull.
bool Island::gainsEnergy() const {
  if (!world_.springs.empty()) {
    return false;
  }
  double motion = 0;  // [J] before and after
  double gained = 0;  // [J] not by gravity
  double weight = 0;  // [N]
  std::size_t at = 0;
  for (const TouchingBody& body : bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const MassProperties& mass = body.body->mass;
    const auto energy = [&](const State& y) {
      const Vec3 spin = threeAt(y, at + 10);
      return 0.5 * (mass.mass * threeAt(y, at + 7).squaredNorm() + spin.dot(mass.inertiaTimes(spin)));
    };
    const double before = energy(start_);
    const double after = energy(end_);
    motion += before + after;
    gained += after - before - mass.mass * world_.gravity.dot(threeAt(end_, at) - threeAt(start_, at));
    weight += mass.mass * system_.gravityMagnitude();
    at += ContactSystem::kNumbers;
  }
  return gained > kGained * motion + weight * tolerance_;
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
             kCreeps * tolerance_ * std::sqrt(system_.gravityMagnitude() / system_.radius());
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

Island::Step Island::step(double most) {
  start_ = end_;
  if (!smooth_ || timeStepsLeft_ > 0) {
    return takeTimeStep(most);
  }
  tookTimeStep_ = false;
  work_ = 0;
  stepper_.reset();
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
  const double timeScale = timeScaleOf(world_, tolerance_);
  const double shortest = std::isfinite(timeScale) ? kStiff * timeScale : 0;
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
  finish();
  Step done{.length = h};
  locate(done);
  // Where forces grow fast the polynomials between both ends may leave the contacts that hold at them.
  for (int halvings = 0; halvings < kMostHalvings && dips(done.length); ++halvings) {
    done = {.length = 0.5 * done.length};
    restep(done.length);
    locate(done);
  }
  // If the event was located past a moment where forces cease to exist, the end state means nothing, or its
  // accelerations are so large that the polynomial between swings.
  const bool swings =
      done.length < h && ((done.end == End::kChanges && sizeOf(error_, done.length) > kMostLocated) ||
                          errorBetween(done.length) > kMostLocated);
  if (swings || gainsEnergy()) {
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

ContactStep Island::motion(std::size_t body, double h) const {
  if (tookTimeStep_) {
    return stepper_->motion(body);
  }
  const std::size_t at = system_.placeOf(body) * ContactSystem::kNumbers;
  const auto end = [at](const State& y, const State& dy) {
    return StepEnd{.position = threeAt(y, at),
                   .velocity = threeAt(dy, at),
                   .acceleration = threeAt(dy, at + 7),
                   .worldFromBody = Quat(y[at + 3], y[at + 4], y[at + 5], y[at + 6]),
                   .spinBody = threeAt(y, at + 10),
                   .spinRateBody = threeAt(dy, at + 10)};
  };
  return hermiteStep(end(start_, startRate_), end(end_, endRate_), h);
}

}  // namespace careen
