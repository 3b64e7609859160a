#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "physics/exact/exact_world.h"

// Crowds: groups of the event queue as islands are, with steps of their own.

namespace careen {
namespace {

/// [s] What rounding leaves of a step's length.
constexpr double kMoment = 0x1p-40;
/// [1] of the tolerance: how far recorded steps may differ from those computed, so that fewer are recorded.
constexpr double kMerged = 0.25;
/// [1] of kMerged, without gravity: what moves slowly does so for long, and its momentum is all there is.
constexpr double kMergedAfloat = 0x1p-4;

}  // namespace

// ---- When bodies become a crowd.

// Before their contacts are looked at: bodies that meet a crowd, too many that move, or endless repetition.
// An impact of any number of bodies without friction is a convex problem, and solved.
bool ExactWorld::goesOnAsCrowd(const Encounter& encounter) const {
  if (!encounter.crowds.empty()) {
    return true;
  }
  if (crowds_.when == CrowdSettings::When::kNever) {
    return false;
  }
  int movable = 0;
  bool moves = false;
  bool rubs = crowds_.when == CrowdSettings::When::kAbove;  // asked for, whatever it costs
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    const Mover& body = mover(encounter.ranks[i]);
    if (body.isHeld()) {
      continue;
    }
    ++movable;
    rubs = rubs || body.body->material.friction > 0;
    const double spin = angularVelocity(body.body->mass, encounter.before[i]).norm();
    moves = moves || encounter.before[i].velocity.norm() + spin * radiusOf(*body.body) > fallSpeed(encounter);
    if (body.atOneMoment > kMostAtOneMoment) {
      return true;
    }
  }
  return moves && rubs && isTooMany(movable);
}

// For steps.
bool ExactWorld::isTooMany(int movable) const {
  return crowds_.when != CrowdSettings::When::kNever &&
         movable > (crowds_.when == CrowdSettings::When::kAbove ? crowds_.above : kMostInContact);
}

// Of what these bodies may spend on contact together; negative where they must go on as a crowd.
double ExactWorld::workLeft(std::span<const int> ranks, const Instant& time) const {
  if (crowds_.when == CrowdSettings::When::kNever) {
    return std::numeric_limits<double>::infinity();
  }
  double left = 0;
  for (const int rank : ranks) {
    if (!mover(rank).isHeld()) {
      left += workShare_ * (kWorkAtOnce + kWorkPerSecond * time.hi) - mover(rank).work;
    }
  }
  return left;
}

// ---- Members.

// The bodies of an encounter, and the crowds that they meet, are one crowd from there on.
void ExactWorld::formCrowd(const Encounter& encounter) {
  account_.bounds(encounter.time.hi);
  std::shared_ptr<ContactGroup> crowd;
  for (const std::shared_ptr<ContactGroup>& met : encounter.crowds) {
    if (encounter.crowds.size() == 1) {
      joinStep(met, encounter);
    }
    endAt(met, encounter.time);
    if (!crowd) {
      crowd = met;
    } else {
      merge(crowd, *met);
    }
  }
  if (!crowd) {
    crowd = std::make_shared<ContactGroup>();
    crowd->crowd = std::make_unique<Crowd>(world_, crowds_.tolerance, team_);
  }
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    enlist(crowd, encounter.ranks[i], encounter.time, encounter.before[i], encounter.attitudes[i]);
  }
  go(crowd, encounter.time);
}

// Whom a crowd meets within a step is a member from the start of that step, if it has been in Flight since:
// the shorter step would move the others elsewhere than to where they were met.
void ExactWorld::joinStep(const std::shared_ptr<ContactGroup>& crowd, const Encounter& encounter) {
  if (!earlier(encounter.time, crowd->end())) {
    return;
  }
  for (const int rank : encounter.ranks) {
    if (fliesSince(rank, crowd->start)) {
      admitOutsider(crowd, rank, crowd->start);
    }
  }
}

bool ExactWorld::restsSince(int rank, const Instant& time) const {
  const Mover& body = mover(rank);
  return !body.moves() && earlier(time, body.start);
}

bool ExactWorld::fliesSince(int rank, const Instant& time) const {
  const Mover& body = mover(rank);
  return body.flies && !body.crowd && springs_[static_cast<std::size_t>(rank)].empty() &&
         !earlier(time, body.start);
}

JoinedSteps ExactWorld::newPath() const {
  return JoinedSteps(kMerged * crowds_.tolerance * (world_.gravity.isZero(0) ? kMergedAfloat : 1));
}

void ExactWorld::keepPlace(const std::shared_ptr<ContactGroup>& crowd, int rank, std::size_t place) {
  if (place >= crowd->ranks.size()) {
    crowd->ranks.resize(place + 1, -1);
    crowd->joined.resize(place + 1, newPath());
    crowd->motions.resize(place + 1);
  }
  crowd->ranks[place] = rank;
  if (!mover(rank).isHeld()) {
    mover(rank).crowd = crowd;
    mover(rank).place = place;
  }
}

// Adds a body in this state, once, with those that springs join to it. Bodies at rest stay so until pushed.
void ExactWorld::enlist(const std::shared_ptr<ContactGroup>& crowd, int rank, const Instant& time,
                        const BodyState& state, const Quat& attitude) {
  Mover& body = mover(rank);
  if (body.crowd == crowd) {
    return;
  }
  if (!body.moves()) {
    enlistAtRest(crowd, rank);
    return;
  }
  if (body.flies) {
    arrive(body, time, state);
  }
  const double past = pastOf(*crowd, body, time);
  const JoinedSteps joined = comingFrom(body, time, state, attitude, past);
  body.rest(state.pose);
  const std::size_t place =
      crowd->crowd->admit(static_cast<std::size_t>(body.listed.value), state, attitude, 2 * past);
  keepPlace(crowd, rank, place);
  crowd->joined[place] = joined;
  for (const int other : springs_[static_cast<std::size_t>(rank)]) {
    const Quat turned = mover(other).attitudeAt(time);
    enlist(crowd, other, time, mover(other).stateAt(time, turned), turned);
  }
}

// [s] Of a body that becomes a member now: half a step of the crowd, in which members who met it bent their
// paths, if its last motion is as long.
double ExactWorld::pastOf(const ContactGroup& crowd, const Mover& body, const Instant& time) {
  return std::min(0.5 * crowd.before, secondsBetween(body.start, time));
}

// Its path from so long ago on.
JoinedSteps ExactWorld::comingFrom(const Mover& body, const Instant& time, const BodyState& state,
                                   const Quat& attitude, double length) const {
  JoinedSteps joined = newPath();
  if (length > 0) {
    const auto endAt = [&](const BodyState& at, const Quat& turned) {
      const Vec3 spin = at.pose.worldFromBody.transpose() * angularVelocity(body.body->mass, at);
      return StepEnd{
          .position = at.pose.position, .velocity = at.velocity, .worldFromBody = turned, .spinBody = spin};
    };
    const Instant begin = instantAfter(time, -length);
    const Quat turned = body.attitudeAt(begin);
    joined.follows(begin.hi, endAt(body.stateAt(begin, turned), turned), endAt(state, attitude), length);
  }
  return joined;
}

// Adds a body at rest or immovable, and all at rest that it touches, directly or through others: they are
// pushed together.
void ExactWorld::enlistAtRest(const std::shared_ptr<ContactGroup>& crowd, int rank) {
  std::vector<int> reached{rank};
  std::vector<Neighbors::Key> candidates;
  std::optional<std::size_t> cluster;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Mover& body = mover(reached[k]);
    const bool known =
        body.isHeld() ? std::find(crowd->ranks.begin(), crowd->ranks.end(), reached[k]) != crowd->ranks.end()
                      : body.crowd == crowd;
    if (!known) {
      const std::size_t place = crowd->crowd->admitAtRest(static_cast<std::size_t>(body.listed.value),
                                                          body.pose, body.isHeld() ? std::nullopt : cluster);
      keepPlace(crowd, reached[k], place);
      if (!body.isHeld()) {
        cluster = cluster.value_or(place);
      }
    }
    if (body.isHeld()) {
      continue;
    }
    neighbors_.findCandidates(reached[k], candidates);
    for (const Neighbors::Key candidate : candidates) {
      const Mover& other = mover(candidate);
      if (!other.moves() && !other.crowd &&
          std::find(reached.begin(), reached.end(), candidate) == reached.end() &&
          areTouching(boxAt(body.pose, *body.body), boxAt(other.pose, *other.body), crowds_.tolerance)) {
        reached.push_back(candidate);
      }
    }
  }
}

// Takes over all members of another crowd, whose step has ended.
void ExactWorld::merge(const std::shared_ptr<ContactGroup>& crowd, ContactGroup& other) {
  std::vector<std::optional<std::size_t>> clusters(other.ranks.size());
  for (std::size_t place = 0; place < other.ranks.size(); ++place) {
    const int rank = other.ranks[place];
    if (rank < 0) {
      continue;
    }
    Mover& body = mover(rank);
    if (body.isHeld()) {
      enlistAtRest(crowd, rank);
      continue;
    }
    if (other.crowd->sleeps(place)) {
      std::optional<std::size_t>& cluster =
          clusters[static_cast<std::size_t>(other.crowd->body(place).cluster)];
      const std::size_t at =
          crowd->crowd->admitAtRest(static_cast<std::size_t>(body.listed.value), body.pose, cluster);
      cluster = cluster.value_or(at);
      keepPlace(crowd, rank, at);
    } else {
      const std::size_t at =
          crowd->crowd->admit(static_cast<std::size_t>(body.listed.value), other.crowd->stateAtEnd(place),
                              other.crowd->attitude(place), other.before);
      keepPlace(crowd, rank, at);
      crowd->joined[at] = other.joined[place];
    }
  }
  other.ranks.clear();
}

// ---- Steps.

void ExactWorld::advanceCrowd(const std::shared_ptr<ContactGroup>& crowd, const Instant& time) {
  commit(*crowd, time);
  const std::vector<int> released = release(*crowd, time);
  if (crowd->crowd->atRest()) {
    for (const int rank : crowd->ranks) {
      if (rank >= 0 && !mover(rank).isHeld()) {
        mover(rank).crowd.reset();
      }
    }
  } else {
    go(crowd, time);
  }
  for (const int rank : released) {
    predict(rank);
  }
}

// Ends the crowd's step now, perhaps early: then in more than one, if it needs shorter ones. Members who
// joined that step go another way in it than they were expected to.
void ExactWorld::endAt(const std::shared_ptr<ContactGroup>& crowd, const Instant& time) {
  ContactGroup& group = *crowd;
  if (earlier(time, group.end())) {
    do {
      group.step.length = group.crowd->stepAgain(secondsBetween(group.start, time));
    } while (group.step.length > 0 && admitMet(crowd, group.start, true));
    while (secondsBetween(group.end(), time) > kMoment) {
      const Instant end = group.end();
      commit(group, end);
      group.start = end;
      group.step.length = group.crowd->step(secondsBetween(end, time));
    }
    account_.solvedCrowd(group.crowd->takeResiduals());
  }
  commit(group, time);
}

// Records the step that ends now. Members that fell asleep rest from now on.
void ExactWorld::commit(ContactGroup& group, const Instant& time) {
  const Crowd& crowd = *group.crowd;
  for (const Crowd::Struck& struck : crowd.impacts()) {
    const auto listed = [&](int place) { return mover(group.ranks[static_cast<std::size_t>(place)]).listed; };
    recorder_.strikes({.time = time.hi,
                       .a = listed(struck.a),
                       .b = struck.b.isWall() ? struck.b : Partner::ofBody(listed(struck.b.body()).value),
                       .point = struck.point,
                       .normal = struck.normal,
                       .approach = struck.approach,
                       .impulse = struck.impulse,
                       .tangential = struck.tangential});
  }
  const std::vector<char> suddenly = changedSuddenly(group);
  for (std::size_t place = 0; place < group.ranks.size(); ++place) {
    const int rank = group.ranks[place];
    if (rank < 0) {
      continue;
    }
    if (crowd.moved(place)) {
      endStep(group, place, suddenly);
    }
    // Perhaps without having moved: woken in this step, and asleep again when that was taken once more.
    if (crowd.sleeps(place) && mover(rank).moves()) {
      group.joined[place].flush(recorder_, mover(rank).listed);
      rest(rank, time, crowd.state(place).pose);
      queue_.clear(rank);
      predictAround(rank);
    }
  }
  group.before = group.step.length > 0 ? group.step.length : group.before;
}

// Only of interest where members are new.
std::vector<char> ExactWorld::changedSuddenly(const ContactGroup& group) {
  for (std::size_t place = 0; place < group.ranks.size(); ++place) {
    if (group.ranks[place] >= 0 && group.crowd->moved(place) && group.joined[place].isNew()) {
      return group.crowd->changedSuddenly();
    }
  }
  return {};
}

// What was no member before comes as it came, unless it is struck, or pushes what is: their paths begin
// alike.
void ExactWorld::endStep(ContactGroup& group, std::size_t place, std::span<const char> suddenly) {
  const Crowd& crowd = *group.crowd;
  JoinedSteps& joined = group.joined[place];
  const bool asItCame = joined.isNew() && suddenly[place] == 0;
  joined.add(recorder_, mover(group.ranks[place]).listed, group.start.hi, crowd.begin(place, asItCame),
             crowd.end(place), crowd.length(), crowd.body(place).radius, crowd.isSharp());
}

// Members that nothing is near go on in Flight.
std::vector<int> ExactWorld::release(ContactGroup& group, const Instant& time) {
  std::vector<int> released;
  for (std::size_t place = 0; place < group.ranks.size(); ++place) {
    const int rank = group.ranks[place];
    if (rank < 0 || !group.crowd->isFree(place) || isForced(rank)) {
      continue;
    }
    const BodyState state = group.crowd->state(place);
    const Quat attitude = group.crowd->attitude(place);
    group.joined[place].flush(recorder_, mover(rank).listed);
    group.crowd->dismiss(place);
    group.ranks[place] = -1;
    mover(rank).crowd.reset();
    fly(rank, time, state, attitude);
    released.push_back(rank);
  }
  account_.strikes(true);
  account_.parted();
  return released;
}

// The next step. What it will meet becomes a member first: that costs less than to cut the step.
void ExactWorld::go(const std::shared_ptr<ContactGroup>& group, const Instant& time) {
  Crowd& crowd = *group->crowd;
  const double most = withinCell(crowd.fastest());
  admitNear(group, time, crowd.nextLength(most));
  account_.strikes(true);
  for (std::size_t place = 0; place < group->ranks.size(); ++place) {
    if (group->ranks[place] >= 0 && !crowd.isHeld(place) && !crowd.sleeps(place)) {
      account_.departs(static_cast<std::size_t>(mover(group->ranks[place]).listed.value),
                       crowd.stateAtVelocity(place));
    }
  }
  account_.parted();
  group->start = time;
  group->step = {.length = crowd.step(std::min(most, withinCell(crowd.fastest())))};  // of those admitted too
  while (admitMet(group, time, false)) {
    group->step.length = crowd.stepAgain(crowd.length());
  }
  bool any = false;
  for (std::size_t place = 0; place < group->ranks.size(); ++place) {
    const int rank = group->ranks[place];
    if (rank < 0 || !crowd.moved(place)) {
      continue;
    }
    if (group->joined[place].isNew() && !mover(rank).moves()) {  // it was asleep
      group->joined[place] = comingFrom(mover(rank), time, {.pose = mover(rank).pose},
                                        crowd.begin(place).worldFromBody, pastOf(*group, mover(rank), time));
    }
    begins(rank, time);
    group->motions[place] = asContactStep(cubicStep(crowd.begin(place), crowd.end(place), crowd.length()));
    mover(rank).touch(group, place);
    queue_.clear(rank);
    if (neighbors_.isFiled(rank)) {
      neighbors_.move(rank, neighbors_.cellOf(crowd.body(place).position));
    }
    group->leader = any ? group->leader : rank;
    any = true;
  }
  account_.penetrates(crowd.deepest());
  account_.solvedCrowd(crowd.takeResiduals());
  if (any && earlier(group->end(), end_)) {
    queue_.set({.time = group->end(), .kind = EventKind::kStep, .body = group->leader});
  }
  for (const int rank : nearStep(*group)) {
    predict(rank);
  }
}

}  // namespace careen
