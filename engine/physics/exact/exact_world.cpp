#include "physics/exact/exact_world.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "physics/exact/aftermath.h"
#include "physics/exact/crowd_group.h"
#include "physics/exact/encounter_contacts.h"
#include "physics/exact/encounter_impact.h"
#include "physics/exact/encounter_places.h"
#include "physics/exact/island_group.h"

namespace careen {
namespace {

// Counts bodies, by index in the world; what joints hold together is one: it may be much and touch nothing.
class BodiesApart {
 public:
  explicit BodiesApart(const std::vector<std::size_t>& articulationOf) : articulationOf_(articulationOf) {}
  void add(int listed) {
    const bool isNew = articulationOf_.empty() ||
                       articulations_.insert(articulationOf_[static_cast<std::size_t>(listed)]).second;
    count_ += isNew ? 1 : 0;
  }
  int count() const { return count_; }

 private:
  const std::vector<std::size_t>& articulationOf_;
  std::set<std::size_t> articulations_;
  int count_ = 0;
};

std::vector<std::size_t> articulationsOf(const World& world) {
  std::vector<std::size_t> articulations;
  if (world.joints.empty()) {
    return articulations;
  }
  DisjointSets together(world.bodies.size());
  for (const Joint& joint : world.joints) {
    const std::optional<int>& to = joint.to.body;
    if (to && !isImmovable(world.bodies[static_cast<std::size_t>(*to)].mass) &&
        !isImmovable(world.bodies[static_cast<std::size_t>(*joint.from.body)].mass)) {
      together.join(static_cast<std::size_t>(*joint.from.body), static_cast<std::size_t>(*to));
    }
  }
  for (std::size_t body = 0; body < world.bodies.size(); ++body) {
    articulations.push_back(together.root(body));
  }
  return articulations;
}

}  // namespace

// The event loop, from here to end().

ExactWorld::ExactWorld(const World& world, const RunSettings& settings, Recorder& recorder)
    : changing_(world.joints.empty() && world.gravityChanges.empty() && !hasCourses(world)
                    ? std::nullopt
                    : std::optional<ChangingWorld>(world)),
      bodies_(changing_ ? changing_->world() : world, settings, recorder, changing_ ? &*changing_ : nullptr),
      articulationOf_(articulationsOf(world)) {}

RunFigures ExactWorld::run(const std::stop_token& stop) {
  Instant ended = bodies_.end();
  begin();
  while (true) {
    const std::optional<Event> event = bodies_.queue().next();
    const bool isOver = !event || earlier(bodies_.end(), event->time);
    const double change = changing_ ? changing_->nextJump() : std::numeric_limits<double>::infinity();
    const bool changesFirst = change < bodies_.end().hi && (isOver || change <= event->time.hi);
    if (isOver && !changesFirst) {
      break;
    }
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    const Instant now = changesFirst ? Instant(change) : event->time;
    bodies_.recorder().reaches(now.hi);
    if (bodies_.recorder().hasEnough()) {
      ended = now;
      break;
    }
    changeJoints(now.hi);
    if (changesFirst) {
      jump(now);
    } else {
      happen(*event);
    }
  }
  end(ended);
  return bodies_.account().figures();
}

void ExactWorld::begin() {
  bodies_.feelJump({});
  for (int rank = 0; rank < bodies_.count(); ++rank) {
    const BodyState& initial = bodies_[rank].body->initial;
    if (!bodies_[rank].body->course.empty()) {
      continue;
    }
    if (bodies_[rank].isHeld()) {
      bodies_.rest(rank, {}, initial.pose);
    } else {
      bodies_.fly(rank, {}, initial, Quat(initial.pose.worldFromBody).normalized());
    }
  }
  bodies_.account().parted();
  for (int rank = 0; rank < bodies_.count(); ++rank) {
    bodies_.predict(rank);
  }
}

// All that step end their steps where their joints change.
void ExactWorld::changeJoints(double until) {
  while (changing_ && changing_->next() <= until) {
    const Instant now(changing_->next());
    std::vector<BodyState> states(static_cast<std::size_t>(bodies_.count()));
    for (int rank = 0; rank < bodies_.count(); ++rank) {
      states[static_cast<std::size_t>(bodies_[rank].listed.value)] = bodies_[rank].stateAt(now);
    }
    changing_->change(states, bodies_.recorder());
  }
}

// Where gravity changes, or the speed of something driven. All that can move flies anew, as at the start of a
// run, and finds again what it touches.
void ExactWorld::jump(const Instant& time) {
  Encounter all;
  all.time = time;
  for (int rank = 0; rank < bodies_.count(); ++rank) {
    if (!bodies_[rank].isHeld()) {
      join(bodies_, all, rank);
    }
  }
  for (const std::shared_ptr<CrowdGroup>& crowd : all.crowds) {
    crowd->dissolve(all);
  }
  const Vec3 before = bodies_.world().gravity;
  for (const EncounterBody& body : all.bodies) {
    if (body.mover->flies()) {
      bodies_.arrive(*body.mover, time, body.before);
    } else {
      bodies_.account().departs(static_cast<std::size_t>(body.listed()), body.before);
      bodies_.account().mayLose();
    }
  }
  bodies_.account().parted();
  changing_->jump();
  bodies_.feelJump(time);
  for (const EncounterBody& body : all.bodies) {
    if (body.mover->isHeld()) {
      continue;
    }
    const int rank = body.mover->rank;
    bodies_.account().gives(-body.body().mass.mass *
                            dot(bodies_.world().gravity - before, body.before.pose.position));
    body.mover->group.reset();
    bodies_.file(rank, body.before.pose.position);
    bodies_.fly(rank, time, body.before, body.attitude);
  }
  bodies_.account().parted();
  for (int rank = 0; rank < bodies_.count(); ++rank) {
    bodies_.predict(rank);
  }
}

void ExactWorld::happen(const Event& event) {
  if (event.kind == EventKind::kCrossing) {
    bodies_.cross(event.body);
  } else if (event.partner != Event::kNobody && bodies_[event.partner].motion != event.partnerMotion) {
    bodies_.predict(event.body);
  } else if (event.kind == EventKind::kStep && bodies_[event.body].group->goesOn()) {
    const std::shared_ptr<ContactGroup> group = bodies_[event.body].group;  // its bodies may leave it
    if (const std::optional<Encounter> unsolved = group->advance(event.time)) {
      CrowdGroup::form(bodies_, *unsolved);
      bodies_.account().parted();
      for (const EncounterBody& body : unsolved->bodies) {
        if (!body.mover->isHeld()) {
          bodies_.predict(body.mover->rank);
        }
      }
    }
  } else {
    meet(event);
  }
}

void ExactWorld::meet(const Event& event) {
  Encounter encounter = gather(bodies_, event);
  if (goesOnAsCrowd(encounter)) {
    CrowdGroup::form(bodies_, encounter);
    return;
  }
  try {
    alignPlaces(bodies_, event, encounter);
    bodies_.account().penetrates(findContacts(bodies_, encounter));
    resolve(bodies_, encounter);
    settle(bodies_, encounter);
  } catch (const NumericalError&) {
    if (!bodies_.crowds().areAllowed()) {
      throw;
    }
    CrowdGroup::form(bodies_, encounter);
    return;
  }
  if (costsTooMuch(encounter)) {
    CrowdGroup::form(bodies_, encounter);
    return;
  }
  bodies_.account().solved(encounter.residuals);
  record(bodies_, encounter);
  moveOn(encounter);
}

// Starts the next motions of the event's bodies and predicts their next events, and only theirs.
void ExactWorld::moveOn(Encounter& encounter) {
  for (const EncounterBody& body : encounter.bodies) {
    if (body.next == NextMotion::kRests) {
      bodies_.stand(body.mover->rank, encounter.time, body.since, body.after.pose.position, body.attitude);
      bodies_.rest(body.mover->rank, body.since, body.after.pose);
    } else if (body.next == NextMotion::kFlies) {
      bodies_.fly(body.mover->rank, encounter.time, body.after, body.attitude);
    }
  }
  // All of them first: a crowd takes in what it is about to meet.
  std::vector<Encounter> unsolved;
  for (const std::shared_ptr<IslandGroup>& island : encounter.islands) {
    if (std::optional<Encounter> each = island->begin(encounter.time)) {
      unsolved.push_back(std::move(*each));
    }
  }
  for (Encounter& each : unsolved) {
    for (const EncounterBody& body : each.bodies) {
      if (body.mover->group && !body.mover->group->isPredicted()) {  // the crowd of one before it has it
        body.mover->group->enter(each, body.mover->rank);
      }
    }
    CrowdGroup::form(bodies_, each);
  }
  bodies_.account().parted();
  for (const EncounterBody& body : encounter.bodies) {
    bodies_.predict(body.mover->rank);
    if (body.next == NextMotion::kRests) {
      bodies_.predictAround(body.mover->rank);
    }
  }
}

void ExactWorld::end(const Instant& time) {
  for (int rank = 0; rank < bodies_.count(); ++rank) {
    if (bodies_[rank].flies()) {
      bodies_.arrive(bodies_[rank], time, bodies_[rank].stateAt(time));
    }
  }
  for (int rank = 0; rank < bodies_.count(); ++rank) {
    const Mover& body = bodies_[rank];
    bodies_.doubtAt(rank, time);
    if (body.steps() && body.group->leader() == rank) {
      body.group->endRun(time);
    }
  }
  bodies_.account().parted();
}

// Before their contacts are looked at: bodies that meet a crowd, too many that move, or endless repetition.
// An impact of any number of bodies without friction is a convex problem, and solved.
bool ExactWorld::goesOnAsCrowd(const Encounter& encounter) const {
  if (!encounter.crowds.empty()) {
    return true;
  }
  if (!bodies_.crowds().areAllowed()) {
    return false;
  }
  BodiesApart movable(articulationOf_);
  bool moves = false;
  bool rubs = bodies_.crowds().when == CrowdSettings::When::kAbove;  // asked for, whatever it costs
  for (const EncounterBody& each : encounter.bodies) {
    if (each.mover->isHeld()) {
      continue;
    }
    const Body& body = each.body();
    movable.add(each.listed());
    rubs = rubs || body.material.friction > 0;
    const double spin = angularVelocity(body.mass, each.before).norm();
    moves = moves || each.before.velocity.norm() + spin * radiusOf(body) > fallSpeed(bodies_, encounter);
    if (each.mover->atOneMoment > Bodies::kMostAtOneMoment) {
      return true;
    }
  }
  return moves && rubs && isTooMany(bodies_, movable.count());
}

bool ExactWorld::costsTooMuch(const Encounter& encounter) const {
  const auto isTooLarge = [&](const std::shared_ptr<IslandGroup>& island) {
    BodiesApart movable(articulationOf_);
    for (const int rank : island->ranks()) {
      if (!bodies_[rank].isHeld()) {
        movable.add(bodies_[rank].listed.value);
      }
    }
    return isTooMany(bodies_, movable.count());
  };
  return std::any_of(encounter.islands.begin(), encounter.islands.end(), isTooLarge) ||
         (!encounter.islands.empty() && bodies_.workLeft(encounter.ranks(), encounter.time) < 0);
}

}  // namespace careen
