#include <algorithm>
#include <cmath>

#include "physics/exact/exact_world.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/separation.h"

// Where bodies that touch stand: steps of Contact place them to the tolerance only.

namespace careen {
namespace {

/// Gaps within so many touching tolerances are brought to zero together: a contact that has closed is located
/// to a few of them.
constexpr double kAligned = 64;

}  // namespace

// What touches, what has just come to touch and what a stride has driven into each other is brought to touch
// exactly, by the least displacement.
void ExactWorld::alignPlaces(Group& group, const Event& event) const {
  if (std::none_of(group.ranks.begin(), group.ranks.end(), [&](int rank) { return mover(rank).touches(); })) {
    return;
  }
  std::vector<ContactFeature> features;
  addHeld(group, features);
  addCorners(group, features);
  const Mover& body = mover(event.body);
  if (!event.partner.isWall() &&
      !(body.touches() && seesTo(*body.touchers, body.place, event.partner.body()))) {
    addMeeting(group, indexOf(group, event.body), indexOf(group, event.partner.body()), features);
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
      for (std::size_t i = 0; i < group.ranks.size(); ++i) {
        if (!mover(group.ranks[i]).isHeld()) {
          const TouchingBody& moved = system.bodies()[i];
          group.attitudes[i] = moved.worldFromBody;
          group.before[i] = group.after[i] = moved.state();
        }
      }
    }
    const std::size_t known = features.size();
    addCorners(group, features);
    addOverlaps(group, features);
    if (features.size() == known) {
      return;
    }
  }
}

std::size_t ExactWorld::indexOf(const Group& group, int rank) {
  return static_cast<std::size_t>(std::find(group.ranks.begin(), group.ranks.end(), rank) -
                                  group.ranks.begin());
}

// What the islands of the group hold together.
void ExactWorld::addHeld(const Group& group, std::vector<ContactFeature>& features) const {
  std::vector<const Touchers*> known;
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
      const double within =
          kAligned * touchingWithin(system.kinematics(a).pose, system.bodies()[a].body->halfExtents);
      const double past = system.states()[c].beyond;
      if (std::fabs(system.states()[c].gap) > within || past > within / 16) {
        continue;
      }
      feature.a = static_cast<int>(indexOf(group, with->ranks[a]));
      if (!feature.b.isWall()) {
        const int other = with->ranks[static_cast<std::size_t>(feature.b.body())];
        feature.b = Partner::ofBody(static_cast<int>(indexOf(group, other)));
      }
      features.push_back(feature);
    }
  }
}

// Corners that have come to a wall, or through it.
void ExactWorld::addCorners(const Group& group, std::vector<ContactFeature>& features) const {
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Mover& body = mover(group.ranks[i]);
    const Pose& pose = group.before[i].pose;
    const Vec3& half = body.body->halfExtents;
    const double within = kAligned * touchingWithin(pose, half);
    for (std::size_t w = 0; w < (body.isHeld() ? 0 : world_.walls.size()); ++w) {
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(half, k);
        const int index = static_cast<int>(i);
        const Partner wall = Partner::ofWall(w);
        if (cornerGap(pose, at, world_.walls[w].normal, world_.walls[w].offset) <= within &&
            !hasCorner(features, index, wall, at)) {
          features.push_back({.a = index, .b = wall, .onA = at});
        }
      }
    }
  }
}

double ExactWorld::gapOf(const Group& group, std::size_t a, std::size_t b) const {
  return BoxAxes(group.before[a].pose, mover(group.ranks[a]).body->halfExtents, group.before[b].pose,
                 mover(group.ranks[b]).body->halfExtents)
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

// What a stride has driven into each other.
void ExactWorld::addOverlaps(const Group& group, std::vector<ContactFeature>& features) const {
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Body& a = *mover(group.ranks[i]).body;
    const Pose& pose = group.before[i].pose;
    for (std::size_t j = i + 1; j < group.ranks.size(); ++j) {
      const Body& b = *mover(group.ranks[j]).body;
      if ((!isImmovable(a.mass) || !isImmovable(b.mass)) &&
          (pose.position - group.before[j].pose.position).norm() <=
              a.halfExtents.norm() + b.halfExtents.norm() &&
          gapOf(group, i, j) < -kAligned * touchingWithin(pose, a.halfExtents)) {
        addMeeting(group, i, j, features);
      }
    }
  }
}

// Adds contacts that two may come into within a stride. They count where bodies rattle.
void ExactWorld::addNear(Group& group) const {
  const double near = kNear * tolerance_;
  const std::size_t touching = group.contacts.size();
  for (std::size_t i = 0; i < group.ranks.size(); ++i) {
    const Mover& a = mover(group.ranks[i]);
    const Pose& pose = group.before[i].pose;
    for (std::size_t w = 0; w < (a.isHeld() ? 0 : world_.walls.size()); ++w) {
      const Wall& wall = world_.walls[w];
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(a.body->halfExtents, k);
        if (cornerGap(pose, at, wall.normal, wall.offset) <= near) {
          group.contacts.push_back({.a = static_cast<int>(i),
                                    .b = Partner::ofWall(w),
                                    .armA = pose.worldFromBody * at,
                                    .normal = wall.normal,
                                    .material = careen::touching(a.body->material, wall.material)});
        }
      }
    }
    for (std::size_t j = i + 1; j < group.ranks.size(); ++j) {
      addPairContacts(group, i, j, near);
    }
  }
  // Only those that are new, and that come slowly: what comes fast is an impact when it arrives.
  std::size_t kept = touching;
  const auto isKnown = [&](std::size_t k) {
    for (std::size_t other = 0; other < kept; ++other) {
      if (group.contacts[other].a == group.contacts[k].a && group.contacts[other].b == group.contacts[k].b &&
          (group.contacts[other].armA - group.contacts[k].armA).norm() <= 2 * near) {
        return true;
      }
    }
    return false;
  };
  for (std::size_t k = touching; k < group.contacts.size(); ++k) {
    if (!isKnown(k) && partingAt(group, k).speed >= -kSlow * world_.gravity.norm() * stride_) {
      group.contacts[kept] = group.contacts[k];
      ++kept;
    }
  }
  group.contacts.resize(kept);
  group.shares.resize(kept);
  group.persists.resize(kept, 0);
}

}  // namespace careen
