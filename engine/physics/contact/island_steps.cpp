#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "physics/contact/island.h"
#include "physics/contact/three_at.h"
#include "physics/motion/hermite_step.h"

// One smooth step of an island: how long it may be, its motion, its error.

namespace careen {
namespace {

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

}  // namespace

double Island::longestStep() {
  double most = std::numeric_limits<double>::infinity();
  const bool alone = end_.size() == ContactSystem::kNumbers;
  lifetime_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    const double turning = system_.kinematics(i).angularVelocity.norm();
    if (turning > 0) {
      most = std::min(most, kMostTurn / turning);
    }
  }
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    const double speed = system_.states()[c].slip.norm();
    if (speed > 0 && system_.features()[c].kind != ContactFeature::Kind::kPointOnWall) {
      const auto a = static_cast<std::size_t>(system_.features()[c].a);
      const auto b = static_cast<std::size_t>(system_.features()[c].b.body());
      most = std::min(most, kMostSlip *
                                std::min(bodies()[a].body->halfExtents.minCoeff(),
                                         bodies()[b].body->halfExtents.minCoeff()) /
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
bool Island::try5(double h) {
  bool found = true;
  const auto rate = [&](const State& y, State& dy) {
    if (std::any_of(y.begin(), y.end(), [](double each) { return !(std::fabs(each) < kDiverged); })) {
      dy.assign(y.size(), 0.0);
      found = false;
      return;
    }
    found = system_.rate(y, dy) && found;
    endTurned_ = system_.forces().isTurned();
    found = found && endTurned_ == startTurned_;
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
    endTurned_ = startTurned_;
  }
  finish(h);
}

void Island::finish(double h) {
  for (std::size_t at = 3; at < end_.size(); at += ContactSystem::kNumbers) {
    const double size = std::sqrt(end_[at] * end_[at] + end_[at + 1] * end_[at + 1] +
                                  end_[at + 2] * end_[at + 2] + end_[at + 3] * end_[at + 3]);
    for (std::size_t k = at; k < at + 4; ++k) {
      end_[k] /= size;
    }
  }
  ++moves_;
  const bool kept = system_.keepMomenta(start_, h, end_);
  const bool moved = system_.project(end_, ContactSystem::kMostMoved * tolerance_);
  if (springs_.keep(start_, h, end_) || moved || kept) {
    system_.rate(end_, endRate_);
    endTurned_ = system_.forces().isTurned();
  }
}

// [s] In which gravity or springs would move a body its own size; 0 without any.
double Island::timeToFall(const Body& body) const {
  return system_.pull() > 0 ? std::sqrt(radiusOf(body) / system_.pull()) : 0;
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
    const double fall = timeToFall(*body.body);
    const double time = std::max(h, std::min(fall, std::max(lifetime_, kLeastLifetime * fall)));
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
double Island::awayFromEquilibrium() const {
  const std::vector<ContactForces::Mode>& modes = system_.modes();
  if (!(system_.pull() > 0) || !pushes() ||
      std::find(modes.begin(), modes.end(), ContactForces::Mode::kSlip) != modes.end()) {
    return 1;
  }
  double away = 0;
  std::size_t at = 0;
  for (const TouchingBody& body : bodies()) {
    if (!body.isHeld()) {
      const double radius = radiusOf(*body.body);
      const double speed = threeAt(start_, at + 7).norm() + radius * threeAt(start_, at + 10).norm();
      const double rate = threeAt(startRate_, at + 7).norm() + radius * threeAt(startRate_, at + 10).norm();
      away = std::max({away, (speed / timeToFall(*body.body) + rate) / system_.pull(),
                       kStepRounding * radius / (kShare * tolerance_)});
      at += ContactSystem::kNumbers;
    }
  }
  return std::min(1.0, away);
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
// accelerations at both ends; halfway they differ by e, and where the position differs by a multiple of
// t³(h − t)³ that is by e h²/24 halfway, and the velocity by at most e h/7.
double Island::errorBetween(double h) {
  double slowest = 0;  // [s] the longest time to fall
  for (const TouchingBody& body : bodies()) {
    slowest = body.isHeld() ? slowest : std::max(slowest, timeToFall(*body.body));
  }
  double fastest = 0;  // [m/s²]
  for (std::size_t at = 7; at < end_.size(); at += ContactSystem::kNumbers) {
    fastest = std::max({fastest, threeAt(startRate_, at).norm(), threeAt(endRate_, at).norm()});
  }
  if (fastest * h * std::max(h, slowest) < tolerance_) {
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
      const double wrong = (h * h * threeAt(rate, at + 7) - bend).norm();  // [m]
      worst = std::max({worst, wrong / 24, kOfSpeedBetween * timeToFall(*bodies()[i].body) / h * wrong / 7});
    }
  }
  system_.rate(end_, endRate_);  // event functions are those of the end
  return worst / tolerance_;
}

// Whether the correction of places at the end of a step displaced a body by more than the tolerance.
bool Island::isMovedByCorrection(double h) const {
  constexpr std::size_t kOfPlace = 7;
  State corrected(end_.size(), 0.0);
  for (std::size_t at = 0; at < end_.size(); at += ContactSystem::kNumbers) {
    for (std::size_t k = at; k < at + kOfPlace; ++k) {
      corrected[k] = end_[k] - start_[k] - 0.5 * h * (startRate_[k] + endRate_[k]);
    }
  }
  return kShare * sizeOf(corrected, h) > 1;
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
      return 0.5 * (mass.mass * threeAt(y, at + 7).squaredNorm() + dot(spin, mass.inertiaTimes(spin)));
    };
    const double before = energy(start_);
    const double after = energy(end_);
    motion += before + after;
    gained += after - before - mass.mass * dot(world_.gravity, threeAt(end_, at) - threeAt(start_, at));
    weight += mass.mass * system_.pull();
    at += ContactSystem::kNumbers;
  }
  return gained > kGained * motion + weight * tolerance_;
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
