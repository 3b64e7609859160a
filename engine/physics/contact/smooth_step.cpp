#include "physics/contact/smooth_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "physics/contact/three_at.h"
#include "physics/motion/hermite_step.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// [1] of the tolerance: the error allowed per step, since errors of many steps add up.
constexpr double kShare = 0x1p-4;
/// [rad] Largest rotation in one step, so that the polynomials are accurate.
constexpr double kMostTurn = 0.4;
/// [1] of the smallest half extent: how far two bodies may slip on each other in one step.
constexpr double kMostSlip = 0.25;
/// [1] Steps end short of the moment where slip would end: past it the equations change.
constexpr double kBeforeStop = 1 - 0x1p-10;
/// [1] of the time until its slip ends: how long the speed of a single sliding body matters. And of the time
/// to fall its own size: no shorter than that.
constexpr double kLifetime = 4;
constexpr double kLeastLifetime = 0x1p-4;
/// [1] of the displacement that the error of a velocity within a step would cause in the time to fall one's
/// own size: what counts of it, as the end of the step has another.
constexpr double kOfSpeedBetween = 0x1p-1;
/// [1] of the size of a body: errors of a step this small are rounding.
constexpr double kStepRounding = 0x1p-56;
/// [1] of the energy of motion: a step that gains more is wrong.
constexpr double kGained = 0x1p-4;
/// A trial step too long for its forces diverges; of larger numbers, the squares of ω²r would overflow.
constexpr double kDiverged = 0x1p100;
/// [1] of a time step: the shortest smooth step. Where slip begins, friction turns into its direction the
/// faster the slower the slip is (stiff), and smooth steps would have to resolve that; a time step, implicit
/// in friction, has an error below the tolerance there.
constexpr double kStiff = 0x1p-4;
constexpr int kMostAttempts = 60;

}  // namespace

SmoothStep::SmoothStep(const World& world, ContactSystem& system, double tolerance, double timeScale)
    : world_(world),
      system_(system),
      springs_(world, system.bodies()),
      energy_(world, system),
      tolerance_(tolerance),
      timeScale_(timeScale) {
  end_.y = system.pack();
}

void SmoothStep::restart() {
  springs_.end();
  energy_.end();
  forgetForces();
}

bool SmoothStep::findRate(End& end) {
  const bool found = system_.rate(end.y, end.rate);
  end.isTurned = system_.forces().isTurned();
  return found;
}

bool SmoothStep::begin() {
  if (system_.pushes()) {
    springs_.end();
    energy_.begin(end_.y);
  } else {
    energy_.end();
    if (!isGravitySloping(world_)) {
      springs_.begin(end_.y);
    }
  }
  if (goesOn_) {
    start_ = end_;
    system_.look(start_.y);
    return true;
  }
  start_.y = end_.y;
  return findRate(start_);
}

double SmoothStep::shortest() const {
  // Undamped springs that nothing pushes against may be as stiff as they are: a time step would damp them.
  const bool isSpring = !springs_.empty() && !system_.pushes();
  return std::isfinite(timeScale_) && !isSpring ? kStiff * timeScale_ : 0;
}

bool SmoothStep::take(double most) {
  goesOn_ = true;
  away_ = awayFromEquilibrium();
  length_ = std::min(most, longest());
  if (proposed_ > 0) {
    length_ = std::min(length_, proposed_);
  }
  const double shortest = this->shortest();
  for (int attempts = 0; attempts <= kMostAttempts && (attempts == 0 || length_ >= shortest); ++attempts) {
    const bool found = integrate();
    const double error = this->error();
    if (found && error <= 1) {
      const double between = errorBetween();
      if (between <= 1) {
        proposed_ = length_ * (error > 1e-4 ? std::clamp(0.9 / std::sqrt(std::sqrt(error)), 0.2, 4.0) : 4.0);
        finish();
        return true;
      }
      length_ *= std::max(0.2, 0.9 / std::sqrt(std::sqrt(between)));
    } else {
      length_ *= found && error < 1e10 ? std::max(0.2, 0.9 / std::sqrt(std::sqrt(error))) : 0.2;
    }
  }
  return false;
}

void SmoothStep::retake(double length) {
  length_ = length;
  if (length > 0) {
    integrate();
  } else {
    end_ = start_;
  }
  finish();
}

// How long a step may be at its start; sets the lifetime of the speeds there.
double SmoothStep::longest() {
  double most = kUnbounded;
  const bool alone = end_.y.size() < 2 * ContactSystem::kNumbers;
  lifetime_ = kUnbounded;
  for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
    const TouchingBody& body = system_.bodies()[i];
    const double turning =
        std::max(system_.kinematics(i).angularVelocity.norm(),
                 body.isDriven() && body.drivenBy->motion.swings() ? body.drivenBy->motion.rate : 0);
    if (turning > 0) {
      most = std::min(most, kMostTurn / turning);
    }
  }
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    const double speed = system_.states()[c].slip.norm();
    if (speed > 0 && system_.features()[c].kind != ContactFeature::Kind::kPointOnWall &&
        !system_.features()[c].isOfJoint()) {
      const auto a = static_cast<std::size_t>(system_.features()[c].a);
      const auto b = static_cast<std::size_t>(system_.features()[c].b);
      most = std::min(
          most, kMostSlip *
                    std::min(system_.bodies()[a].body->thinnest(), system_.bodies()[b].body->thinnest()) /
                    speed);
    }
    if (system_.modes()[c] == ContactForces::Mode::kSlip) {
      const double rate = system_.slipSpeedRate(c);
      if (speed > system_.restSpeed() && rate < 0) {
        most = std::min(most, kBeforeStop * speed / -rate);
        lifetime_ = alone ? std::min(lifetime_, kLifetime * speed / -rate) : lifetime_;
      }
    }
  }
  return most;
}

// Returns false if it found no forces, or passed a moment at which they have no bound: there their equations'
// determinant changes its sign, and past it they pull.
bool SmoothStep::integrate() {
  bool found = true;
  const auto rate = [&](const State& y, State& dy) {
    if (std::any_of(y.begin(), y.end(), [](double each) { return !(std::fabs(each) < kDiverged); })) {
      dy.assign(y.size(), 0.0);
      found = false;
      return;
    }
    found = system_.rate(y, dy) && found;
    end_.isTurned = system_.forces().isTurned();
    found = found && end_.isTurned == start_.isTurned;
  };
  integrator_.step(start_.y, start_.rate, length_, rate, end_.y);
  rate(end_.y, end_.rate);
  integrator_.error(length_, end_.rate, error_);
  return found;
}

// Puts on the contacts, and on what is conserved, the state to which a step led.
void SmoothStep::finish() {
  for (std::size_t at = 3; at < end_.y.size(); at += ContactSystem::kNumbers) {
    const Quat q = quatAt(end_.y, at);
    const double size = std::sqrt(q.w() * q.w() + q.x() * q.x() + q.y() * q.y() + q.z() * q.z());
    for (std::size_t k = at; k < at + 4; ++k) {
      end_.y[k] /= size;
    }
  }
  if (system_.hasTime()) {
    end_.y.back() = start_.y.back() + length_;
  }
  const bool kept = system_.keepMomenta(start_.y, length_, end_.y);
  const bool moved = system_.project(end_.y, ContactSystem::kMostMoved * tolerance_);
  const bool scaled = energy_.keep(end_.y);
  if (springs_.keep(start_.y, length_, end_.y) || moved || kept || scaled) {
    findRate(end_);
  }
}

// [s] In which gravity or springs would move a body its own size; 0 without any.
double SmoothStep::timeToFall(const Body& body) const {
  return system_.pull() > 0 ? std::sqrt(radiusOf(body) / system_.pull()) : 0;
}

// The error of a step relative to the error allowed: of positions directly, of velocities by the displacement
// they cause in the time in which the body would fall its own size, or until it has stopped.
double SmoothStep::sizeOf(const State& difference) const {
  double worst = 0;
  std::size_t at = 0;
  for (const TouchingBody& body : system_.bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const double radius = radiusOf(*body.body);
    const double fall = timeToFall(*body.body);
    const double time = std::max(length_, std::min(fall, std::max(lifetime_, kLeastLifetime * fall)));
    const Vec4 turn(difference[at + 3], difference[at + 4], difference[at + 5], difference[at + 6]);
    worst = std::max({worst, threeAt(difference, at).norm(), 2 * radius * turn.norm(),
                      time * threeAt(difference, at + 7).norm(),
                      time * radius * threeAt(difference, at + 10).norm()});
    at += ContactSystem::kNumbers;
  }
  return worst / (kShare * tolerance_ * away_);
}

// [1] of their sizes, at most 1: how far bodies that lean or rock are from equilibrium, as speeds and
// accelerations tell. They leave it exponentially, and errors grow as they do. What slips is in none.
double SmoothStep::awayFromEquilibrium() const {
  const std::vector<ContactForces::Mode>& modes = system_.modes();
  if (!(system_.pull() > 0) || !system_.pushes() ||
      std::find(modes.begin(), modes.end(), ContactForces::Mode::kSlip) != modes.end()) {
    return 1;
  }
  double away = 0;
  std::size_t at = 0;
  for (const TouchingBody& body : system_.bodies()) {
    if (!body.isHeld()) {
      const double radius = radiusOf(*body.body);
      const double speed = threeAt(start_.y, at + 7).norm() + radius * threeAt(start_.y, at + 10).norm();
      const double rate = threeAt(start_.rate, at + 7).norm() + radius * threeAt(start_.rate, at + 10).norm();
      away = std::max({away, (speed / timeToFall(*body.body) + rate) / system_.pull(),
                       kStepRounding * radius / (kShare * tolerance_)});
      at += ContactSystem::kNumbers;
    }
  }
  return std::min(1.0, away);
}

std::vector<ContactStep> SmoothStep::motions() const {
  std::vector<ContactStep> motions;
  for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
    if (!system_.bodies()[i].isHeld()) {
      motions.push_back(motion(i));
    }
  }
  return motions;
}

SmoothStep::State SmoothStep::stateWithin(std::span<const ContactStep> motions, double time) const {
  State state(end_.y.size());
  for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
    if (system_.bodies()[i].isHeld()) {
      continue;
    }
    const MassProperties& mass = system_.bodies()[i].body->mass;
    const BodyState body = stateAt(Motion(motions[system_.placeOf(i)]), mass, time);
    const std::size_t at = system_.placeOf(i) * ContactSystem::kNumbers;
    setThree(state, at, body.pose.position);
    setQuat(state, at + 3, Quat(body.pose.worldFromBody));
    setThree(state, at + 7, body.velocity);
    setThree(state, at + 10,
             mass.inverseInertiaTimes(body.pose.worldFromBody.transpose() * body.angularMomentum));
  }
  if (system_.hasTime()) {
    state.back() = start_.y.back() + time;
  }
  return state;
}

// The error of the motion halfway through a step, relative to the error allowed. The polynomial has the right
// accelerations at both ends; halfway they differ by e, and where the position differs by a multiple of
// t³(h − t)³ that is by e h²/24 halfway, and the velocity by at most e h/7.
double SmoothStep::errorBetween() {
  const double h = length_;
  double slowest = 0;  // [s] the longest time to fall
  for (const TouchingBody& body : system_.bodies()) {
    slowest = body.isHeld() ? slowest : std::max(slowest, timeToFall(*body.body));
  }
  double fastest = 0;  // [m/s²]
  for (std::size_t at = 7; at < end_.y.size(); at += ContactSystem::kNumbers) {
    fastest = std::max({fastest, threeAt(start_.rate, at).norm(), threeAt(end_.rate, at).norm()});
  }
  if (fastest * h * std::max(h, slowest) < tolerance_) {
    return 0;
  }
  const std::vector<ContactStep> path = motions();
  State rate;
  system_.rate(stateWithin(path, 0.5 * h), rate);
  double worst = 0;
  for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
    if (!system_.bodies()[i].isHeld()) {
      const std::size_t at = system_.placeOf(i) * ContactSystem::kNumbers;
      const std::array<Vec3, 6>& c = path[system_.placeOf(i)].position;
      const Vec3 bend = 2 * c[2] + 3 * c[3] + 3 * c[4] + 2.5 * c[5];  // h² times the acceleration halfway
      const double wrong = (h * h * threeAt(rate, at + 7) - bend).norm();  // [m]
      worst = std::max(
          {worst, wrong / 24, kOfSpeedBetween * timeToFall(*system_.bodies()[i].body) / h * wrong / 7});
    }
  }
  system_.rate(end_.y, end_.rate);  // event functions are those of the end
  return worst / tolerance_;
}

bool SmoothStep::isMovedByCorrection() const {
  constexpr std::size_t kOfPlace = 7;
  State corrected(end_.y.size(), 0.0);
  for (std::size_t at = 0; at + kOfPlace <= end_.y.size(); at += ContactSystem::kNumbers) {
    for (std::size_t k = at; k < at + kOfPlace; ++k) {
      corrected[k] = end_.y[k] - start_.y[k] - 0.5 * length_ * (start_.rate[k] + end_.rate[k]);
    }
  }
  return kShare * sizeOf(corrected) > 1;
}

bool SmoothStep::gainsEnergy() const {
  const bool isDriven = std::any_of(system_.bodies().begin(), system_.bodies().end(),
                                    [](const TouchingBody& body) { return body.isDriven(); });
  if (hasSprings(world_) || isDriven) {
    return false;
  }
  // Of speeds that grow evenly ∫ g·v is that of gravity halfway, and ġ·Δv h²/12.
  const Vec3 gravity =
      system_.hasTime() ? gravityNow(world_, start_.y.back() + 0.5 * length_) : world_.gravity;
  const Vec3 slope = (length_ * length_ / 12) * gravitySlope(world_);
  double motion = 0;  // [J] before and after
  double gained = 0;  // [J] not by gravity
  double weight = 0;  // [N]
  std::size_t at = 0;
  for (const TouchingBody& body : system_.bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const MassProperties& mass = body.body->mass;
    const auto energy = [&](const State& y) {
      const Vec3 spin = threeAt(y, at + 10);
      return 0.5 * (mass.mass * threeAt(y, at + 7).squaredNorm() + dot(spin, mass.inertiaTimes(spin)));
    };
    const double before = energy(start_.y);
    const double after = energy(end_.y);
    motion += before + after;
    gained += after - before - mass.mass * dot(gravity, threeAt(end_.y, at) - threeAt(start_.y, at)) -
              mass.mass * dot(slope, threeAt(end_.y, at + 7) - threeAt(start_.y, at + 7));
    weight += mass.mass * system_.pull();
    at += ContactSystem::kNumbers;
  }
  return gained > kGained * motion + weight * tolerance_;
}

ContactStep SmoothStep::motion(std::size_t body) const {
  const std::size_t at = system_.placeOf(body) * ContactSystem::kNumbers;
  const auto stepEnd = [at](const End& end) {
    return StepEnd{.position = threeAt(end.y, at),
                   .velocity = threeAt(end.rate, at),
                   .acceleration = threeAt(end.rate, at + 7),
                   .worldFromBody = quatAt(end.y, at + 3),
                   .spinBody = threeAt(end.y, at + 10),
                   .spinRateBody = threeAt(end.rate, at + 10)};
  };
  return hermiteStep(stepEnd(start_), stepEnd(end_), length_);
}

}  // namespace careen
