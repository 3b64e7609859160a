#include <algorithm>
#include <cmath>

#include "physics/exact/exact_world.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/separation.h"

// Position correction of touching bodies: steps of Contact place them only to the tolerance.

namespace careen {
namespace {

/// Gaps within this many touching tolerances are projected to zero together: the closing of a contact is
/// located to a few of them.
constexpr double kAligned = 64;

}  // namespace

// Projects the gaps of existing contacts, new contacts and penetrations left by a time step to zero, by the
// least displacement.
void ExactWorld::alignPlaces(Encounter& encounter, const Event& event) const {
  if (std::none_of(encounter.ranks.begin(), encounter.ranks.end(),
                   [&](int rank) { return mover(rank).touches(); })) {
    return;
  }
  std::vector<ContactFeature> features;
  addHeld(encounter, features);
  addCorners(encounter, features);
  const Mover& body = mover(event.body);
  if (!event.partner.isWall() &&
      !(body.touches() && seesTo(*body.contactGroup, body.place, event.partner.body()))) {
    addMeeting(encounter, indexOf(encounter, event.body), indexOf(encounter, event.partner.body()), features);
  }
  constexpr int kMostPasses = 8;
  double mayMove = ContactSystem::kMostMoved * tolerance_;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    std::vector<TouchingBody> bodies;
    for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
      bodies.push_back(touchingBody(encounter, i));
    }
    ContactSystem system(world_, std::move(bodies), features);
    std::fill(system.modes().begin(), system.modes().end(), ContactForces::Mode::kOn);
    std::vector<double> y = system.pack();
    if (const double way = system.projectPositions(y, mayMove, true); way > 0) {
      mayMove -= way;
      system.unpack(y);
      for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
        if (!mover(encounter.ranks[i]).isHeld()) {
          const TouchingBody& moved = system.bodies()[i];
          encounter.attitudes[i] = moved.worldFromBody;
          encounter.before[i] = encounter.after[i] = moved.state();
        }
      }
    }
    const std::size_t known = features.size();
    addCorners(encounter, features);
    addOverlaps(encounter, features);
    if (features.size() == known) {
      return;
    }
  }
}

std::size_t ExactWorld::indexOf(const Encounter& encounter, int rank) {
  return static_cast<std::size_t>(std::find(encounter.ranks.begin(), encounter.ranks.end(), rank) -
                                  encounter.ranks.begin());
}

// Adds the contacts of the encounter's islands.
void ExactWorld::addHeld(const Encounter& encounter, std::vector<ContactFeature>& features) const {
  std::vector<const ContactGroup*> known;
  for (const int rank : encounter.ranks) {
    const ContactGroup* with = mover(rank).contactGroup.get();
    if (with == nullptr || std::find(known.begin(), known.end(), with) != known.end()) {
      continue;
    }
    known.push_back(with);
    const ContactSystem& system = with->island->system();
    for (std::size_t c = 0; c < system.features().size(); ++c) {
      ContactFeature feature = system.features()[c];
      const auto a = static_cast<std::size_t>(feature.a);
      const double within =
          kAligned * touchingWithin(boxAt(system.kinematics(a).pose, *system.bodies()[a].body));
      const double past = system.states()[c].beyond;
      if (std::fabs(system.states()[c].gap) > within || past > within / 16) {
        continue;
      }
      feature.a = static_cast<int>(indexOf(encounter, with->ranks[a]));
      if (!feature.b.isWall()) {
        const int other = with->ranks[static_cast<std::size_t>(feature.b.body())];
        feature.b = Partner::ofBody(static_cast<int>(indexOf(encounter, other)));
      }
      features.push_back(feature);
    }
  }
}

// Adds corners that have reached or passed a wall.
void ExactWorld::addCorners(const Encounter& encounter, std::vector<ContactFeature>& features) const {
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    const Mover& body = mover(encounter.ranks[i]);
    const Pose& pose = encounter.before[i].pose;
    const double within = kAligned * touchingWithin(boxAt(pose, *body.body));
    for (std::size_t w = 0; w < (body.isHeld() ? 0 : world_.walls.size()); ++w) {
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(*body.body, k);
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

BoxAt ExactWorld::boxOf(const Encounter& encounter, std::size_t index) const {
  return boxAt(encounter.before[index].pose, *mover(encounter.ranks[index]).body);
}

double ExactWorld::gapOf(const Encounter& encounter, std::size_t a, std::size_t b) const {
  return BoxAxes(boxOf(encounter, a), boxOf(encounter, b)).gap();
}

// Adds the contact manifold of two boxes that are near each other.
void ExactWorld::addMeeting(const Encounter& encounter, std::size_t a, std::size_t b,
                            std::vector<ContactFeature>& features) const {
  const BoxAt boxA = boxOf(encounter, a);
  const BoxAt boxB = boxOf(encounter, b);
  const double apart = gapOf(encounter, a, b);
  for (const ContactPoint& at : boxContactPoints(boxA, boxB)) {
    features.push_back(featureAt(at, apart, static_cast<int>(a), boxA, static_cast<int>(b), boxB));
  }
}

// Adds contacts of bodies that penetrate after a time step.
void ExactWorld::addOverlaps(const Encounter& encounter, std::vector<ContactFeature>& features) const {
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    const Body& a = *mover(encounter.ranks[i]).body;
    const Pose& pose = encounter.before[i].pose;
    for (std::size_t j = i + 1; j < encounter.ranks.size(); ++j) {
      const Body& b = *mover(encounter.ranks[j]).body;
      if ((!isImmovable(a.mass) || !isImmovable(b.mass)) &&
          (pose.position - encounter.before[j].pose.position).norm() <= radiusOf(a) + radiusOf(b) &&
          gapOf(encounter, i, j) < -kAligned * touchingWithin(boxOf(encounter, i), boxOf(encounter, j))) {
        addMeeting(encounter, i, j, features);
      }
    }
  }
}

}  // namespace careen
