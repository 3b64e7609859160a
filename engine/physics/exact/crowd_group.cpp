#include "physics/exact/crowd_group.h"

#include <algorithm>
#include <cmath>

#include "physics/exact/crowd_meetings.h"
#include "physics/exact/crowd_motors.h"
#include "physics/exact/crowd_paths.h"
#include "physics/exact/encounter.h"
#include "physics/geometry/separation.h"
#include "physics/motion/hermite_step.h"

namespace careen {
namespace {

/// [s] What rounding leaves of a step's length.
constexpr double kMoment = 0x1p-40;
std::size_t listedOf(const Mover& body) { return static_cast<std::size_t>(body.listed.value); }

}  // namespace

CrowdGroup::CrowdGroup(Bodies& bodies, const Instant& time)
    : bodies_(bodies), crowd_(bodies.world(), bodies.crowds().tolerance, bodies.team(), time.hi) {}

bool CrowdGroup::enter(Encounter& encounter, int /*rank*/) {
  const auto self = std::static_pointer_cast<CrowdGroup>(shared_from_this());
  if (std::find(encounter.crowds.begin(), encounter.crowds.end(), self) == encounter.crowds.end()) {
    encounter.crowds.push_back(self);
  }
  return false;
}

bool CrowdGroup::seesTo(std::size_t /*place*/, int /*box*/, const BoxOf& other) const {
  return has(bodies_[other.body]) || !restsOnlySince(bodies_[other.body], start_);
}

// ---- Members.

void CrowdGroup::form(Bodies& bodies, const Encounter& encounter) {
  bodies.account().bounds(encounter.time.hi);
  std::shared_ptr<CrowdGroup> crowd;
  for (const std::shared_ptr<CrowdGroup>& met : encounter.crowds) {
    if (encounter.crowds.size() == 1) {
      met->joinStep(encounter);
    }
    met->endAt(encounter.time);
    if (!crowd) {
      crowd = met;
    } else {
      crowd->merge(*met, encounter.time);
    }
  }
  if (!crowd) {
    crowd = std::make_shared<CrowdGroup>(bodies, encounter.time);
  }
  for (const EncounterBody& body : encounter.bodies) {
    crowd->enlist(body.mover->rank, encounter.time, body.before, body.attitude);
  }
  crowd->go(encounter.time);
  for (const EncounterBody& body : encounter.bodies) {
    if (body.mover->isDriven()) {
      bodies.predict(body.mover->rank);
    }
  }
}

// Whom it meets within a step is a member from the start of that step, if it has been in Flight since: the
// shorter step would move the others elsewhere than to where they were met.
void CrowdGroup::joinStep(const Encounter& encounter) {
  if (!earlier(encounter.time, end())) {
    return;
  }
  for (const EncounterBody& body : encounter.bodies) {
    if (fliesSince(bodies_, *body.mover, start_)) {
      admitOutsider(body.mover->rank, start_);
    }
  }
}

void CrowdGroup::keepPlace(int rank, std::size_t place) {
  if (place >= ranks_.size()) {
    ranks_.resize(place + 1, -1);
    joined_.resize(place + 1, newPath(bodies_, rank));
    motions_.resize(place + 1);
  }
  ranks_[place] = rank;
  joined_[place] = newPath(bodies_, rank);
  if (!bodies_[rank].isHeld()) {
    if (bodies_[rank].wall) {  // it sees to that
      bodies_.queue().clear(rank);
    }
    bodies_[rank].group = shared_from_this();
    bodies_[rank].place = place;
    bodies_[rank].doubt.atLeast(bodies_.crowds().tolerance);
  }
}

// Adds a body in this state, once, with those that are joined to it. Bodies at rest stay so until pushed, but
// for those whose joints may just have changed.
void CrowdGroup::enlist(int rank, const Instant& time, const BodyState& state, const Quat& attitude) {
  Mover& body = bodies_[rank];
  if (has(body) || !body.isBox()) {  // it has all walls
    return;
  }
  if (body.isDriven()) {
    if (std::find(ranks_.begin(), ranks_.end(), rank) == ranks_.end()) {
      const BodyState now = body.stateAt(time);
      keepPlace(rank, crowd_.admit(listedOf(body), now, Quat(now.pose.worldFromBody), 0, body.drivenBy));
    }
    return;
  }
  if (!body.moves() && (body.isHeld() || !isJointed(bodies_.world(), body.listed.value))) {
    enlistAtRest(rank);
    return;
  }
  if (body.flies()) {
    bodies_.arrive(body, time, state);
  }
  const double past = pastOf(body, time);
  const JoinedSteps joined = pathFrom(bodies_, body, time, state, attitude, past);
  body.rest(state.pose);
  const std::size_t place = crowd_.admit(listedOf(body), state, attitude, 2 * past);
  keepPlace(rank, place);
  joined_[place] = joined;
  for (const int other : bodies_.joinedTo(rank)) {
    const Quat turned = bodies_[other].attitudeAt(time);
    enlist(other, time, bodies_[other].stateAt(time, turned), turned);
  }
}

// Adds a body at rest or immovable, and all at rest that it touches or is joined to, directly or through
// others: they are pushed together.
void CrowdGroup::enlistAtRest(int rank) {
  std::vector<int> reached{rank};
  std::optional<std::size_t> cluster;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Mover& body = bodies_[reached[k]];
    const bool known =
        body.isHeld() ? std::find(ranks_.begin(), ranks_.end(), reached[k]) != ranks_.end() : has(body);
    if (!known) {
      const std::size_t place =
          crowd_.admitAtRest(listedOf(body), body.pose, body.isHeld() ? std::nullopt : cluster);
      keepPlace(reached[k], place);
      if (!body.isHeld()) {
        cluster = cluster.value_or(place);
      }
    }
    if (body.isHeld()) {
      continue;
    }
    const auto reach = [&](int candidate) {
      const Mover& other = bodies_[candidate];
      if (!other.moves() && !other.group &&
          std::find(reached.begin(), reached.end(), candidate) == reached.end()) {
        reached.push_back(candidate);
      }
    };
    for (const int other : bodies_.joinedTo(reached[k])) {
      reach(other);
    }
    for (const int candidate : bodies_.around(reached[k])) {
      const Mover& other = bodies_[candidate];
      if (mayTouch(bodies_.world(), body.listed.value, other.listed.value) &&
          areTouching(*body.body, body.pose, *other.body, other.pose, bodies_.crowds().tolerance)) {
        reach(candidate);
      }
    }
  }
}

// Takes over all members of another crowd, whose step has ended.
void CrowdGroup::merge(CrowdGroup& other, const Instant& time) {
  std::vector<std::optional<std::size_t>> clusters(other.ranks_.size());
  for (std::size_t place = 0; place < other.ranks_.size(); ++place) {
    const int rank = other.ranks_[place];
    if (rank < 0) {
      continue;
    }
    const Mover& body = bodies_[rank];
    if (body.isDriven()) {
      enlist(rank, time, {}, {});
      continue;
    }
    if (body.isHeld()) {
      enlistAtRest(rank);
      continue;
    }
    if (other.crowd_.sleeps(place)) {
      std::optional<std::size_t>& cluster =
          clusters[static_cast<std::size_t>(other.crowd_.body(place).cluster)];
      const std::size_t at = crowd_.admitAtRest(listedOf(body), body.pose, cluster);
      cluster = cluster.value_or(at);
      keepPlace(rank, at);
    } else {
      const std::size_t at = crowd_.admit(listedOf(body), other.crowd_.stateAtEnd(place),
                                          other.crowd_.attitude(place), other.before_);
      keepPlace(rank, at);
      joined_[at] = other.joined_[place];
      motions_[at] = other.motions_[place];  // others may look for it before it takes the next step
    }
  }
  owed_ += other.owed_;
  other.ranks_.clear();
}

// Admits what its members meet within the next step if nothing pushes them, bodies at rest near them, and no
// larger crowds that are near in some steps.
void CrowdGroup::admitNear(const Instant& time, double length) {
  const double ahead = kStepsAhead * length;
  for (bool added = true; added;) {
    added = false;
    for (const int rank : outsidersIn(bodies_, *this, crowd_.extent(ahead), time, ahead, Outsiders::kAll)) {
      if (!has(bodies_[rank]) && meetsNext(bodies_, *this, rank, time, length)) {
        admitOutsider(rank, time);
        added = true;
      }
    }
  }
}

// With those that it is in contact with, and all that springs join to them.
void CrowdGroup::admitOutsider(int rank, const Instant& time) {
  Encounter with;
  with.time = time;
  join(bodies_, with, rank);
  for (const std::shared_ptr<CrowdGroup>& other : with.crowds) {
    if (other.get() != this) {
      other->endAt(time);
      merge(*other, time);
    }
  }
  for (const EncounterBody& body : with.bodies) {
    enlist(body.mover->rank, time, body.before, body.attitude);
  }
}

// Admits whom its members, pushed otherwise than expected, met in the step that they have taken: bodies at
// rest and members of other crowds, none of which look for contacts; if it was taken again, in place of the
// latter those who had looked when it was another. Returns whether there were any.
bool CrowdGroup::admitMet(const Instant& time, Taken taken) {
  const bool again = taken == Taken::kAgain;
  bool any = false;
  for (const int rank : outsidersIn(bodies_, *this, crowd_.swept(), time, crowd_.length(),
                                    again ? Outsiders::kInNoGroup : Outsiders::kAll)) {
    const Mover& body = bodies_[rank];
    const bool asked =
        again ? !body.group && (body.moves() ? fliesSince(bodies_, body, time) : !restsOnlySince(body, time))
              : !has(body) && !body.flies();
    if (asked && wasMet(bodies_, *this, rank, time)) {
      admitOutsider(rank, time);
      any = true;
    }
  }
  return any;
}

// Members that nothing is near go on in Flight.
std::vector<int> CrowdGroup::release(const Instant& time) {
  std::vector<int> released;
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    const int rank = ranks_[place];
    if (rank < 0 || !crowd_.isFree(place) || bodies_.isForced(rank)) {
      continue;
    }
    const BodyState state = crowd_.state(place);
    const Quat attitude = crowd_.attitude(place);
    joined_[place].flush(bodies_.recorder(), bodies_[rank].listed);
    crowd_.dismiss(place);
    ranks_[place] = -1;
    bodies_.fly(rank, time, state, attitude);
    released.push_back(rank);
  }
  bodies_.account().mayLose();
  bodies_.account().parted();
  return released;
}

// ---- Paths.

// [s] Of a body that becomes a member now: half a step of the crowd, in which members who met it bent their
// paths, if its last motion is as long.
double CrowdGroup::pastOf(const Mover& body, const Instant& time) const {
  return std::min(0.5 * before_, secondsBetween(body.start, time));
}

// Only of interest where members are new.
std::vector<char> CrowdGroup::changedSuddenly() const {
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    if (ranks_[place] >= 0 && crowd_.moved(place) && joined_[place].isNew()) {
      return crowd_.changedSuddenly();
    }
  }
  return {};
}

// What was no member before comes as it came, unless it is struck, or pushes what is: their paths begin
// alike.
void CrowdGroup::endStep(std::size_t place, const std::vector<char>& suddenly) {
  JoinedSteps& joined = joined_[place];
  const bool asItCame = joined.isNew() && suddenly[place] == 0;
  joined.add(bodies_.recorder(), bodies_[ranks_[place]].listed, start_.hi,
             asItCame ? crowd_.beginAsItCame(place) : crowd_.begin(place), crowd_.end(place), crowd_.length(),
             crowd_.body(place).radius,
             crowd_.isSharp() ? JoinedSteps::Begin::kCorner : JoinedSteps::Begin::kRounded);
}

// ---- Steps.

std::optional<Encounter> CrowdGroup::advance(const Instant& time) {
  commit(time);
  const std::vector<int> released = release(time);
  if (crowd_.atRest()) {
    letGo();
  } else {
    go(time);
  }
  for (const int rank : released) {
    bodies_.predict(rank);
  }
  return std::nullopt;
}

// All that it has rest; what is driven comes to them from now on.
void CrowdGroup::letGo() {
  for (const int rank : ranks_) {
    if (rank >= 0) {
      bodies_[rank].group.reset();
    }
  }
  for (const int rank : ranks_) {
    if (rank >= 0 && (bodies_[rank].isDriven() || bodies_[rank].wall)) {
      bodies_.predict(rank);
    }
  }
}

bool CrowdGroup::isAnyDriven() const {
  const auto isDriven = [&](int rank) { return rank >= 0 && bodies_[rank].isDriven(); };
  return std::any_of(ranks_.begin(), ranks_.end(), isDriven) ||
         std::any_of(bodies_.walls().begin(), bodies_.walls().end(),
                     [](const Mover& wall) { return wall.isDriven(); });
}

// Ends its step now, perhaps early: then in more than one, if it needs shorter ones. Members who joined that
// step go another way in it than they were expected to.
void CrowdGroup::endAt(const Instant& time) {
  if (earlier(time, end())) {
    do {
      length_ = stepAgain(start_, secondsBetween(start_, time));
    } while (length_ > 0 && admitMet(start_, Taken::kAgain));
    while (secondsBetween(end(), time) > kMoment) {
      const Instant next = end();
      commit(next);
      start_ = next;
      length_ = step(next, secondsBetween(next, time));
    }
    bodies_.account().solvedCrowd(crowd_.takeResiduals());
  }
  commit(time);
}

// Of the joints that act then, of the members of now; in equal steps until one of them changes: speeds, as
// motors are told them, are means over a step, and nothing is left of them in a very short one.
double CrowdGroup::step(const Instant& from, double most) {
  crowd_.articulations().list(from.hi);
  const double change = untilChange(bodies_, crowd_, from);
  if (change > kMoment && std::isfinite(change)) {
    most = std::min(most, change / std::ceil((1 - kMoment) * change / crowd_.nextLength(most)));
  }
  return crowd_.step(most, from.hi);
}

// Where new members are joined, and turn fast, a shorter one.
double CrowdGroup::stepAgain(const Instant& from, double length) {
  crowd_.articulations().list(from.hi);
  return crowd_.stepAgain(crowd_.articulations().any() ? crowd_.nextLength(length) : length);
}

// Records the step that ends now. Members that fell asleep rest from now on.
void CrowdGroup::commit(const Instant& time) {
  const auto rankOf = [&](int place) {  // the walls have the first places
    const auto walls = static_cast<int>(bodies_.walls().size());
    return place < walls ? bodies_.count() + place : ranks_[static_cast<std::size_t>(place)];
  };
  for (const Crowd::Struck& struck : crowd_.impacts()) {
    bodies_.strike(time, rankOf(struck.a), rankOf(struck.b), struck.point,
                   {.approach = struck.approach,
                    .impulse = struck.impulse,
                    .tangential = struck.tangential,
                    .normal = struck.normal});
  }
  const double half = 0.5 * workOfMotors(crowd_);  // velocities are those of the middle of the step
  bodies_.account().gives(owed_ + half);
  owed_ = half;
  const std::vector<char> suddenly = changedSuddenly();
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    const int rank = ranks_[place];
    if (rank < 0) {
      continue;
    }
    if (crowd_.moved(place)) {
      endStep(place, suddenly);
    }
    // Perhaps without having moved: woken in this step, and asleep again when that was taken once more.
    if (crowd_.sleeps(place) && bodies_[rank].moves()) {
      joined_[place].flush(bodies_.recorder(), bodies_[rank].listed);
      bodies_.sleep(rank, time, crowd_.state(place).pose);
      bodies_.queue().clear(rank);
      bodies_.predictAround(rank);
    }
  }
  before_ = length_ > 0 ? length_ : before_;
}

// The next step. What it will meet becomes a member first: that costs less than to cut the step.
void CrowdGroup::go(const Instant& time) {
  const double most = bodies_.withinCell(crowd_.fastest());
  admitNear(time, crowd_.nextLength(most));
  bodies_.account().mayLose();
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    if (ranks_[place] >= 0 && !crowd_.body(place).held() && !crowd_.sleeps(place)) {
      bodies_.account().departs(listedOf(bodies_[ranks_[place]]), crowd_.stateAtVelocity(place));
    }
  }
  bodies_.account().parted();
  start_ = time;
  length_ = step(time, std::min(most, bodies_.withinCell(crowd_.fastest())));  // of those admitted too
  while (admitMet(time, Taken::kFirst)) {
    length_ = stepAgain(time, crowd_.length());
  }
  bool any = false;
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    if (ranks_[place] >= 0 && crowd_.moved(place)) {
      takeStep(place);
      leader_ = any ? leader_ : ranks_[place];
      any = true;
    }
  }
  bodies_.account().penetrates(crowd_.deepest());
  bodies_.account().solvedCrowd(crowd_.takeResiduals());
  if (any && earlier(end(), bodies_.end())) {
    bodies_.queue().set({.time = end(), .kind = EventKind::kStep, .body = leader_});
  }
  if (!any && isAnyDriven()) {  // those that moved have left it: it takes no more steps
    letGo();
  }
  for (const int rank : nearStep(bodies_, *this)) {
    bodies_.predict(rank);
  }
}

// A member moves in the step that begins.
void CrowdGroup::takeStep(std::size_t place) {
  const int rank = ranks_[place];
  const Mover& body = bodies_[rank];
  if (joined_[place].isNew() && !body.moves()) {  // it was asleep
    joined_[place] = pathFrom(bodies_, body, start_, {.pose = body.pose}, crowd_.begin(place).worldFromBody,
                              pastOf(body, start_));
  }
  motions_[place] = asContactStep(cubicStep(crowd_.begin(place), crowd_.end(place), crowd_.length()));
  bodies_.step(shared_from_this(), place);
  bodies_.queue().clear(rank);
  bodies_.file(rank, crowd_.body(place).position);
}

// Velocities are those of the middle of its step; what was not touched in it has felt its loads since.
void CrowdGroup::dissolve(Encounter& encounter) {
  endAt(encounter.time);
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    const int rank = ranks_[place];
    if (rank < 0 || bodies_[rank].isHeld()) {
      continue;
    }
    joined_[place].flush(bodies_.recorder(), bodies_[rank].listed);
    encounter.bodies.push_back({.mover = &bodies_[rank],
                                .attitude = crowd_.attitude(place),
                                .before = crowd_.memory().places[place].untouchedSteps > 0
                                              ? crowd_.stateAtEnd(place)
                                              : crowd_.state(place)});
  }
  ranks_.clear();
}

// Its energy is known at the ends of its steps.
void CrowdGroup::endRun(const Instant& /*time*/) {
  const std::vector<char> suddenly = changedSuddenly();
  for (std::size_t place = 0; place < ranks_.size(); ++place) {
    if (ranks_[place] >= 0 && bodies_[ranks_[place]].steps()) {
      endStep(place, suddenly);
      joined_[place].flush(bodies_.recorder(), bodies_[ranks_[place]].listed);
    }
  }
}

}  // namespace careen
