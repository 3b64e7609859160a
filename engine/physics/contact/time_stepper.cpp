#include "physics/contact/time_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "physics/contact/impulses_without_approach.h"

namespace careen {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
/// [1] of the tolerance: how far a body is moved apart beside its motion; what finds its contacts anew may
/// move it twice, by three each.
constexpr double kMostApart = 2;
/// [1] of the tolerance: the error allowed per step.
constexpr double kStepShare = 0.25;
/// [rad] Largest rotation in one step, so that the polynomials are accurate.
constexpr double kStepTurn = 0.25;
/// [1] of the smallest half extent: largest way in one step, so that no gap closes and opens within it
/// unseen.
constexpr double kMostWay = 0.25;
/// [1] of the time in which a body falls or moves its own size: the first step.
constexpr double kFirst = 0x1p-8;
constexpr int kStepAttempts = 60;
constexpr int kStepRefinements = 50;
constexpr int kMostUnsolved = 10;

// [s] In which gravity that slopes lets a body sink by `length` [m] and pulls it back up: s t³/12, of a
// contact that is found not to push in all of a step. Newton's method, from above.
double timeToSink(double slope, double length) {
  const double cube = 12 * length / slope;
  double time = 1 + cube;
  while (true) {
    const double next = (2 * time + cube / (time * time)) / 3;
    if (!(next < time)) {
      return time;
    }
    time = next;
  }
}

}  // namespace

TimeStepper::TimeStepper(const World& world, const std::vector<TouchingBody>& bodies, double tolerance,
                         std::span<const ContactFeature> joints)
    : bodies_(bodies),
      tolerance_(tolerance),
      equations_(world, bodies, tolerance),
      found_(equations_.group(), closed(), joints),
      events_(equations_.group(), closed()),
      impacts_(equations_),
      step_{.slope = gravitySlope(world)},
      end_(equations_.group().state()),
      acceleration_(equations_.loads().acceleration(end_)) {
  found_.find(end_, equations_.residual());
}

// [s] Time in which nothing moves by more than what counts as closed.
double TimeStepper::shortestStep() {
  double fastest = equations_.group().fastest(step_.start);
  double acceleration = std::max(acceleration_, equations_.loads().acceleration(step_.start));
  for (const TouchingBody& body : bodies_) {
    if (body.isDriven()) {
      const MotionRates rates = boundsOf(body.drivenBy->motion);
      fastest = std::max(fastest, rates.speed + rates.angularSpeed * radiusOf(*body.body));
    }
  }
  acceleration = std::max(acceleration, drivenAcceleration(bodies_));
  double shortest = kForever;
  if (fastest > 0) {
    shortest = 0.25 * closed() / fastest;
  }
  if (acceleration > 0) {
    shortest = std::min(shortest, std::sqrt(0.25 * closed() / acceleration));
  }
  return shortest;
}

double TimeStepper::longestStep() const {
  const double slope = step_.slope.norm();
  double most = slope > 0 ? timeToSink(slope, kStepShare * tolerance_) : kForever;
  double first = kForever;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].isHeld() && !bodies_[i].isDriven()) {
      continue;
    }
    const Kinematics at = equations_.group().kinematics(i, step_.start[i]);
    const double turning = std::max(
        at.angularVelocity.norm(),
        bodies_[i].isDriven() && bodies_[i].drivenBy->motion.swings() ? bodies_[i].drivenBy->motion.rate : 0);
    const double radius = radiusOf(*bodies_[i].body);
    const double speed = at.velocity.norm() + turning * radius;
    if (turning > 0) {
      most = std::min(most, kStepTurn / turning);
    }
    if (!bodies_[i].isBox()) {
      continue;  // it has no size
    }
    if (speed > 0) {
      most = std::min(most, kMostWay * bodies_[i].body->thinnest() / speed);
      first = std::min(first, kFirst * radius / speed);
    }
    if (acceleration_ > 0) {
      first = std::min(first, kFirst * std::sqrt(radius / acceleration_));
    }
  }
  return std::min(most, proposed_ > 0 ? proposed_ : first);
}

// The error of a step relative to the error allowed. Velocities count by the displacement they cause in
// another such step.
double TimeStepper::errorOf(const GroupState& coarse, const GroupState& fine, double h) const {
  double worst = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].isHeld()) {
      continue;
    }
    const double radius = radiusOf(*bodies_[i].body);
    const Vec3 spun = bodies_[i].body->mass.inverseInertiaTimes(
        fine[i].worldFromBody.conjugate() * (coarse[i].angularMomentum - fine[i].angularMomentum));
    const Vec4 turned = coarse[i].worldFromBody.coeffs() - fine[i].worldFromBody.coeffs();
    worst = std::max({worst, (coarse[i].position - fine[i].position).norm(), 2 * radius * turned.norm(),
                      h * (coarse[i].velocity - fine[i].velocity).norm(), h * radius * spun.norm()});
  }
  return worst / (3 * kStepShare * tolerance_);
}

void TimeStepper::choose(double h) { law_ = found_.obeying(h, law_.empty() ? known_ : law_); }

// The step's end by one step of that length, with the contacts chosen for it.
bool TimeStepper::tryStep(double h, ImplicitStep::Order order) {
  return equations_.advance(step_.start, h, law_, coarse_, order);
}

// Shortens the step to the moment where the first event function falls through zero, or a little before:
// found on the polynomials of the longer step, then tried. Returns false if the impulses were not found.
bool TimeStepper::endAtEvent(double& h) {
  for (int k = 0; k < kStepRefinements; ++k) {
    step_.length = h;
    step_.end = coarse_;
    const double first = events_.firstRoot({equations_.group(), step_});
    if (first == h) {
      return true;
    }
    h = first;
    if (!tryStep(h)) {
      return false;
    }
  }
  return true;
}

// The step's end by two steps of half the length.
bool TimeStepper::tryHalves(double h) {
  choose(0.5 * h);
  if (!equations_.advance(step_.start, 0.5 * h, law_, step_.middle)) {
    return false;
  }
  found_.follow(step_.middle);
  choose(0.5 * h);
  const bool solved = equations_.advance(step_.middle, 0.5 * h, law_, step_.end);
  found_.follow(step_.start);
  return solved;
}

// One attempt at a step; `h` becomes shorter where an event ends it, or for the next attempt.
TimeStepper::Attempt TimeStepper::attempt(double& h, double shortest) {
  step_.middle.clear();
  choose(h);
  if (h <= shortest) {
    if (!tryStep(h)) {
      return Attempt::kUnsolved;
    }
    step_.end = coarse_;
    proposed_ = 4 * h;
    return Attempt::kDone;
  }
  events_.list(found_, step_.start, h, acceleration_);
  const double whole = h;
  if (!tryStep(h) || !endAtEvent(h)) {
    return Attempt::kUnsolved;
  }
  if (h < shortest) {
    h = shortest;
    return Attempt::kShorter;
  }
  if (!tryHalves(h)) {
    return Attempt::kUnsolved;
  }
  const double error = errorOf(coarse_, step_.end, h);
  const double factor = error > 1e-3 ? std::clamp(0.9 / std::sqrt(std::sqrt(error)), 0.2, 2.0) : 2.0;
  if (error > 1) {
    h = std::max(shortest, std::min(factor, 0.9) * h);
    return Attempt::kShorter;
  }
  step_.length = h;
  if (const double dip = events_.firstDip({equations_.group(), step_}); dip > 0) {
    h = std::max(shortest, dip);
    return Attempt::kShorter;
  }
  proposed_ = h < whole ? std::max(proposed_, h) : factor * h;
  return Attempt::kDone;
}

double TimeStepper::step(double most, double mostWork) {
  equations_.limitWork(mostWork);
  step_.start = end_;
  impacts_.clear();
  impacts_.resolve(step_.start, found_, acceleration_);
  const double shortest = std::min(shortestStep(), most);
  double h = std::min(longestStep(), most);
  int unsolved = 0;
  for (int k = 0;; ++k) {
    h = k < kStepAttempts ? h : shortest;
    const Attempt made = attempt(h, shortest);
    if (made == Attempt::kDone) {
      break;
    }
    if (made == Attempt::kUnsolved) {
      h *= 0.5;
      if (++unsolved > kMostUnsolved) {
        if (tryStep(h, ImplicitStep::Order::kFirst)) {
          step_.end = coarse_;
          step_.middle.clear();
          break;
        }
        throw NumericalError("no impulses of " + std::to_string(law_.size()) + " contacts of box " +
                             bodies_[0].body->name +
                             " and its neighbours were found, however short the step");
      }
    }
  }
  equations_.limitWork(kForever);
  step_.length = h;
  acceleration_ = accelerationInStep();
  actAtOnce();
  impacts_.keepLarger(2 * equations_.loads().pull(step_.start) * step_.length);
  known_ = law_;
  correct();
  return step_.length;
}

// Impulses without approach: the step becomes the moment in which they act.
void TimeStepper::actAtOnce() {
  std::optional<JammedMoment> moment =
      jammedMomentOf(step_, found_, law_.empty() ? known_ : law_, equations_);
  if (!moment) {
    return;
  }
  impacts_.addWithoutApproach(found_, moment->law, moment->step.length, moment->change);
  for (ClosedContact& contact : moment->law) {  // what the next step starts from
    contact.push *= moment->part;
    contact.friction *= moment->part;
  }
  law_ = std::move(moment->law);
  step_ = std::move(moment->step);
  acceleration_ = 0;
}

double TimeStepper::accelerationInStep() const {
  double largest = 0;
  for (std::size_t i = 0; step_.length > 0 && i < bodies_.size(); ++i) {
    largest = std::max(largest, (step_.end[i].velocity - step_.start[i].velocity).norm() / step_.length);
  }
  return largest;
}

// Places at the end of a step: contacts found anew, and moved apart where drift has made them deep.
void TimeStepper::correct() {
  end_ = step_.end;
  found_.find(end_, equations_.residual());
  deepest_ = std::max(deepest_, found_.deepest());
  const double deep = found_.farthestOff();
  if (!equations_.separate(end_, found_.features(), 0.125 * closed())) {
    return;
  }
  const double moved = wayApart();
  if (moved > ContactSystem::kMostShift * deep) {
    end_ = step_.end;  // out of a narrow wedge: better deep than aside
  } else if (moved > kMostApart * tolerance_) {
    step_.end = end_;  // a heavy body, or one that turns: a speed is the lesser evil
    step_.middle.clear();
  }
  found_.follow(end_);
}

// [m] The farthest that a body's corner was moved after the step.
double TimeStepper::wayApart() const {
  double most = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const GroupBody& from = step_.end[i];
    const Mat3 turned = end_[i].worldFromBody.toRotationMatrix() - from.worldFromBody.toRotationMatrix();
    for (int k = 0; k < bodies_[i].body->cornerCount(); ++k) {
      most = std::max(most, (end_[i].position - from.position + turned * corner(*bodies_[i].body, k)).norm());
    }
  }
  return most;
}

void TimeStepper::cutTo(double length) {
  if (length < step_.length) {
    const GroupPath path(equations_.group(), step_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      end_[i] = path.at(i, length);
    }
    equations_.group().keepMomenta(step_.start, length, pushing(known_), end_);
    step_.middle.clear();
    for (std::size_t i = 0; !step_.slope.isZero(0) && i < bodies_.size(); ++i) {
      step_.middle.push_back(path.at(i, 0.5 * length));
    }
    step_.length = length;
    step_.end = end_;
    found_.find(end_, equations_.residual());
  }
}

std::vector<ContactFeature> TimeStepper::pressed() const {
  std::vector<ContactFeature> pressed = pushing(known_);
  std::erase_if(pressed, [&](const ContactFeature& feature) {
    const ContactState at = equations_.group().contactAt(feature, end_);
    return !(std::fabs(at.gap) <= closed() && at.beyond <= 0);
  });
  return pressed;
}

bool TimeStepper::isQuiet() {
  const double pull = equations_.loads().pull(end_);
  double fastest = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Kinematics at = equations_.group().kinematics(i, end_[i]);
    fastest = std::max({fastest, at.velocity.norm(), at.angularVelocity.norm() * radiusOf(*bodies_[i].body)});
  }
  return fastest * fastest <= 0x1p-6 * pull * closed();
}

ContactResiduals TimeStepper::takeResiduals() {
  ContactResiduals all = impacts_.takeResiduals();
  all.add(equations_.takeResiduals());
  return all;
}

}  // namespace careen
