#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "physics/contact/island.h"

// An island that goes on by time steps.

namespace careen {
namespace {

/// Time steps where no smooth motion was found, before it is tried again.
constexpr int kFewTimeSteps = 8;
/// [1] Island::work() of a body for finding its contacts and watching its gaps in one step, and where smooth
/// motion changes its contacts.
constexpr double kWorkOfGeometry = 60;
constexpr double kWorkOfChange = 240;
/// Time steps before it is asked again whether the bodies rest.
constexpr int kBeforeRest = 16;

}  // namespace

void Island::beginTimeSteps(int count) {
  smooth_ = false;
  quiet_ = false;
  timeStepsTaken_ = 0;
  known_ = false;
  stepper_.reset();
  timeStepsLeft_ = count;
}

Island::Step Island::takeTimeStep(double most) {
  springs_.end();
  tookTimeStep_ = true;
  known_ = false;
  if (!stepper_) {
    stepper_ = std::make_unique<TimeStepper>(world_, bodies(), tolerance_);
    timeStepsLeft_ = std::max(timeStepsLeft_, kFewTimeSteps);
  }
  workBefore_ = stepper_->equations().work();
  Step done{.length = stepper_->step(most, mostWork_)};
  --timeStepsLeft_;
  ++timeStepsTaken_;
  adopt();
  quiet_ = timeStepsTaken_ >= kBeforeRest && stepper_->isQuiet();
  if (timeStepsLeft_ <= 0 || quiet_) {
    done.end = End::kChanges;
  }
  return done;
}

double Island::work() const {
  const auto members = static_cast<double>(bodies().size());
  if (tookTimeStep_) {
    return stepper_->equations().work() - workBefore_ + kWorkOfGeometry * members;
  }
  return known_ ? 0 : kWorkOfChange * members;
}

// Takes over the state at the end of a time step.
void Island::adopt() {
  length_ = stepper_->length();
  deepest_ = std::max(deepest_, stepper_->deepest());
  std::size_t at = 0;
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    if (bodies()[i].isHeld()) {
      continue;
    }
    const GroupBody& body = stepper_->state()[i];
    const Vec3 spin =
        bodies()[i].body->mass.inverseInertiaTimes(body.worldFromBody.conjugate() * body.angularMomentum);
    const Quat& q = body.worldFromBody;
    const std::array<double, ContactSystem::kNumbers> numbers{
        body.position[0], body.position[1], body.position[2], q.w(),   q.x(),   q.y(),  q.z(),
        body.velocity[0], body.velocity[1], body.velocity[2], spin[0], spin[1], spin[2]};
    std::copy(numbers.begin(), numbers.end(), end_.begin() + static_cast<std::ptrdiff_t>(at));
    at += ContactSystem::kNumbers;
  }
  system_.unpack(end_);
}

const std::vector<GroupImpact>& Island::impacts() const {
  static const std::vector<GroupImpact> none;
  return tookTimeStep_ ? stepper_->impacts() : none;
}

void Island::endTimeSteps() {
  if (!tookTimeStep_) {
    return;
  }
  std::vector<ContactFeature> features;
  for (const ContactFeature& feature : quiet_ ? stepper_->touching() : stepper_->pressed()) {
    features.push_back(feature);
  }
  system_ = ContactSystem(world_, system_.bodies(), std::move(features));
  std::fill(system_.modes().begin(), system_.modes().end(), ContactForces::Mode::kOn);
  system_.projectPositions(end_, ContactSystem::kMostMoved * tolerance_);
  system_.look(end_);
  system_.unpack(end_);
}

}  // namespace careen
