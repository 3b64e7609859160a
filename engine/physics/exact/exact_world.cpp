#include "physics/exact/exact_world.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "core/error.h"
#include "core/names.h"
#include "physics/exact/next_contact.h"
#include "physics/motion/hermite_step.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

constexpr double kUsualTolerance = 1e-6;  // [m]

std::vector<double> radiiOf(const World& world) {
  std::vector<double> radii;
  radii.reserve(world.bodies.size());
  for (const Body& body : world.bodies) {
    radii.push_back(radiusOf(body));
  }
  return radii;
}

// [s] Of bodies in contact: some times that in which they fall, or move, their own size; a second where
// nothing tells a time.
double longestStepOf(const World& world) {
  constexpr double kSizes = 64;
  double largest = 0;
  for (const Body& body : world.bodies) {
    largest = std::max(largest, isImmovable(body.mass) ? 0 : radiusOf(body));
  }
  const double longest = largest > 0 ? timeScaleOf(world, kSizes * largest) : 1;
  return std::isfinite(longest) ? longest : 1;
}

}  // namespace

ExactWorld::ExactWorld(const World& world, const RunSettings& settings, Recorder& recorder)
    : world_(world),
      end_(settings.duration),
      tolerance_(settings.tolerance),
      crowds_(settings.crowds),
      team_(std::make_shared<Team>(settings.threads)),
      timeScale_(timeScaleOf(world, settings.tolerance)),
      longestStep_(longestStepOf(world)),
      recorder_(recorder),
      neighbors_(radiiOf(world)),
      queue_(world.bodies.size()),
      account_(world),
      forced_(world.bodies.size(), world.drag ? 1 : 0),
      springs_(world.bodies.size()) {
  std::vector<int> rankOf(world.bodies.size());
  double movable = 0;
  for (const std::size_t listed : orderByName(world.bodies)) {
    rankOf[listed] = static_cast<int>(movers_.size());
    Mover& mover = movers_.emplace_back();
    mover.body = &world.bodies[listed];
    mover.listed = {static_cast<int>(listed)};
    movable += mover.isHeld() ? 0 : 1;
  }
  const double part = kUnshared / std::max(1.0, movable);
  workShare_ = part * std::min(1.0, part) * std::sqrt(std::max(1.0, kUsualTolerance / tolerance_));
  for (const Spring& spring : world.springs) {
    for (const SpringEnd* end : {&spring.from, &spring.to}) {
      const SpringEnd& other = end == &spring.from ? spring.to : spring.from;
      if (end->body) {
        const auto rank = static_cast<std::size_t>(rankOf[static_cast<std::size_t>(*end->body)]);
        forced_[rank] = 1;
        if (other.body) {
          springs_[rank].push_back(rankOf[static_cast<std::size_t>(*other.body)]);
        }
      }
    }
  }
}

// The event loop, from here to end().

RunFigures ExactWorld::run(const std::stop_token& stop) {
  begin();
  for (std::optional<Event> event = queue_.next(); event && !earlier(end_, event->time);
       event = queue_.next()) {
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    recorder_.reaches(event->time.hi);
    happen(*event);
  }
  end();
  return account_.figures();
}

void ExactWorld::begin() {
  for (int rank = 0; rank < static_cast<int>(movers_.size()); ++rank) {
    const Body& body = *mover(rank).body;
    neighbors_.insert(rank, body.initial.pose.position, radiusOf(body));
    if (mover(rank).isHeld()) {
      rest(rank, {}, body.initial.pose);
    } else {
      fly(rank, {}, body.initial, Quat(body.initial.pose.worldFromBody).normalized());
    }
  }
  account_.parted();
  for (int rank = 0; rank < static_cast<int>(movers_.size()); ++rank) {
    predict(rank);
  }
}

void ExactWorld::happen(const Event& event) {
  if (event.kind == EventKind::kCrossing) {
    neighbors_.move(event.body, mover(event.body).crossing.cell);
    findCrossing(mover(event.body), event.body);
    predict(event.body);
  } else if (!event.partner.isWall() && mover(event.partner.body()).motion != event.partnerMotion) {
    predict(event.body);
  } else if (event.kind == EventKind::kStep &&
             mover(event.body).contactGroup->step.end == Island::End::kGoesOn) {
    const std::shared_ptr<ContactGroup> group = mover(event.body).contactGroup;  // its bodies may leave it
    if (group->crowd) {
      advanceCrowd(group, event.time);
    } else {
      advance(group, event.time);
    }
  } else {
    Encounter encounter = gather(event);
    if (goesOnAsCrowd(encounter)) {
      formCrowd(encounter);
      return;
    }
    try {
      findContacts(event, encounter);
      resolve(encounter);
      settle(encounter);
    } catch (const NumericalError&) {
      if (crowds_.when == CrowdSettings::When::kNever) {
        throw;
      }
      formCrowd(encounter);
      return;
    }
    if (encounter.isTooMany ||
        (!encounter.islands.empty() && workLeft(encounter.ranks, encounter.time) < 0)) {
      formCrowd(encounter);
      return;
    }
    account_.solved(encounter.residuals);
    record(encounter);
    moveOn(encounter);
  }
}

// Starts the next motions of the event's bodies and predicts their next events, and only theirs.
void ExactWorld::moveOn(Encounter& encounter) {
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    if (encounter.next[i] == Next::kRests) {
      stand(encounter, i);
      rest(encounter.ranks[i], encounter.since[i], encounter.after[i].pose);
    } else if (encounter.next[i] == Next::kFlies) {
      fly(encounter.ranks[i], encounter.time, encounter.after[i], encounter.attitudes[i]);
    }
  }
  for (const std::shared_ptr<ContactGroup>& contactGroup : encounter.islands) {
    touch(contactGroup, encounter.time);
  }
  account_.parted();
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    predict(encounter.ranks[i]);
    if (encounter.next[i] == Next::kRests) {
      predictAround(encounter.ranks[i]);
    }
  }
}

// A body at rest predicts no contacts: the moving bodies around it must.
void ExactWorld::predictAround(int rank) {
  std::vector<Neighbors::Key> around;
  neighbors_.findCandidates(rank, around);
  for (const Neighbors::Key candidate : around) {
    if (mover(candidate).moves()) {
      predict(candidate);
    }
  }
}

void ExactWorld::end() {
  bool mayLose = false;
  for (const Mover& body : movers_) {
    if (body.flies) {
      arrive(body, end_, body.stateAt(end_));
    }
  }
  const ContactGroup* last = nullptr;
  std::vector<char> suddenly;  // of its members
  for (Mover& body : movers_) {
    if (body.touches()) {
      if (body.contactGroup->crowd) {  // whose energy is known at the ends of its steps
        if (body.contactGroup.get() != last) {
          last = body.contactGroup.get();
          suddenly = changedSuddenly(*last);
        }
        endStep(*body.contactGroup, body.place, suddenly);
        body.contactGroup->joined[body.place].flush(recorder_, body.listed);
        continue;
      }
      account_.departs(static_cast<std::size_t>(body.listed.value), body.stateAt(end_));
      mayLose = mayLose || body.contactGroup->island->mayLose();
    }
  }
  account_.strikes(mayLose);
  account_.parted();
}

// ---- Motions.

void ExactWorld::fly(int rank, const Instant& time, const BodyState& state, const Quat& attitude) {
  Mover& body = mover(rank);
  begins(rank, time);
  body.fly(state, attitude, world_.gravity);
  recorder_.moves(body.listed, time.hi, body.flight);
  account_.departs(static_cast<std::size_t>(body.listed.value), state);
  body.wall = firstWall(body, rank, world_.walls, end_);
  body.crossing = {};
  findCrossing(body, rank);
}

// Through all the hops that are too short to follow and end before it rests: none is as high as its rounding.
void ExactWorld::stand(const Encounter& encounter, std::size_t index) {
  const double length = secondsBetween(encounter.time, encounter.since[index]);
  if (length > 0) {
    const StepEnd still{.position = encounter.after[index].pose.position,
                        .worldFromBody = encounter.attitudes[index]};
    recorder_.moves(mover(encounter.ranks[index]).listed, encounter.time.hi,
                    hermiteStep(still, still, length));
  }
}

void ExactWorld::rest(int rank, const Instant& time, const Pose& pose) {
  Mover& body = mover(rank);
  begins(rank, time);
  body.rest(pose);
  recorder_.moves(body.listed, time.hi, Rest{pose});
  account_.departs(static_cast<std::size_t>(body.listed.value), {.pose = pose});
}

// Takes the next step of an island. Returns false if its bodies go on as a crowd instead.
bool ExactWorld::step(ContactGroup& contactGroup, const Instant& time) {
  Island& island = *contactGroup.island;
  double movable = 0;
  for (const TouchingBody& body : island.bodies()) {
    movable += body.isHeld() ? 0 : 1;
  }
  const std::vector<TouchingBody> before = island.bodies();
  const auto spend = [&] {
    for (std::size_t i = 0; i < before.size(); ++i) {
      mover(contactGroup.ranks[i]).work += before[i].isHeld() ? 0 : island.work() / movable;
    }
  };
  try {
    // Not bounded by the end of the run, on which the motion must not depend.
    contactGroup.step = island.step(longestStep_, workLeft(contactGroup.ranks, time));
  } catch (const NumericalError&) {
    if (crowds_.when == CrowdSettings::When::kNever) {
      throw;
    }
    spend();
    Encounter encounter;
    encounter.time = time;
    for (std::size_t i = 0; i < before.size(); ++i) {
      encounter.ranks.push_back(contactGroup.ranks[i]);
      encounter.attitudes.push_back(before[i].worldFromBody);
      encounter.before.push_back(before[i].state());
    }
    formCrowd(encounter);
    return false;
  }
  spend();
  for (const TouchingBody& body : before) {
    if (!body.isHeld()) {
      account_.departs(static_cast<std::size_t>(body.index), body.state());
    }
  }
  return true;
}

// Takes the next step of an island and records the motion of its bodies in it.
void ExactWorld::touch(const std::shared_ptr<ContactGroup>& contactGroup, const Instant& time) {
  const Island& island = *contactGroup->island;
  contactGroup->start = time;
  if (!step(*contactGroup, time)) {
    return;
  }
  contactGroup->motions.resize(contactGroup->ranks.size());
  bool any = false;
  for (std::size_t i = 0; i < contactGroup->ranks.size(); ++i) {
    if (island.bodies()[i].isHeld()) {
      continue;
    }
    const int rank = contactGroup->ranks[i];
    Mover& body = mover(rank);
    contactGroup->leader = any ? contactGroup->leader : rank;
    any = true;
    begins(rank, time);
    contactGroup->motions[i] = island.motion(i);
    body.touch(contactGroup, i);
    recorder_.moves(body.listed, time.hi, contactGroup->motions[i]);
    if (neighbors_.isFiled(rank)) {
      neighbors_.move(rank, neighbors_.cellOf(body.positionAt(time)));
    }
    findCrossing(body, rank);
  }
  account_.penetrates(island.deepest());
  account_.solved(contactGroup->island->takeResiduals());
  record(*contactGroup);
}

void ExactWorld::advance(const std::shared_ptr<ContactGroup>& contactGroup, const Instant& time) {
  account_.strikes(contactGroup->island->mayLose());
  touch(contactGroup, time);
  account_.parted();
  for (const int rank : contactGroup->ranks) {
    if (!mover(rank).isHeld()) {
      predict(rank);
    }
  }
}

// [s] Time in which a body of this speed does not leave the margin of its cell.
double ExactWorld::withinCell(double speed) const {
  if (!(neighbors_.cellEdge() > 0)) {
    return longestStep_;
  }
  const double margin = neighbors_.cellEdge() / 32;
  const double acceleration = 8 * world_.gravity.norm();
  // speed t + acceleration t²/2 ≤ margin
  return speed + acceleration > 0
             ? std::min(longestStep_,
                        2 * margin / (speed + std::sqrt(speed * speed + 2 * acceleration * margin)))
             : longestStep_;
}

void ExactWorld::begins(int rank, const Instant& time) {
  Mover& body = mover(rank);
  const bool again = body.motion > 0 && !earlier(body.start, time);
  body.atOneMoment = again ? body.atOneMoment + 1 : 0;
  if (body.atOneMoment > 2 * kMostAtOneMoment) {
    throw NumericalError(where(rank, time) + "collides again and again without time passing");
  }
  body.start = time;
  ++body.motion;
}

void ExactWorld::arrive(const Mover& body, const Instant& time, const BodyState& state) {
  account_.arrives(static_cast<std::size_t>(body.listed.value), state, body.elapsed(time));
}

// ---- Prediction of events.

void ExactWorld::predict(int rank) {
  const Mover& body = mover(rank);
  if (!body.moves()) {
    queue_.clear(rank);
    return;
  }
  if (body.flies && isForced(rank)) {  // has just begun, and has yet to feel springs and drag
    queue_.set({.time = body.start, .kind = EventKind::kTouching, .body = rank});
    return;
  }
  std::optional<Event> first = body.wall;
  if (body.touches() && body.contactGroup->leader == rank && earlier(body.contactGroup->end(), end_)) {
    first = {.time = body.contactGroup->end(), .kind = EventKind::kStep, .body = rank};
  }
  if (body.crosses) {
    sooner(
        first,
        {.time = instantAfter(body.start, body.crossing.time), .kind = EventKind::kCrossing, .body = rank});
  }
  neighbors_.findCandidates(rank, candidates_);
  if (body.crowd) {  // what it meets is found when it takes its step, but for what comes to rest within it
    std::erase_if(candidates_, [&](Neighbors::Key candidate) {
      return mover(candidate).crowd == body.crowd || !restsSince(candidate, body.contactGroup->start);
    });
  }
  for (const Neighbors::Key candidate : candidates_) {
    if (body.touches() && seesTo(*body.contactGroup, body.place, candidate)) {
      continue;
    }
    const std::optional<Event> met =
        firstMeeting(body, rank, mover(candidate), candidate, first ? first->time : end_);
    if (met) {
      sooner(first, *met);
    }
  }
  if (first) {
    queue_.set(*first);
  } else {
    queue_.clear(rank);
  }
}

// Whether the island itself handles contact with that body.
bool ExactWorld::seesTo(const ContactGroup& contactGroup, std::size_t place, int rank) {
  const auto other = std::find(contactGroup.ranks.begin(), contactGroup.ranks.end(), rank);
  return other != contactGroup.ranks.end() &&
         contactGroup.island->handlesPair(place,
                                          static_cast<std::size_t>(other - contactGroup.ranks.begin()));
}

void ExactWorld::sooner(std::optional<Event>& first, const Event& candidate) {
  if (!first || earlier(candidate.time, first->time)) {
    first = candidate;
  }
}

void ExactWorld::findCrossing(Mover& body, int rank) {
  body.crosses = neighbors_.isFiled(rank) && movers_.size() > 1;
  if (!body.crosses) {
    return;
  }
  const Cell& cell = neighbors_.cell(rank);
  if (body.touches()) {
    body.crossing = neighbors_.nextCrossing(body.contactGroup->motions[body.place], body.speedBound, cell,
                                            body.crossing.time);
  } else {
    body.crossing = neighbors_.nextCrossing(body.flight.position, body.flight.velocity,
                                            body.flight.acceleration, cell, body.crossing.time);
  }
}

std::string ExactWorld::where(int rank, const Instant& time) const {
  std::ostringstream text;
  text << "at " << time.hi << " s box " << mover(rank).body->name << ' ';
  return text.str();
}

}  // namespace careen
