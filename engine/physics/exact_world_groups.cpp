#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "physics/contact_points.h"
#include "physics/exact_world.h"
#include "physics/separation.h"
#include "physics/wall_contacts.h"

// Bodies that touch at one moment: who they are, and what an impact does to them.

namespace careen {
namespace {

/// Gaps within so many touching tolerances are brought to zero together: a contact that has closed is located
/// to a few of them.
constexpr double kAligned = 64;

double touchingWithinOf(const Body& body, const Pose& pose) {
  const double radius = body.halfExtents.norm();
  return touchingWithin(radius, pose.position.cwiseAbs().sum() + radius);
}

}  // namespace

// ---- Who touches whom.

ExactWorld::Group ExactWorld::gather(const Event& event) {
  Group group;
  group.time = event.time;
  group.cause = event.kind;
  reach(event, group);
  group.after = group.before;
  alignPlaces(group, event);
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
  if (event.partner >= 0) {
    join(group, event.partner);
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

// Where bodies in Contact take part, places are good to the tolerance only: what touches, and what has just
// come to touch, is brought to touch exactly, by the least displacement.
void ExactWorld::alignPlaces(Group& group, const Event& event) const {
  std::vector<ContactFeature> features;
  std::vector<const Touchers*> known;
  const auto indexOf = [&](int rank) {
    return static_cast<int>(std::find(group.ranks.begin(), group.ranks.end(), rank) - group.ranks.begin());
  };
  for (const int rank : group.ranks) {
    const Touchers* with = mover(rank).touchers.get();
    if (with == nullptr || std::find(known.begin(), known.end(), with) != known.end()) {
      continue;
    }
    known.push_back(with);
    const ContactSystem& system = with->island.system();
    for (std::size_t c = 0; c < system.features().size(); ++c) {
      ContactFeature feature = system.features()[c];
      const auto a = static_cast<std::size_t>(feature.a);
      const double within = kAligned * touchingWithinOf(*system.bodies()[a].body, system.kinematics(a).pose);
      const double past = system.states()[c].beyond;
      if (std::fabs(system.states()[c].gap) > within || past > within / 16) {
        continue;
      }
      feature.a = indexOf(with->ranks[a]);
      if (feature.b != ContactFeature::kNobody) {
        feature.b = indexOf(with->ranks[static_cast<std::size_t>(feature.b)]);
      }
      features.push_back(feature);
    }
  }
  if (known.empty()) {
    return;
  }
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Body& body = *mover(group.ranks[i]).body;
    const Pose& pose = group.before[i].pose;
    const double within = kAligned * touchingWithinOf(body, pose);
    for (std::size_t w = 0; w < (mover(group.ranks[i]).isHeld() ? 0 : world_.walls.size()); ++w) {
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(body.halfExtents, k);
        const double gap = world_.walls[w].normal.dot(pose.position) +
                           world_.walls[w].normal.dot(pose.worldFromBody * at) - world_.walls[w].offset;
        const bool has = std::any_of(features.begin(), features.end(), [&](const ContactFeature& feature) {
          return feature.kind == ContactFeature::Kind::kPointOnWall && feature.a == static_cast<int>(i) &&
                 feature.wall == static_cast<int>(w) && feature.onA == at;
        });
        if (std::fabs(gap) <= within && !has) {
          features.push_back({.a = static_cast<int>(i), .wall = static_cast<int>(w), .onA = at});
        }
      }
    }
  }
  if (event.partner >= 0 &&
      !(mover(event.body).touches() && shareContact(mover(event.body), event.body, event.partner))) {
    addMeeting(group, static_cast<std::size_t>(indexOf(event.body)),
               static_cast<std::size_t>(indexOf(event.partner)), features);
  }
  constexpr int kMostPasses = 8;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    std::vector<TouchingBody> bodies;
    for (std::size_t i = 0; i < group.ranks.size(); ++i) {
      bodies.push_back(touchingBody(group, i));
    }
    ContactSystem system(world_, std::move(bodies), features);
    std::fill(system.modes().begin(), system.modes().end(), ContactForces::Mode::kOn);
    std::vector<double> y = system.pack();
    if (system.projectPositions(y)) {
      system.unpack(y);
    }
    for (std::size_t i = 0; i < group.ranks.size(); ++i) {
      if (!mover(group.ranks[i]).isHeld()) {
        const TouchingBody& moved = system.bodies()[i];
        group.attitudes[i] = moved.worldFromBody;
        group.before[i] = group.after[i] = moved.state();
      }
    }
    if (!addOverlaps(group, features)) {
      return;
    }
  }
}

double ExactWorld::gapOf(const Group& group, std::size_t a, std::size_t b) const {
  const Pose& poseA = group.before[a].pose;
  const Pose& poseB = group.before[b].pose;
  return BoxAxes(poseA.worldFromBody, mover(group.ranks[a]).body->halfExtents, poseB.worldFromBody,
                 mover(group.ranks[b]).body->halfExtents, poseA.position - poseB.position)
      .gap();
}

// Where two boxes meet, near each other as they are.
void ExactWorld::addMeeting(const Group& group, std::size_t a, std::size_t b,
                            std::vector<ContactFeature>& features) const {
  const Pose& poseA = group.before[a].pose;
  const Pose& poseB = group.before[b].pose;
  const Vec3& halfA = mover(group.ranks[a]).body->halfExtents;
  const Vec3& halfB = mover(group.ranks[b]).body->halfExtents;
  const double apart = gapOf(group, a, b);
  for (const ContactPoint& at : boxContactPoints(poseA, halfA, poseB, halfB)) {
    features.push_back(
        featureAt(at, apart, static_cast<int>(a), poseA, halfA, static_cast<int>(b), poseB, halfB));
  }
}

// What a stride has driven into each other, as further features to be brought apart. False if there is none.
bool ExactWorld::addOverlaps(const Group& group, std::vector<ContactFeature>& features) const {
  const std::size_t before = features.size();
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Mover& a = mover(group.ranks[i]);
    const Pose& poseA = group.before[i].pose;
    const double within = kAligned * touchingWithinOf(*a.body, poseA);
    for (std::size_t w = 0; w < (a.isHeld() ? 0 : world_.walls.size()); ++w) {
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(a.body->halfExtents, k);
        const Wall& wall = world_.walls[w];
        if (wall.normal.dot(poseA.position) + wall.normal.dot(poseA.worldFromBody * at) - wall.offset <
            -within) {
          features.push_back({.a = static_cast<int>(i), .wall = static_cast<int>(w), .onA = at});
        }
      }
    }
    for (std::size_t j = i + 1; j < group.ranks.size(); ++j) {
      const Mover& b = mover(group.ranks[j]);
      const Vec3 bToA = poseA.position - group.before[j].pose.position;
      if ((!a.isHeld() || !b.isHeld()) &&
          bToA.norm() <= a.body->halfExtents.norm() + b.body->halfExtents.norm() &&
          gapOf(group, i, j) < -within) {
        addMeeting(group, i, j, features);
      }
    }
  }
  return features.size() > before;
}

void ExactWorld::addPairContacts(Group& group, std::size_t indexA, std::size_t indexB) {
  const Mover& a = mover(group.ranks[indexA]);
  const Mover& b = mover(group.ranks[indexB]);
  if ((a.isHeld() && b.isHeld()) ||
      !areTouching(*a.body, group.before[indexA].pose, *b.body, group.before[indexB].pose)) {
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

}  // namespace careen
