#include <algorithm>
#include <cmath>

#include "physics/contact/time_stepper.h"

// Impulses without approach.

namespace careen {
namespace {

/// [1] of a step: a moment, in which forces do next to nothing and only impulses count. In a much shorter one
/// what gravity gives would count as none, and no impulses be found. It is no longer than what moves nothing.
constexpr double kMoment = 0x1p-6;
/// [1] of the fastest speed and, in the step, of what counts as closed: a change of velocity that is looked
/// at again. Of that change: one that stays however short the step.
constexpr double kJolt = 0x1p-4;
constexpr double kStays = 0.5;

}  // namespace

// [m/s] The largest change of a velocity from the step's start, corners included.
double TimeStepper::changeTo(const GroupState& end) const {
  GroupState change = start_;
  for (std::size_t i = 0; i < change.size(); ++i) {
    change[i].velocity = end[i].velocity - start_[i].velocity;
    change[i].angularMomentum = end[i].angularMomentum - start_[i].angularMomentum;
  }
  return fastestOf(change);
}

// Where the impulses of a step stay finite as it shrinks, they are impulses without approach: they act in a
// moment, and the step becomes that moment. Else it would go on with the velocities before while they grow.
void TimeStepper::shortenJolt(double& h) {
  const double change = changeTo(end_);
  if (change <= kJolt * fastestOf(start_) || change * h <= kJolt * closed()) {
    return;
  }
  const double acceleration = equations_.freeAcceleration(start_);
  const double part =
      acceleration > 0 ? std::min(kMoment, std::sqrt(0.25 * closed() / acceleration) / h) : kMoment;
  const std::vector<ClosedContact> found = law_;
  choose(h);
  jolted_ = tryStep(part * h) && changeTo(coarse_) > kStays * change;
  if (!jolted_) {
    law_ = found;
  } else {
    halved_ = false;
    h *= part;
    addJolt(h, change);
    strikeAtStart(h);
    for (ClosedContact& contact : law_) {  // what the next step starts from
      contact.push *= part;
      contact.friction *= part;
    }
  }
}

// Whatever is pushed in the step to coarse_ has the velocities of its end from its start on: so impulses act,
// and so they are recorded.
void TimeStepper::strikeAtStart(double h) {
  std::vector<char> struck(bodies_.size(), 0);
  std::vector<ContactFeature> pushing;
  for (const ClosedContact& contact : law_) {
    if (contact.push > 0) {
      pushing.push_back(contact.feature);
      struck[static_cast<std::size_t>(contact.feature.a)] = 1;
      if (!contact.feature.b.isWall()) {
        struck[static_cast<std::size_t>(contact.feature.b.body())] = 1;
      }
    }
  }
  const GroupState before = start_;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (struck[i] != 0 && !bodies_[i].isHeld()) {
      start_[i].velocity = coarse_[i].velocity;
      start_[i].angularMomentum = coarse_[i].angularMomentum;
    }
  }
  equations_.keepMomenta(before, 0, pushing, start_);  // the impulses were those of the middle of the moment
  std::vector<ClosedContact> none;
  equations_.advance(start_, h, none, end_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (struck[i] != 0 && !bodies_[i].isHeld()) {
      end_[i].position = start_[i].position + h * start_[i].velocity;
      end_[i].velocity = start_[i].velocity;
      end_[i].angularMomentum = start_[i].angularMomentum;
    }
  }
  equations_.keepMomenta(before, h, pushing, end_);
}

// The impulses of a moment of `h` are those of an impact without approach.
void TimeStepper::addJolt(double h, double change) {
  for (std::size_t c = 0; c < found_.size(); ++c) {
    const auto with = std::find_if(law_.begin(), law_.end(), [&](const ClosedContact& contact) {
      return isSame(contact.feature, found_[c].feature);
    });
    if (with != law_.end() && with->push > 0) {
      impacts_.push_back({.contact = impactAt(c),
                          .share = {.approach = std::max(0.0, -found_[c].rate),
                                    .impulse = h * with->push,
                                    .tangential = h * with->friction.norm(),
                                    .normal = states_[c].normal},
                          .cause = change});
    }
  }
}

}  // namespace careen
