#include <algorithm>
#include <numeric>
#include <utility>

#include "physics/exact/exact_world.h"
#include "physics/geometry/contact_points.h"
#include "physics/impact/wall_contacts.h"

// Bodies that touch at one moment: who they are, and what an impact does to them.

namespace careen {

// ---- Who touches whom.

ExactWorld::Group ExactWorld::gather(const Event& event) {
  Group group;
  group.time = event.time;
  // Met again where nothing is left to resolve: edges that pass within rounding. Contact sees them past.
  constexpr int kMostMeetings = 2;
  group.passes = event.kind != EventKind::kStep && mover(event.body).atOneMoment > kMostMeetings;
  group.cause = group.passes ? EventKind::kTouching : event.kind;
  reach(event, group);
  group.after = group.before;
  alignPlaces(group, event);
  group.after = group.before;
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Mover& body = mover(group.ranks[i]);
    if (!body.isHeld()) {
      account_.penetrates(
          addWallContacts(world_, *body.body, group.before[i].pose, static_cast<int>(i), group.contacts));
    }
    for (std::size_t j = i + 1; j < group.ranks.size(); ++j) {
      addPairContacts(group, i, j, 0);
    }
  }
  group.shares.resize(group.contacts.size());
  group.persists.assign(group.contacts.size(), 0);
  group.next.assign(group.ranks.size(), Next::kGoesOn);
  group.since.assign(group.ranks.size(), group.time);
  return group;
}

// A body joins a group once, and with it its island, which is brought to this moment.
void ExactWorld::join(Group& group, int rank) {
  if (std::find(group.ranks.begin(), group.ranks.end(), rank) != group.ranks.end()) {
    return;
  }
  const Mover& body = mover(rank);
  group.ranks.push_back(rank);
  if (!body.touches()) {
    group.attitudes.push_back(body.attitudeAt(group.time));
    group.before.push_back(body.stateAt(group.time, group.attitudes.back()));
  } else {
    Touchers& with = *body.touchers;
    if (earlier(group.time, with.end())) {
      with.step.length = secondsBetween(with.start, group.time);
      with.island.cutTo(with.step.length);
    }
    const TouchingBody& here = with.island.bodies()[body.place];
    group.attitudes.push_back(here.worldFromBody);
    group.before.push_back(here.state());
    for (const int each : with.ranks) {
      join(group, each);
    }
  }
  for (const int other : springs_[static_cast<std::size_t>(rank)]) {
    join(group, other);
  }
}

// An impact runs through every body that touches one that it reaches, held ones excepted: they pass nothing
// on.
void ExactWorld::reach(const Event& event, Group& group) {
  join(group, event.body);
  if (!event.partner.isWall()) {
    join(group, event.partner.body());
  }
  std::vector<Neighbors::Key> candidates;
  for (std::size_t reached = 0; reached < group.ranks.size(); ++reached) {
    const Body& body = *mover(group.ranks[reached]).body;
    if (mover(group.ranks[reached]).isHeld()) {
      continue;
    }
    neighbors_.findCandidates(group.ranks[reached], candidates);
    for (const Neighbors::Key candidate : candidates) {
      const Mover& other = mover(candidate);
      if (std::find(group.ranks.begin(), group.ranks.end(), candidate) == group.ranks.end() &&
          areTouching(body, group.before[reached].pose, *other.body, other.stateAt(group.time).pose)) {
        join(group, candidate);
      }
    }
  }
  std::vector<std::size_t> order(group.ranks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t x, std::size_t y) { return group.ranks[x] < group.ranks[y]; });
  Group sorted;
  for (const std::size_t i : order) {
    sorted.ranks.push_back(group.ranks[i]);
    sorted.attitudes.push_back(group.attitudes[i]);
    sorted.before.push_back(group.before[i]);
  }
  group.ranks = std::move(sorted.ranks);
  group.attitudes = std::move(sorted.attitudes);
  group.before = std::move(sorted.before);
}

// Adds the contacts of two bodies that touch, or are no more than `apart` [m] from each other.
void ExactWorld::addPairContacts(Group& group, std::size_t indexA, std::size_t indexB, double apart) const {
  const Body& a = *mover(group.ranks[indexA]).body;
  const Body& b = *mover(group.ranks[indexB]).body;
  const Pose& poseA = group.before[indexA].pose;
  const Pose& poseB = group.before[indexB].pose;
  if ((isImmovable(a.mass) && isImmovable(b.mass)) || !areTouching(a, poseA, b, poseB, apart)) {
    return;
  }
  for (const ContactPoint& at : boxContactPoints(poseA, a.halfExtents, poseB, b.halfExtents, apart)) {
    group.contacts.push_back({.a = static_cast<int>(indexA),
                              .b = Partner::ofBody(static_cast<int>(indexB)),
                              .armA = at.armA,
                              .armB = at.armB,
                              .normal = at.normal,
                              .material = touching(a.material, b.material)});
  }
}

// ---- What an impact does.

void ExactWorld::resolve(Group& group) {
  std::vector<ImpactBody> bodies;
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    bodies.push_back({.mass = &mover(group.ranks[i]).body->mass, .state = &group.after[i]});
  }
  bool mayLose =
      std::any_of(group.ranks.begin(), group.ranks.end(), [&](int rank) { return mover(rank).touches(); });
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

void ExactWorld::record(const Group& group) {
  for (std::size_t k = 0; k < group.contacts.size(); ++k) {
    const ImpactContact& contact = group.contacts[k];
    const ImpactShare& share = group.shares[k];
    if (share.impulse > 0) {
      const auto a = static_cast<std::size_t>(contact.a);
      const auto listed = [&](int index) {
        return mover(group.ranks[static_cast<std::size_t>(index)]).listed;
      };
      recorder_.strikes(
          {.time = group.time.hi,
           .a = listed(contact.a),
           .b = contact.b.isWall() ? contact.b : Partner::ofBody(listed(contact.b.body()).value),
           .point = group.before[a].pose.position + contact.armA,
           .normal = contact.normal,
           .approach = share.approach,
           .impulse = share.impulse,
           .tangential = share.tangential});
    }
  }
}

}  // namespace careen
