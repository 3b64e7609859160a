#include "physics/exact/island_group.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "physics/contact/joint_rows.h"
#include "physics/exact/encounter.h"
#include "physics/exact/encounter_places.h"
#include "physics/geometry/separation.h"

namespace careen {
IslandGroup::IslandGroup(Bodies& bodies, std::vector<int> ranks, std::unique_ptr<Island> island)
    : bodies_(bodies), island_(std::move(island)) {
  motions_.resize(ranks.size());
  ranks_ = std::move(ranks);
}

std::optional<Encounter> IslandGroup::advance(const Instant& time) {
  accountForWork([&](std::size_t place) { return island_->bodies()[place].kinematics().pose; });
  accountForLosses();
  std::optional<Encounter> unsolved = begin(time);
  if (!unsolved) {
    bodies_.account().parted();
    for (const int rank : ranks_) {
      if (!bodies_[rank].isHeld()) {
        bodies_.predict(rank);
      }
    }
  }
  return unsolved;
}

std::optional<Encounter> IslandGroup::begin(const Instant& time) {
  start_ = time;
  const std::vector<TouchingBody> before = island_->bodies();
  noteMotors();
  if (!takeStep(time)) {
    Encounter unsolved;
    unsolved.time = time;
    for (std::size_t i = 0; i < before.size(); ++i) {
      unsolved.bodies.push_back(
          {.mover = &bodies_[ranks_[i]], .attitude = before[i].worldFromBody, .before = before[i].state()});
    }
    return unsolved;
  }
  bool any = false;
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    if (before[i].isHeld()) {
      continue;
    }
    const int rank = ranks_[i];
    bodies_.account().departs(static_cast<std::size_t>(before[i].index), before[i].state());
    leader_ = any ? leader_ : rank;
    any = true;
    motions_[i] = island_->motion(i);
    bodies_.step(shared_from_this(), i);
    bodies_.recorder().moves(bodies_[rank].listed, time.hi, motions_[i]);
    bodies_.file(rank, bodies_[rank].positionAt(time));
    bodies_.findCrossing(rank);
  }
  bodies_.account().penetrates(island_->deepest());
  bodies_.account().solved(island_->takeResiduals());
  recordImpacts();
  return std::nullopt;
}

// Returns false if it found none.
bool IslandGroup::takeStep(const Instant& time) {
  double movable = 0;
  for (const TouchingBody& body : island_->bodies()) {
    movable += body.isHeld() ? 0 : 1;
  }
  bool isSolved = true;
  try {
    // Not bounded by the end of the run, on which the motion must not depend; but by what scales hold for.
    double change = isGravitySloping(bodies_.world())
                        ? secondsBetween(time, Instant(bodies_.world().gravityChanges.front().time))
                        : std::numeric_limits<double>::infinity();
    for (const ContactFeature& feature : island_->joints()) {
      change = std::min(change, untilChange(bodies_, *feature.joint, time));
    }
    const Island::Step step =
        island_->step(std::min(bodies_.longestStep(), change), bodies_.workLeft(ranks_, time));
    length_ = step.length;
    end_ = step.length < change ? step.end : Island::End::kChanges;
  } catch (const NumericalError&) {
    if (!bodies_.crowds().areAllowed()) {
      throw;
    }
    isSolved = false;
  }
  for (const int rank : ranks_) {
    bodies_[rank].work += bodies_[rank].isHeld() ? 0 : island_->work() / movable;
  }
  return isSolved;
}

bool IslandGroup::enter(Encounter& encounter, int rank) {
  if (earlier(encounter.time, end())) {
    length_ = secondsBetween(start_, encounter.time);
    island_->cutTo(length_);
  }
  accountForWork([&](std::size_t place) { return island_->bodies()[place].kinematics().pose; });
  encounter.timeSteps = std::max(encounter.timeSteps, island_->timeStepsLeft());
  island_->endTimeSteps();
  const TouchingBody& here = island_->bodies()[bodies_[rank].place];
  encounter.bodies.push_back(
      {.mover = &bodies_[rank], .attitude = here.worldFromBody, .before = here.state()});
  for (const int each : ranks_) {
    join(bodies_, encounter, each);
  }
  return true;
}

void IslandGroup::addFeatures(const Encounter& encounter, std::vector<ContactFeature>& features) const {
  const ContactSystem& system = island_->system();
  const auto indexOf = [&](int place) {
    return static_cast<int>(encounter.indexOf(ranks_[static_cast<std::size_t>(place)]));
  };
  for (std::size_t c = 0; c < system.features().size(); ++c) {
    ContactFeature feature = system.features()[c];
    if (feature.isOfJoint()) {
      continue;  // the encounter has them
    }
    const auto a = static_cast<std::size_t>(feature.a);
    const double within =
        kAligned * touchingWithin(boxAt(system.kinematics(a).pose, *system.bodies()[a].body));
    if (std::fabs(system.states()[c].gap) > within || system.states()[c].beyond > within / 16) {
      continue;
    }
    feature.a = indexOf(feature.a);
    feature.b = indexOf(feature.b);
    features.push_back(feature);
  }
}

bool IslandGroup::seesTo(std::size_t place, int box, const BoxOf& other) const {
  const auto found = std::find(ranks_.begin(), ranks_.end(), other.body);
  return found != ranks_.end() && island_->handles({static_cast<int>(place), box},
                                                   {static_cast<int>(found - ranks_.begin()), other.box});
}

void IslandGroup::endRun(const Instant& time) {
  for (const int rank : ranks_) {
    const Mover& body = bodies_[rank];
    if (!body.isHeld()) {
      bodies_.account().departs(static_cast<std::size_t>(body.listed.value), body.stateAt(time));
    }
  }
  accountForWork([&](std::size_t place) { return bodies_[ranks_[place]].stateAt(time).pose; });
  accountForLosses();
}

void IslandGroup::noteMotors() {
  driven_.clear();
  for (const ContactFeature& feature : island_->joints()) {
    const auto poseOf = [&](int place) {
      return island_->bodies()[static_cast<std::size_t>(place)].kinematics().pose;
    };
    if (feature.part == JointPart::kPoint && feature.joint->drive() != 0) {
      driven_.push_back(
          {.of = &feature,
           .effort = feature.joint->drive(),
           .coordinate = jointCoordinate(*feature.joint, poseOf(feature.a), poseOf(feature.b))});
    }
  }
}

// No hinge turns by half a turn in a step.
template <class PoseOf>
void IslandGroup::accountForWork(const PoseOf& poseOf) {
  for (const Driven& driven : driven_) {
    const Joint& joint = *driven.of->joint;
    const double now = jointCoordinate(joint, poseOf(static_cast<std::size_t>(driven.of->a)),
                                       poseOf(static_cast<std::size_t>(driven.of->b)));
    bodies_.account().gives(driven.effort *
                            (inNearestTurn(joint, now, driven.coordinate) - driven.coordinate));
  }
  driven_.clear();
}

void IslandGroup::accountForLosses() {
  if (island_->mayLose()) {
    bodies_.account().mayLose();
  }
}

// Their doubt is at least the tolerance to which they step.
void IslandGroup::recordImpacts() {
  std::vector<DoubtfulBody> doubtful;
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    doubtful.push_back(careen::doubtful(bodies_, ranks_[i], start_, island_->bodies()[i].state()));
    bodies_[ranks_[i]].doubt.atLeast(bodies_[ranks_[i]].isHeld() ? 0 : bodies_.tolerance());
  }
  for (const GroupImpact& impact : island_->impacts()) {
    if (impact.contact.joint != ImpactContact::kNoJoint) {
      const auto a = static_cast<std::size_t>(impact.contact.a);
      bodies_.recorder().passes(jointImpulseOf(
          bodies_.world(), start_.hi, island_->joints()[static_cast<std::size_t>(impact.contact.joint)],
          impact.contact, impact.share, bodies_[ranks_[a]].stateAt(start_).pose.position));
      continue;
    }
    touch(doubtful, impact.contact, impact.share);
    const auto rankOf = [&](int place) { return ranks_[static_cast<std::size_t>(place)]; };
    const ImpactContact& contact = impact.contact;
    const int a = rankOf(contact.a);
    bodies_.strike(start_, a, rankOf(contact.b), bodies_[a].stateAt(start_).pose.position + contact.armA,
                   impact.share);
  }
  doubtMore(doubtful);
}

}  // namespace careen
