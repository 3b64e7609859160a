#include "physics/contact/found_contacts.h"

#include <algorithm>

#include "physics/geometry/chosen_contact.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

/// [1] of a closed gap: how far a contact may open within a step and still obey its law.
constexpr double kOpens = 0x1p-4;

}  // namespace

ImpactContact impactContactOf(const ContactFeature& feature, const ContactState& state, int joint) {
  return {.a = feature.a,
          .b = feature.b,
          .armA = state.armA,
          .armB = state.armB,
          .normal = state.normal,
          .material = feature.material,
          .directions = state.directions,
          .rows = state.rows,
          .holds = feature.holds(),
          .joint = joint};
}

void FoundContacts::addCorners(std::size_t body, const std::vector<Pose>& poses) {
  const Pose& pose = poses[body];
  const auto planeFor = [&](std::size_t wall) {
    return planeOf(*group_.bodies()[wall].halfSpace, poses[wall]);
  };
  const auto isNear = [&](std::size_t wall) {
    const WallPlane plane = planeFor(wall);
    return gapToPlane(boxAt(pose, group_.body(body)), plane.normal, plane.offset) <= closed_;
  };
  forCorners(group_.bodies(), body, isNear, [&](const ContactFeature& feature) {
    const WallPlane plane = planeFor(static_cast<std::size_t>(feature.b));
    if (cornerGap(pose, feature.onA, plane.normal, plane.offset) <= closed_) {
      features_.push_back(feature);
    }
  });
}

void FoundContacts::addBetween(std::size_t a, std::size_t b, const std::vector<Pose>& poses,
                               const GroupState& at, double slow) {
  forBoxes(group_.body(a), poses[a], group_.body(b), poses[b], [&](const BoxAt& boxA, const BoxAt& boxB) {
    if (BoxAxes(boxA, boxB).gap() <= closed_) {
      addBetween(a, boxA, b, boxB, at, slow);
    }
  });
}

void FoundContacts::addBetween(std::size_t a, const BoxAt& boxA, std::size_t b, const BoxAt& boxB,
                               const GroupState& at, double slow) {
  const Kinematics ofA = group_.kinematics(a, at[a]);
  const Kinematics ofB = group_.kinematics(b, at[b]);
  const ChosenContact contact =
      chosenContact(boxA, boxB, closed_, closed_, slow, [&](const Vec3& armA, const Vec3& armB) {
        return Vec3((ofA.velocity + ofA.angularVelocity.cross(armA)) -
                    (ofB.velocity + ofB.angularVelocity.cross(armB)));
      });
  for (const ContactPoint& point : contact.points) {
    ContactFeature feature = featureAt(point, closed_, static_cast<int>(a), boxA, static_cast<int>(b), boxB);
    feature.material = touching(group_.body(static_cast<std::size_t>(feature.a)).material,
                                group_.body(static_cast<std::size_t>(feature.b)).material);
    feature.axes = feature.a == static_cast<int>(a) ? contact.choice : swapped(contact.choice);
    features_.push_back(feature);
  }
}

void FoundContacts::find(const GroupState& at, double slow) {
  features_.clear();
  std::vector<Pose> poses;
  for (const GroupBody& body : at) {
    poses.push_back(body.pose());
  }
  for (std::size_t i = 0; i < group_.boxes(); ++i) {
    addCorners(i, poses);
    for (std::size_t j = i + 1; j < group_.boxes(); ++j) {
      if (group_.mayMeet(i, j, at, closed_)) {
        addBetween(i, j, poses, at, slow);
      }
    }
  }
  for (const ContactFeature& joint : joints_) {
    if (joint.holds() || group_.contactAt(joint, at).gap <= closed_) {
      features_.push_back(joint);
    }
  }
  follow(at);
}

double FoundContacts::deepest() const {
  double deepest = 0;
  for (const ContactState& state : states_) {
    deepest = std::max(deepest, -state.gap);
  }
  return deepest;
}

double FoundContacts::farthestOff() const {
  double farthest = deepest();
  for (std::size_t c = 0; c < features_.size(); ++c) {
    farthest = features_[c].holds() ? std::max(farthest, states_[c].gap) : farthest;
  }
  return farthest;
}

bool FoundContacts::has(const ContactFeature& feature) const {
  return std::any_of(features_.begin(), features_.end(),
                     [&](const ContactFeature& found) { return isSame(found, feature); });
}

bool FoundContacts::obeys(std::size_t contact, double h) const {
  const ContactState& state = states_[contact];
  if (features_[contact].isTwoSided()) {
    return true;
  }
  return state.gap <= closed_ && state.parting() * h <= kOpens * closed_ &&
         !(features_[contact].kind == ContactFeature::Kind::kInCone && state.passing() * h > closed_);
}

std::vector<ClosedContact> FoundContacts::obeying(double h, const std::vector<ClosedContact>& known) const {
  std::vector<ClosedContact> obeying;
  for (std::size_t c = 0; c < features_.size(); ++c) {
    if (!obeys(c, h)) {
      continue;
    }
    const auto before = std::find_if(known.begin(), known.end(), [&](const ClosedContact& other) {
      return isSame(other.feature, features_[c]);
    });
    ClosedContact& contact = obeying.emplace_back();
    if (before != known.end()) {
      contact = *before;
    }
    contact.feature = features_[c];
  }
  return obeying;
}

// Of a joint's condition, among all of them.
int FoundContacts::indexOf(const ContactFeature& feature) const {
  const auto same = std::find_if(joints_.begin(), joints_.end(),
                                 [&](const ContactFeature& joint) { return isSame(joint, feature); });
  return static_cast<int>(same - joints_.begin());
}

ImpactContact FoundContacts::impactAt(std::size_t contact) const {
  const ContactFeature& feature = features_[contact];
  return impactContactOf(feature, states_[contact],
                         feature.isOfJoint() ? indexOf(feature) : ImpactContact::kNoJoint);
}

}  // namespace careen
