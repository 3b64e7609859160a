#include "physics/contact/island.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/contact/three_at.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

using Mode = ContactForces::Mode;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// [1] of the shortest smooth step: no step has an end as near.
constexpr double kNoTime = 0x1p-56;
/// [1] of the error allowed per step: a step that ends at an event may have a little more.
constexpr double kMostLocated = 4;
constexpr int kMostHalvings = 20;
/// [1] Island::work() of a body where smooth motion changes its contacts.
constexpr double kWorkOfChange = 240;

// [s] In which springs move a body by the tolerance from the start; infinite if none pulls.
double timeUnderSprings(const World& world, double tolerance) {
  double time = kInfinity;
  if (!hasSprings(world)) {
    return time;
  }
  for (const double acceleration : accelerationsAtStart(world)) {
    time = acceleration > 0 ? std::min(time, std::sqrt(tolerance / acceleration)) : time;
  }
  return time;
}

}  // namespace

double timeScaleOf(const World& world, double tolerance) {
  const double gravity = gravityScale(world);
  if (gravity > 0) {
    return std::sqrt(tolerance / gravity);
  }
  double scale = kInfinity;
  for (const Body& body : world.bodies) {
    const double radius = radiusOf(body);
    double speed = body.initial.velocity.norm() + radius * angularVelocity(body.mass, body.initial).norm();
    for (const CoursePart& part : body.course) {
      const MotionRates rates = boundsOf(part.motion);
      speed = std::max(speed, rates.speed + radius * rates.angularSpeed);
    }
    for (const Wall& wall : world.walls) {
      for (const CoursePart& part : wall.course) {
        const MotionRates rates = boundsOf(part.motion);
        speed = std::max(speed, rates.speed + radius * rates.angularSpeed);
      }
    }
    scale = speed > 0 ? std::min(scale, std::sqrt(tolerance * radius) / speed) : scale;
  }
  return std::min(scale, timeUnderSprings(world, tolerance));
}

Island::Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
               double tolerance, double timeScale, std::vector<ContactFeature> joints)
    : world_(world),
      tolerance_(tolerance),
      joints_(std::move(joints)),
      system_(world, std::move(bodies), std::move(features), joints_),
      step_(world, system_, tolerance, timeScale),
      events_(system_),
      locator_(system_, step_, events_, tolerance) {}

void Island::begin() {
  timeSteps_.reset();
  step_.restart();
  SmoothStep::State& state = step_.state();
  system_.look(state);
  for (std::size_t c = 0; c < system_.modes().size(); ++c) {
    const bool isChoice = system_.features()[c].axes != 0;  // it may not have to push
    const bool sticks = system_.features()[c].holds() || creeps(system_, c, tolerance_);
    system_.modes()[c] = isChoice ? Mode::kOff : sticks ? Mode::kStick : Mode::kOn;
  }
  system_.projectVelocities(state);
  bool found = system_.findModes(state);
  if (found && system_.projectVelocities(state)) {  // removes the rest of the slip of sticking contacts
    found = system_.findModes(state);
  }
  if (found && stopSlip(system_, state, tolerance_)) {
    found = system_.findModes(state);
  }
  system_.unpack(state);
  events_.list();
  if (!found) {
    beginTimeSteps(0);
  }
}

void Island::beginTimeSteps(int count) {
  step_.restart();
  timeSteps_ = std::make_unique<IslandTimeSteps>(world_, bodies(), tolerance_, count, joints_);
}

bool Island::dropIdle(std::vector<ContactFeature>& features) const {
  if (!isSmooth()) {
    return false;
  }
  std::size_t c = 0;
  return std::erase_if(features, [&](const ContactFeature& feature) {
           return !system_.pushes(c++) && feature.axes != 0;
         }) > 0;
}

Island::Step Island::step(double most, double mostWork) {
  if (timeSteps_ || !step_.begin()) {
    return takeTimeStep(most, mostWork);
  }
  events_.noteStart();
  if (events_.hasTension() || !step_.take(most)) {
    return takeTimeStep(most, mostWork);
  }
  const double tried = step_.length();
  const auto endOf = [](bool located) { return located ? End::kChanges : End::kGoesOn; };
  End end = endOf(locator_.locate());
  for (int halvings = 0; halvings < kMostHalvings && !jumps(tried) && locator_.dips(); ++halvings) {
    step_.retake(0.5 * step_.length());
    end = endOf(locator_.locate());
  }
  if (!isCredible(tried, end)) {
    return takeTimeStep(most, mostWork);
  }
  if (end == End::kGoesOn && (stopSlip(system_, step_.state(), tolerance_) || events_.areClear())) {
    end = End::kChanges;
  }
  system_.unpack(step_.state());
  if (end == End::kGoesOn && rests()) {
    end = End::kChanges;
  }
  if (end == End::kChanges) {
    step_.forgetForces();
  }
  for (const ContactState& state : system_.states()) {
    deepest_ = std::max(deepest_, -state.gap);  // a joint's gap is none
  }
  return {.length = step_.length(), .end = end};
}

// Where forces grow fast the polynomials between both ends may leave the contacts that hold at them.
bool Island::jumps(double tried) const {
  const double length = step_.length();
  const double shortest = step_.shortest();
  return length < tried &&
         (length < kNoTime * shortest || (length < shortest && step_.isMovedByCorrection()));
}

// If the event was located past a moment where forces cease to exist, the end state means nothing, or its
// accelerations are so large that the polynomial between swings. If contacts contradict each other, what
// parts some makes others deeper, at every moment anew.
bool Island::isCredible(double tried, End end) {
  const bool swings = step_.length() < tried && ((end == End::kChanges && step_.error() > kMostLocated) ||
                                                 step_.errorBetween() > kMostLocated);
  return !swings && !jumps(tried) && !step_.gainsEnergy();
}

Island::Step Island::takeTimeStep(double most, double mostWork) {
  if (!timeSteps_) {
    beginTimeSteps(0);
  }
  const bool goesOn = timeSteps_->take(most, mostWork);
  adopt();
  return {.length = timeSteps_->stepper().length(), .end = goesOn ? End::kGoesOn : End::kChanges};
}

// Takes over the state at the end of a time step.
void Island::adopt() {
  const TimeStepper& stepper = timeSteps_->stepper();
  deepest_ = std::max(deepest_, stepper.deepest());
  SmoothStep::State& state = step_.state();
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    if (system_.hasTime() && (bodies()[i].isDriven() || !bodies()[i].isHeld())) {
      state.back() = stepper.state()[i].time;
    }
    if (bodies()[i].isHeld()) {
      continue;
    }
    const GroupBody& body = stepper.state()[i];
    const std::size_t at = system_.placeOf(i) * ContactSystem::kNumbers;
    setThree(state, at, body.position);
    setQuat(state, at + 3, body.worldFromBody);
    setThree(state, at + 7, body.velocity);
    setThree(
        state, at + 10,
        bodies()[i].body->mass.inverseInertiaTimes(body.worldFromBody.conjugate() * body.angularMomentum));
  }
  system_.unpack(state);
}

void Island::cutTo(double length) {
  if (timeSteps_) {
    timeSteps_->cutTo(length);
    adopt();
    return;
  }
  step_.retake(length);
  step_.forgetForces();
  system_.unpack(step_.state());
}

const std::vector<GroupImpact>& Island::impacts() const {
  static const std::vector<GroupImpact> none;
  return timeSteps_ ? timeSteps_->stepper().impacts() : none;
}

void Island::endTimeSteps() {
  if (!timeSteps_) {
    return;
  }
  system_ = ContactSystem(world_, system_.bodies(), timeSteps_->contacts(), joints_);
  system_.closeAll();
  system_.projectPositions(step_.state(), ContactSystem::kMostMoved * tolerance_);
  system_.look(step_.state());
  system_.unpack(step_.state());
}

double Island::work() const {
  if (timeSteps_) {
    return timeSteps_->work();
  }
  return step_.goesOn() ? 0 : kWorkOfChange * static_cast<double>(boxesOf(bodies()));
}

bool Island::mayLose() const {
  const std::vector<ContactFeature>& features = system_.features();
  return timeSteps_ || world_.drag ||
         std::any_of(world_.springs.begin(), world_.springs.end(),
                     [](const Spring& spring) { return spring.damping > 0; }) ||
         std::any_of(world_.joints.begin(), world_.joints.end(),
                     [](const Joint& joint) { return joint.damping > 0 || joint.grip > 0; }) ||
         std::any_of(features.begin(), features.end(),
                     [](const ContactFeature& feature) { return feature.material.friction > 0; });
}

ContactResiduals Island::takeResiduals() {
  ContactResiduals all = system_.takeResiduals();
  if (timeSteps_) {
    all.add(timeSteps_->takeResiduals());
  }
  return all;
}

}  // namespace careen
