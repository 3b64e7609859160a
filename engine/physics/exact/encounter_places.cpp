#include "physics/exact/encounter_places.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/exact/encounter_contacts.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

using Features = std::vector<ContactFeature>;

// Adds the contacts of the groups that take part.
void addKnown(const Encounter& encounter, Features& features) {
  std::vector<const ContactGroup*> known;
  for (const EncounterBody& body : encounter.bodies) {
    const ContactGroup* group = body.mover->group.get();
    if (group != nullptr && std::find(known.begin(), known.end(), group) == known.end()) {
      known.push_back(group);
      group->addFeatures(encounter, features);
    }
  }
}

std::vector<TouchingBody> touchingOf(const Encounter& encounter) {
  std::vector<TouchingBody> touching;
  for (const EncounterBody& each : encounter.bodies) {
    touching.push_back(each.touching(encounter.time));
  }
  return touching;
}

// Adds the conditions of joints that hold, or have closed.
void addJoints(const Encounter& encounter, Features& features) {
  for (const ImpactContact& closed : closedJoints(encounter)) {
    features.push_back(encounter.joints[static_cast<std::size_t>(closed.joint)]);
  }
}

// Adds corners that have reached or passed a wall.
void addCorners(const Encounter& encounter, Features& features) {
  const std::vector<TouchingBody> bodies = touchingOf(encounter);
  const auto isNear = [](std::size_t) { return true; };
  for (std::size_t i = 0; i < boxesOf(bodies); ++i) {
    const EncounterBody& body = encounter.bodies[i];
    const double within = kAligned * touchingWithin(body.box());
    forCorners(bodies, i, isNear, [&](const ContactFeature& corner) {
      const WallPlane plane = bodies[static_cast<std::size_t>(corner.b)].plane();
      if (cornerGap(body.before.pose, corner.onA, plane.normal, plane.offset) <= within &&
          !hasCorner(features, corner)) {
        features.push_back(corner);
        features.back().material = {};  // places are aligned without friction
      }
    });
  }
}

// Adds the contact manifolds of all boxes of two bodies for which isMeeting(boxA, boxB, gap).
template <class IsMeeting>
void addMeetings(const Encounter& encounter, std::size_t a, std::size_t b, Features& features,
                 const IsMeeting& isMeeting) {
  const EncounterBody& bodyA = encounter.bodies[a];
  const EncounterBody& bodyB = encounter.bodies[b];
  forBoxes(
      bodyA.body(), bodyA.before.pose, bodyB.body(), bodyB.before.pose,
      [&](const BoxAt& boxA, const BoxAt& boxB) {
        const double apart = BoxAxes(boxA, boxB).gap();
        if (isMeeting(boxA, boxB, apart)) {
          for (const ContactPoint& at : boxContactPoints(boxA, boxB)) {
            features.push_back(featureAt(at, apart, static_cast<int>(a), boxA, static_cast<int>(b), boxB));
          }
        }
      });
}

// Adds those of the two bodies of an event, but for boxes to which the group of the first sees.
void addEvent(const Bodies& bodies, const Event& event, const Encounter& encounter, Features& features) {
  const Mover& body = bodies[event.body];
  const Mover& other = bodies[event.partner];
  const bool isOneMeeting = body.body->partCount() == 1 && other.body->partCount() == 1;
  addMeetings(
      encounter, encounter.indexOf(event.body), encounter.indexOf(event.partner), features,
      [&](const BoxAt& boxA, const BoxAt& boxB, double gap) {
        return !(body.steps() && body.group->seesTo(body.place, boxA.part, {event.partner, boxB.part})) &&
               (isOneMeeting || gap <= kAligned * touchingWithin(boxA, boxB));
      });
}

// Adds contacts of bodies that penetrate after a time step.
void addOverlaps(const World& world, const Encounter& encounter, Features& features) {
  const std::span<const EncounterBody> boxes = encounter.boxes();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const EncounterBody& a = boxes[i];
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const EncounterBody& b = boxes[j];
      if ((!a.mover->isHeld() || !b.mover->isHeld()) && mayTouch(world, a.listed(), b.listed()) &&
          (a.before.pose.position - b.before.pose.position).norm() <=
              radiusOf(a.body()) + radiusOf(b.body())) {
        addMeetings(encounter, i, j, features, [](const BoxAt& boxA, const BoxAt& boxB, double gap) {
          return gap < -kAligned * touchingWithin(boxA, boxB);
        });
      }
    }
  }
}

}  // namespace

void alignPlaces(const Bodies& bodies, const Event& event, Encounter& encounter) {
  if (std::none_of(encounter.bodies.begin(), encounter.bodies.end(),
                   [](const EncounterBody& body) { return body.mover->steps(); })) {
    return;
  }
  Features features;
  addKnown(encounter, features);
  addJoints(encounter, features);
  addCorners(encounter, features);
  if (event.partner != Event::kNobody && bodies[event.partner].isBox()) {
    addEvent(bodies, event, encounter, features);
  }
  constexpr int kMostPasses = 8;
  double mayMove = ContactSystem::kMostMoved * bodies.tolerance();
  for (int pass = 0; pass < kMostPasses; ++pass) {
    ContactSystem system(bodies.world(), touchingOf(encounter), features);
    system.closeAll();
    std::vector<double> y = system.pack();
    if (const double way = system.projectPositions(y, mayMove, ContactSystem::Turns::kAttitude); way > 0) {
      mayMove -= way;
      system.unpack(y);
      for (std::size_t i = 0; i < encounter.bodies.size(); ++i) {
        EncounterBody& each = encounter.bodies[i];
        if (!each.mover->isHeld()) {
          each.attitude = system.bodies()[i].worldFromBody;
          each.before = each.after = system.bodies()[i].state();
        }
      }
    }
    const std::size_t known = features.size();
    addCorners(encounter, features);
    addOverlaps(bodies.world(), encounter, features);
    if (features.size() == known) {
      return;
    }
  }
}

}  // namespace careen
