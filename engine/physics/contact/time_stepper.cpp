#include "physics/contact/time_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/math/falling_bracket.h"
#include "physics/motion/hermite_step.h"

// Step control. Contacts and impacts are in time_stepper_contacts.cpp, impulses without approach in
// time_stepper_jolts.cpp.

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
/// [1] of a step: roots are told apart.
constexpr double kPolynomialRootWidth = 0x1p-50;

}  // namespace

TimeStepper::TimeStepper(const World& world, const std::vector<TouchingBody>& bodies, double tolerance)
    : world_(world), bodies_(bodies), tolerance_(tolerance), equations_(world, bodies, tolerance) {
  for (const TouchingBody& body : bodies) {
    const BodyState state = body.state();
    end_.push_back({.position = body.position,
                    .worldFromBody = body.worldFromBody,
                    .velocity = body.isHeld() ? Vec3(Vec3::Zero()) : state.velocity,
                    .angularMomentum = body.isHeld() ? Vec3(Vec3::Zero()) : state.angularMomentum});
  }
  acceleration_ = equations_.freeAcceleration(end_);
  findContacts(end_);
}

// [m/s] Of the bodies and their corners, at most.
double TimeStepper::fastestOf(const GroupState& state) const {
  double fastest = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      const Kinematics at = equations_.kinematics(i, state[i]);
      fastest =
          std::max(fastest, at.velocity.norm() + at.angularVelocity.norm() * radiusOf(*bodies_[i].body));
    }
  }
  return fastest;
}

// [s] Time in which nothing moves by more than what counts as closed.
double TimeStepper::shortestStep() {
  const double fastest = fastestOf(start_);
  const double acceleration = std::max(acceleration_, equations_.freeAcceleration(start_));
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
  double most = kForever;
  double first = kForever;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].isHeld()) {
      continue;
    }
    const Kinematics at = equations_.kinematics(i, start_[i]);
    const double turning = at.angularVelocity.norm();
    const double radius = radiusOf(*bodies_[i].body);
    const double speed = at.velocity.norm() + turning * radius;
    if (turning > 0) {
      most = std::min(most, kStepTurn / turning);
    }
    if (speed > 0) {
      most = std::min(most, kMostWay * bodies_[i].body->halfExtents.minCoeff() / speed);
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

// The step's end by one step of that length, with the contacts chosen for it.
bool TimeStepper::tryStep(double h, ImplicitStep::Order order) {
  return equations_.advance(start_, h, law_, coarse_, order);
}

// Shortens the step to the moment where the first event function falls through zero, or a little before:
// found on the polynomials of the longer step, then tried. Returns false if the impulses were not found.
bool TimeStepper::locate(double& h) {
  for (int k = 0; k < kStepRefinements; ++k) {
    length_ = h;
    end_ = coarse_;
    setMotions(end_);
    double first = h;
    for (const Watch& watch : watches_) {
      if (const double atEnd = value(watch, end_); atEnd < -0.5 * closed()) {
        first = std::min(first, rootOf(watch, h, atEnd));
      }
    }
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

// Time at which an event function falls to about zero, on the polynomials of the step.
double TimeStepper::rootOf(const Watch& watch, double h, double atEnd) {
  const double aim = 0.0625 * closed();
  FallingBracket bracket{.high = h, .valueLow = watch.start.value - aim, .valueHigh = atEnd - aim};
  for (int k = 0; k < kStepRefinements; ++k) {
    const double middle = bracket.next(kPolynomialRootWidth * h);
    const double now = valueWithin(watch, middle) - aim;
    if (std::fabs(now) <= aim) {
      return middle;
    }
    bracket.add(middle, now);
  }
  return bracket.low;
}

// The step's end by two steps of half the length.
bool TimeStepper::tryHalves(double h) {
  choose(0.5 * h);
  if (!equations_.advance(start_, 0.5 * h, law_, middle_)) {
    return false;
  }
  lookAgain(middle_);
  choose(0.5 * h);
  const bool solved = equations_.advance(middle_, 0.5 * h, law_, end_);
  lookAgain(start_);
  return solved;
}

// One attempt at a step; `h` becomes shorter where an event ends it, or for the next attempt.
TimeStepper::Attempt TimeStepper::attempt(double& h, double shortest) {
  halved_ = false;
  choose(h);
  if (h <= shortest) {
    if (!tryStep(h)) {
      return Attempt::kUnsolved;
    }
    end_ = coarse_;
    proposed_ = 4 * h;
    return Attempt::kDone;
  }
  listWatches(h);
  const double whole = h;
  if (!tryStep(h) || !locate(h)) {
    return Attempt::kUnsolved;
  }
  if (h < shortest) {
    h = shortest;
    return Attempt::kShorter;
  }
  if (!tryHalves(h)) {
    return Attempt::kUnsolved;
  }
  const double error = errorOf(coarse_, end_, h);
  const double factor = error > 1e-3 ? std::clamp(0.9 / std::sqrt(std::sqrt(error)), 0.2, 2.0) : 2.0;
  if (error > 1) {
    h = std::max(shortest, std::min(factor, 0.9) * h);
    return Attempt::kShorter;
  }
  length_ = h;
  halved_ = true;
  if (const double dip = firstDip(); dip > 0) {
    h = std::max(shortest, dip);
    return Attempt::kShorter;
  }
  proposed_ = h < whole ? std::max(proposed_, h) : factor * h;
  return Attempt::kDone;
}

double TimeStepper::step(double most, double mostWork) {
  equations_.limitWork(mostWork);
  start_ = end_;
  jolted_ = false;
  impacts_.clear();
  collide();
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
          end_ = coarse_;
          break;
        }
        throw NumericalError("no impulses of " + std::to_string(law_.size()) + " contacts of box " +
                             bodies_[0].body->name +
                             " and its neighbours were found, however short the step");
      }
    }
  }
  equations_.limitWork(std::numeric_limits<double>::infinity());
  shortenJolt(h);
  length_ = h;
  keepImpacts();
  known_ = law_;
  correct();
  return length_;
}

// Places at the end of a step: contacts found anew, and moved apart where drift has made them deep.
void TimeStepper::correct() {
  reached_ = end_;
  acceleration_ = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (length_ > 0 && !jolted_) {
      acceleration_ = std::max(acceleration_, (end_[i].velocity - start_[i].velocity).norm() / length_);
    }
  }
  findContacts(end_);
  std::vector<ContactFeature> features;
  double deep = 0;
  for (const Found& found : found_) {
    features.push_back(found.feature);
    deep = std::max(deep, -found.gap);
  }
  deepest_ = std::max(deepest_, deep);
  if (equations_.separate(end_, features, 0.125 * closed())) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (wayOf(i, reached_[i], end_[i]) > ContactSystem::kMostShift * deep) {
        end_ = reached_;  // out of a narrow wedge: better deep than aside
        break;
      }
    }
    lookAgain(end_);
    // A heavy body, or one that turns, may have to be moved farther; then a speed is the lesser evil.
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (wayOf(i, reached_[i], end_[i]) > kMostApart * tolerance_) {
        reached_ = end_;
        halved_ = false;
      }
    }
  }
}

// [m] The farthest that a point of a body is moved: one of its corners.
double TimeStepper::wayOf(std::size_t body, const GroupBody& from, const GroupBody& to) const {
  const Mat3 turned = to.worldFromBody.toRotationMatrix() - from.worldFromBody.toRotationMatrix();
  double most = 0;
  for (int k = 0; k < kCorners; ++k) {
    most = std::max(most, (to.position - from.position + turned * corner(*bodies_[body].body, k)).norm());
  }
  return most;
}

void TimeStepper::cutTo(double length) {
  if (length < length_) {
    setMotions(reached_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      end_[i] = bodyWithin(i, length);
    }
    std::vector<ContactFeature> pushing;
    for (const ClosedContact& contact : known_) {
      if (contact.push > 0) {
        pushing.push_back(contact.feature);
      }
    }
    equations_.keepMomenta(start_, length, pushing, end_);
    length_ = length;
    reached_ = end_;
    halved_ = false;
    findContacts(end_);
  }
}

std::vector<ContactFeature> TimeStepper::touching() const {
  std::vector<ContactFeature> touching;
  for (const Found& found : found_) {
    touching.push_back(found.feature);
  }
  return touching;
}

std::vector<ContactFeature> TimeStepper::pressed() const {
  std::vector<ContactFeature> pressed;
  for (const ClosedContact& contact : known_) {
    const ContactState at = equations_.contactAt(contact.feature, end_);
    if (contact.push > 0 && std::fabs(at.gap) <= closed() && at.beyond <= 0) {
      pressed.push_back(contact.feature);
    }
  }
  return pressed;
}

bool TimeStepper::isQuiet() {
  const double pull = equations_.pull(end_);
  double fastest = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Kinematics at = equations_.kinematics(i, end_[i]);
    fastest = std::max({fastest, at.velocity.norm(), at.angularVelocity.norm() * radiusOf(*bodies_[i].body)});
  }
  return fastest * fastest <= 0x1p-6 * pull * closed();
}

ContactStep TimeStepper::motion(std::size_t body, const GroupState& reached) const {
  const auto end = [&](const GroupState& at) {
    const MassProperties& mass = bodies_[body].body->mass;
    const Vec3 spin = mass.inverseInertiaTimes(at[body].worldFromBody.conjugate() * at[body].angularMomentum);
    return StepEnd{.position = at[body].position,
                   .velocity = at[body].velocity,
                   .worldFromBody = at[body].worldFromBody,
                   .spinBody = spin};
  };
  StepEnd from = end(start_);
  StepEnd to = end(reached);
  if (dot(to.worldFromBody.coeffs(), from.worldFromBody.coeffs()) < 0) {
    to.worldFromBody.coeffs() = -to.worldFromBody.coeffs();
  }
  if (length_ > 0) {
    const double half = 0.5 * length_;
    StepEnd middle = halved_ ? end(middle_) : from;
    if (!halved_) {
      middle.velocity = 0.5 * (from.velocity + to.velocity);
      middle.spinBody = 0.5 * (from.spinBody + to.spinBody);
    }
    from.acceleration = (middle.velocity - from.velocity) / half;
    to.acceleration = (to.velocity - middle.velocity) / half;
    from.spinRateBody = (middle.spinBody - from.spinBody) / half;
    to.spinRateBody = (to.spinBody - middle.spinBody) / half;
  }
  return hermiteStep(from, to, length_);
}

ContactResiduals TimeStepper::takeResiduals() {
  ContactResiduals all = std::exchange(residuals_, {});
  all.add(equations_.takeResiduals());
  return all;
}

}  // namespace careen
