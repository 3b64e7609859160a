#include "physics/exact_world.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.h"
#include "physics/contact_points.h"
#include "physics/next_contact.h"
#include "physics/separation.h"
#include "physics/settling.h"
#include "physics/wall_contacts.h"

namespace careen {
namespace {

// Events that may happen to one body at one moment before the run gives up: more than any impact needs, and
// an end to what would go on for ever.
constexpr int kMostAtOneMoment = 1000;

constexpr const char* kNeedsContact =
    ". That takes the motion Contact, which method exact does not have; end the run before it, or give the "
    "pair more restitution";

std::vector<std::size_t> ranked(const World& world) {
  std::vector<std::size_t> order(world.bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&world](std::size_t a, std::size_t b) { return world.bodies[a].name < world.bodies[b].name; });
  return order;
}

std::vector<double> radiiOf(const World& world) {
  std::vector<double> radii;
  radii.reserve(world.bodies.size());
  for (const Body& body : world.bodies) {
    radii.push_back(body.halfExtents.norm());
  }
  return radii;
}

bool movesAlike(const BodyState& x, const BodyState& y) {
  return x.velocity == y.velocity && x.angularMomentum == y.angularMomentum;
}

}  // namespace

ExactWorld::ExactWorld(const World& world, double duration, Recorder& recorder)
    : world_(world),
      end_(duration),
      recorder_(recorder),
      neighbors_(radiiOf(world)),
      queue_(world.bodies.size()),
      account_(world) {
  for (const std::size_t listed : ranked(world)) {
    Mover& mover = movers_.emplace_back();
    mover.body = &world.bodies[listed];
    mover.listed = {static_cast<int>(listed)};
  }
}

// The whole method, from here to moveOn().

RunFigures ExactWorld::run(const std::stop_token& stop) {
  begin();
  for (std::optional<Event> event = queue_.next(); event && !earlier(end_, event->time);
       event = queue_.next()) {
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    happen(*event);
  }
  end();
  return account_.figures();
}

void ExactWorld::begin() {
  for (int rank = 0; rank < static_cast<int>(movers_.size()); ++rank) {
    const Body& body = *mover(rank).body;
    neighbors_.insert(rank, body.initial.pose.position, body.halfExtents.norm());
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
  } else if (event.partner >= 0 && mover(event.partner).motion != event.partnerMotion) {
    predict(event.body);
  } else {
    Group group = gather(event);
    resolve(group);
    settle(group);
    if (event.kind == EventKind::kTouching) {
      checkParts(group, event);
    }
    record(group);
    moveOn(group);
  }
}

// What came before ends, the impact's bodies get their next motions, and only they are predicted again.
void ExactWorld::moveOn(const Group& group) {
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const int rank = group.ranks[i];
    if (group.restsFrom[i]) {
      rest(rank, *group.restsFrom[i], group.after[i].pose);
    } else if (!mover(rank).isHeld() && (mover(rank).flies || !movesAlike(group.before[i], group.after[i]))) {
      fly(rank, group.time, group.after[i], group.attitudes[i]);
    }
  }
  account_.parted();
  for (const int rank : group.ranks) {
    predict(rank);
  }
}

void ExactWorld::end() {
  for (const Mover& body : movers_) {
    if (body.flies) {
      arrive(body, end_, body.stateAt(end_));
    }
  }
}

// ---- The group of bodies that touch.

ExactWorld::Group ExactWorld::gather(const Event& event) {
  Group group;
  group.time = event.time;
  group.ranks = touchingFrom(event);
  for (const int rank : group.ranks) {
    group.attitudes.push_back(mover(rank).attitudeAt(event.time));
    group.before.push_back(mover(rank).stateAt(event.time, group.attitudes.back()));
  }
  group.after = group.before;
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Mover& body = mover(group.ranks[i]);
    if (!body.isHeld()) {
      account_.penetrates(addWallContacts(world_, *body.body, group.before[i].pose, static_cast<int>(i),
                                          group.contacts, group.partners));
    }
    for (std::size_t j = i + 1; j < group.ranks.size(); ++j) {
      addPairContacts(group, i, j);
    }
  }
  group.shares.resize(group.contacts.size());
  group.restsFrom.resize(group.ranks.size());
  return group;
}

// An impact runs through every body that touches one that it reaches, held ones excepted: they pass nothing
// on.
std::vector<int> ExactWorld::touchingFrom(const Event& event) const {
  std::vector<int> ranks = {event.body};
  if (event.partner >= 0) {
    ranks.push_back(event.partner);
  }
  std::vector<Neighbors::Key> candidates;
  for (std::size_t reached = 0; reached < ranks.size(); ++reached) {
    if (mover(ranks[reached]).isHeld()) {
      continue;
    }
    neighbors_.findCandidates(ranks[reached], candidates);
    for (const Neighbors::Key candidate : candidates) {
      if (std::find(ranks.begin(), ranks.end(), candidate) == ranks.end() &&
          touch(mover(ranks[reached]), mover(candidate), event.time)) {
        ranks.push_back(candidate);
      }
    }
  }
  std::sort(ranks.begin(), ranks.end());
  return ranks;
}

void ExactWorld::addPairContacts(Group& group, std::size_t indexA, std::size_t indexB) {
  const Mover& a = mover(group.ranks[indexA]);
  const Mover& b = mover(group.ranks[indexB]);
  if ((a.isHeld() && b.isHeld()) || !touch(a, b, group.time)) {
    return;
  }
  const Pose& poseA = group.before[indexA].pose;
  const Pose& poseB = group.before[indexB].pose;
  for (const ContactPoint& at : boxContactPoints(poseA, a.body->halfExtents, poseB, b.body->halfExtents)) {
    group.contacts.push_back({.a = static_cast<int>(indexA),
                              .b = static_cast<int>(indexB),
                              .armA = at.armA,
                              .armB = at.armB,
                              .normal = at.normal,
                              .material = touching(a.body->material, b.body->material)});
    group.partners.push_back(group.ranks[indexB]);
  }
}

void ExactWorld::resolve(Group& group) {
  std::vector<ImpactBody> bodies;
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    bodies.push_back({.mass = &mover(group.ranks[i]).body->mass, .state = &group.after[i]});
  }
  bool mayLose = false;
  for (const ImpactContact& contact : group.contacts) {
    mayLose = mayLose || contact.material.restitution < 1 || contact.material.friction > 0;
  }
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    if (mover(group.ranks[i]).flies) {
      arrive(mover(group.ranks[i]), group.time, group.before[i]);
    }
  }
  account_.strikes(mayLose);
  resolveImpact(bodies, group.contacts, group.shares);
}

void ExactWorld::settle(Group& group) const {
  if (world_.gravity.isZero(0)) {
    return;
  }
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const bool moves = mover(group.ranks[i]).flies || !movesAlike(group.before[i], group.after[i]);
    if (moves && !mover(group.ranks[i]).isHeld()) {
      settleBody(group, i);
    }
  }
}

// Two that stay in touch without coming to rest: no closed form holds.
void ExactWorld::checkParts(const Group& group, const Event& event) const {
  const auto place = std::find(group.ranks.begin(), group.ranks.end(), event.body) - group.ranks.begin();
  if (!group.restsFrom[static_cast<std::size_t>(place)]) {
    const std::string& partner =
        event.partner >= 0 ? mover(event.partner).body->name : world_.walls[wallOf(event.partner)].name;
    throw NumericalError(where(event.body, event.time) + "stays in touch with " + partner + kNeedsContact);
  }
}

// [m] What the gap at contact k is the difference of. A wall's offset is no more than its body's part of it.
double ExactWorld::lengthsAt(const Group& group, std::size_t k) const {
  const auto of = [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    return group.after[i].pose.position.cwiseAbs().sum() + mover(group.ranks[i]).body->halfExtents.norm();
  };
  const ImpactContact& contact = group.contacts[k];
  return of(contact.a) + of(contact.b == ImpactContact::kWall ? contact.a : contact.b);
}

// A body whose next hop at one of its contacts is too short to follow comes to rest there, or the run ends.
void ExactWorld::settleBody(Group& group, std::size_t index) const {
  const Body& body = *mover(group.ranks[index]).body;
  BodyState& state = group.after[index];
  const Vec3 omega = careen::angularVelocity(body.mass, state);
  const Vec3 omegaRate =
      inverseInertiaWorld(body.mass, state.pose.worldFromBody) * state.angularMomentum.cross(omega);
  double tail = -1;
  Settling settling;
  settling.velocity = state.velocity;
  settling.angularVelocity = omega;
  settling.gravity = world_.gravity;
  std::vector<Vec3> arms;
  for (std::size_t k = 0; k < group.contacts.size(); ++k) {
    const ImpactContact& contact = group.contacts[k];
    const bool isA = contact.a == static_cast<int>(index);
    if (!isA && contact.b != static_cast<int>(index)) {
      continue;
    }
    const Vec3 normal = isA ? contact.normal : Vec3(-contact.normal);
    const Vec3& arm = isA ? contact.armA : contact.armB;
    const Vec3 acceleration = world_.gravity + omegaRate.cross(arm) + omega.cross(omega.cross(arm));
    const Bouncing bouncing{.acceleration = normal.dot(acceleration),
                            .departure = std::max(0.0, normal.dot(state.velocity + omega.cross(arm))),
                            .restitution = contact.material.restitution,
                            .gapRounding = kGapRounding * lengthsAt(group, k)};
    if (!settles(bouncing, body.halfExtents.minCoeff())) {
      continue;
    }
    tail = std::max(tail, settlingTail(bouncing));
    arms.push_back(arm);
    settling.normal = normal;
    settling.friction = contact.material.friction;
    settling.speed = std::max(settling.speed, group.shares[k].approach);
    settling.onBody = settling.onBody || (group.partners[k] >= 0 && mover(group.partners[k]).flies);
  }
  if (tail < 0) {
    return;
  }
  settling.arms = arms;
  settling.velocity -= settling.normal.dot(settling.velocity) * settling.normal;
  const Settled settled = afterTail(settling);
  if (settled != Settled::kRests) {
    throw NumericalError(where(group.ranks[index], group.time) +
                         "has bounced itself out: " + std::string(describe(settled)) + kNeedsContact);
  }
  state = {.pose = state.pose};
  group.restsFrom[index] = instantAfter(group.time, tail);
}

void ExactWorld::record(const Group& group) {
  for (std::size_t k = 0; k < group.contacts.size(); ++k) {
    const ImpactContact& contact = group.contacts[k];
    const ImpactShare& share = group.shares[k];
    if (share.impulse > 0) {
      const auto a = static_cast<std::size_t>(contact.a);
      Impact impact{.time = group.time.hi,
                    .a = mover(group.ranks[a]).listed,
                    .b = WallIndex{},
                    .point = group.before[a].pose.position + contact.armA,
                    .normal = contact.normal,
                    .approach = share.approach,
                    .impulse = share.impulse,
                    .tangential = share.tangential};
      if (group.partners[k] < 0) {
        impact.b = WallIndex{static_cast<int>(wallOf(group.partners[k]))};
      } else {
        impact.b = mover(group.partners[k]).listed;
      }
      recorder_.strikes(impact);
    }
  }
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

void ExactWorld::rest(int rank, const Instant& time, const Pose& pose) {
  Mover& body = mover(rank);
  begins(rank, time);
  body.rest(pose);
  recorder_.moves(body.listed, time.hi, Rest{pose});
  account_.departs(static_cast<std::size_t>(body.listed.value), {.pose = pose});
}

void ExactWorld::begins(int rank, const Instant& time) {
  Mover& body = mover(rank);
  const bool again = body.motion > 0 && !earlier(body.start, time);
  body.atOneMoment = again ? body.atOneMoment + 1 : 0;
  if (body.atOneMoment > kMostAtOneMoment) {
    throw NumericalError(where(rank, time) + "is struck again and again at one moment");
  }
  body.start = time;
  ++body.motion;
}

void ExactWorld::arrive(const Mover& body, const Instant& time, const BodyState& state) {
  account_.arrives(static_cast<std::size_t>(body.listed.value), state, body.elapsed(time));
}

// ---- What comes next.

void ExactWorld::predict(int rank) {
  const Mover& body = mover(rank);
  if (!body.flies) {  // what flies towards it is told to that
    queue_.clear(rank);
    return;
  }
  std::optional<Event> first = body.wall;
  if (body.crosses) {
    sooner(
        first,
        {.time = instantAfter(body.start, body.crossing.time), .kind = EventKind::kCrossing, .body = rank});
  }
  neighbors_.findCandidates(rank, candidates_);
  for (const Neighbors::Key candidate : candidates_) {
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

void ExactWorld::sooner(std::optional<Event>& first, const Event& candidate) {
  if (!first || earlier(candidate.time, first->time)) {
    first = candidate;
  }
}

void ExactWorld::findCrossing(Mover& body, int rank) {
  body.crosses = neighbors_.isFiled(rank) && movers_.size() > 1;
  if (body.crosses) {
    body.crossing =
        neighbors_.nextCrossing(body.flight.position, body.flight.velocity, body.flight.acceleration,
                                neighbors_.cell(rank), body.crossing.time);
  }
}

std::string ExactWorld::where(int rank, const Instant& time) const {
  std::ostringstream text;
  text << "at " << time.hi << " s box " << mover(rank).body->name << ' ';
  return text.str();
}

}  // namespace careen
