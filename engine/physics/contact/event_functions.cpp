#include "physics/contact/event_functions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/geometry/separation.h"

namespace careen {
namespace {

using Mode = ContactForces::Mode;

/// How far below zero an event is located: [1] of what counts as touching, for gaps; of the accelerations,
/// for forces; of what counts as none, for rates.
constexpr double kRootGap = 0x1p-10;
constexpr double kRootForce = 0x1p-44;
constexpr double kRootRate = 0x1p-3;
/// [1] of the current accelerations: a contact with no more tension than this is about to open.
constexpr double kTension = 0x1p-20;

}  // namespace

void EventFunctions::list() {
  functions_.clear();
  listContacts();
  listCorners();
}

void EventFunctions::listContacts() {
  using Kind = EventFunction::Kind;
  const std::vector<ContactFeature>& features = system_.features();
  const auto isOfBoxes = [&](const ContactFeature& feature) {
    return feature.kind != ContactFeature::Kind::kPointOnWall && !feature.isOfJoint();
  };
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (features[c].holds()) {
      continue;
    }
    if (features[c].grips()) {
      functions_.push_back(
          {.kind = system_.modes()[c] == Mode::kStick ? Kind::kStick : Kind::kHalt, .contact = c});
      continue;
    }
    if (!system_.pushes(c)) {
      functions_.push_back({.kind = Kind::kGap, .contact = c});
      continue;
    }
    functions_.push_back({.kind = Kind::kPush, .contact = c});
    if (system_.modes()[c] == Mode::kStick) {
      functions_.push_back({.kind = Kind::kStick, .contact = c});
    }
    if (isOfBoxes(features[c])) {
      functions_.push_back({.kind = Kind::kWithin, .contact = c});
    }
  }
  for (std::size_t c = 0; c < features.size(); ++c) {
    const bool first = std::none_of(
        features.begin(), features.begin() + static_cast<std::ptrdiff_t>(c),
        [&](const ContactFeature& other) { return other.isBetween(features[c].ofA(), features[c].ofB()); });
    if (isOfBoxes(features[c]) && first) {
      functions_.push_back({.kind = Kind::kOverlap, .contact = c});
    }
  }
  for (std::size_t k = 0; k < system_.openEnds().size(); ++k) {
    functions_.push_back({.kind = Kind::kOpenEnd, .contact = k});
  }
}

void EventFunctions::listCorners() {
  for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
    const auto isNear = [](std::size_t) { return true; };
    forCorners(system_.bodies(), i, isNear, [&](const ContactFeature& corner) {
      if (!hasCorner(system_.features(), corner)) {
        functions_.push_back({.kind = EventFunction::Kind::kCorner,
                              .contact = i,
                              .halfSpace = corner.b,
                              .corner = corner.onA});
      }
    });
  }
}

void EventFunctions::noteStart() {
  for (EventFunction& event : functions_) {
    event.margin = 0;
    const double bare = valueOf(event);
    if (event.isOfPlaces()) {
      event.margin = marginOf(event, bare);
    }
    event.start = bare + event.margin;
    event.rate = event.hasRate() ? rateOf(event) : 0;
  }
}

const ContactFeature* EventFunctions::endOf(const EventFunction& event) const {
  if (event.kind == EventFunction::Kind::kOpenEnd) {
    return &system_.openEnds()[event.contact];
  }
  const bool isOfEnd =
      event.kind == EventFunction::Kind::kGap && system_.features()[event.contact].isOfJoint();
  return isOfEnd ? &system_.features()[event.contact] : nullptr;
}

// The first body of it.
std::size_t EventFunctions::bodyOf(const EventFunction& event) const {
  if (event.kind == EventFunction::Kind::kOpenEnd) {
    return static_cast<std::size_t>(system_.openEnds()[event.contact].a);
  }
  return event.kind == EventFunction::Kind::kCorner ? event.contact : firstBody(event.contact);
}

// [m] Penetration that is ignored, given the gap at the start of the step.
double EventFunctions::marginOf(const EventFunction& event, double gap) const {
  if (event.isOfOne()) {
    // A corner that touches but is no contact is separating: rounding error must not count as an impact.
    const double within = system_.touching(bodyOf(event));
    return gap > within ? 0 : kTouching * within;
  }
  return kTouching *
         std::max(system_.touching(firstBody(event.contact)), system_.touching(secondBody(event.contact)));
}

double EventFunctions::valueOf(const EventFunction& event) const {
  const std::size_t c = event.contact;
  const ContactForces& forces = system_.forces();
  switch (event.kind) {
    case EventFunction::Kind::kPush:
      return forces.forces()[c][0] / forces.normalMass(c);
    case EventFunction::Kind::kStick: {
      const ContactForces::Force& force = forces.forces()[c];
      if (system_.features()[c].grips()) {
        return (system_.states()[c].grip - std::fabs(force[0])) / forces.normalMass(c);
      }
      return (system_.features()[c].material.friction * force[0] -
              std::sqrt(force[1] * force[1] + force[2] * force[2])) /
             forces.normalMass(c);
    }
    case EventFunction::Kind::kGap:
      return system_.states()[c].gap + kTouching * system_.touching(firstBody(c));
    case EventFunction::Kind::kWithin:
      return kTouching * system_.touching(firstBody(c)) - system_.states()[c].beyond;
    case EventFunction::Kind::kOverlap: {
      const std::size_t a = firstBody(c);
      const std::size_t b = secondBody(c);
      return BoxAxes(boxAt(system_.kinematics(a).pose, *system_.bodies()[a].body, system_.features()[c].boxA),
                     boxAt(system_.kinematics(b).pose, *system_.bodies()[b].body, system_.features()[c].boxB))
                 .gap() +
             event.margin;
    }
    case EventFunction::Kind::kCorner: {
      const WallPlane plane = planeFor(event);
      return cornerGap(system_.kinematics(c).pose, event.corner, plane.normal, plane.offset) + event.margin;
    }
    case EventFunction::Kind::kOpenEnd:
      return system_.stateOf(system_.openEnds()[c]).gap + event.margin;
    case EventFunction::Kind::kHalt:
      return system_.sideOf(c) * system_.states()[c].rate;
  }
  return 0;
}

double EventFunctions::lowest(std::span<const std::size_t> events) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::size_t event : events) {
    lowest = std::min(lowest, value(event));
  }
  return lowest;
}

double EventFunctions::depth(std::span<const std::size_t> events) const {
  double within = 0;
  for (const std::size_t w : events) {
    const EventFunction& event = functions_[w];
    if (event.isOfForces()) {
      return kRootForce * system_.forces().scale();
    }
    if (event.kind == EventFunction::Kind::kHalt) {
      return kRootRate * system_.stillRate(event.contact);
    }
    within = std::max(within, system_.touching(bodyOf(event)));
  }
  return kRootGap * within;
}

double EventFunctions::rateOf(const EventFunction& event) const {
  if (event.kind == EventFunction::Kind::kHalt) {
    return system_.sideOf(event.contact) * system_.forces().excess(event.contact, 0);
  }
  const EventFunction& corner = event;
  const Kinematics& at = system_.kinematics(corner.contact);
  const Vec3 arm = at.pose.worldFromBody * corner.corner;
  const Vec3 velocity = at.velocity + at.angularVelocity.cross(arm);
  const Kinematics& wall = system_.kinematics(static_cast<std::size_t>(corner.halfSpace));
  const Vec3& normal = planeFor(corner).normal;
  return dot(normal, wall.isDriven
                         ? Vec3(velocity - wall.velocityAt(at.pose.position + arm - wall.pose.position))
                         : velocity);
}

WallPlane EventFunctions::planeFor(const EventFunction& corner) const {
  const auto index = static_cast<std::size_t>(corner.halfSpace);
  return planeOf(*system_.bodies()[index].halfSpace, system_.kinematics(index).pose);
}

bool EventFunctions::hasTension() const {
  const double least = -kTension * system_.forces().scale();
  return std::any_of(functions_.begin(), functions_.end(), [&](const EventFunction& event) {
    return event.kind == EventFunction::Kind::kPush && event.start < least;
  });
}

bool EventFunctions::coverBoxes(const BoxOf& a, const BoxOf& b) const {
  const std::vector<ContactFeature>& features = system_.features();
  const auto isBetween = [&](std::size_t c) { return features[c].isBetween(a, b); };
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (isBetween(c) && system_.pushes(c)) {
      return true;
    }
  }
  const double within = kTouching * std::max(system_.touching(static_cast<std::size_t>(a.body)),
                                             system_.touching(static_cast<std::size_t>(b.body)));
  return std::any_of(functions_.begin(), functions_.end(), [&](const EventFunction& event) {
    return event.kind == EventFunction::Kind::kOverlap && isBetween(event.contact) &&
           event.start - event.margin <= within;
  });
}

bool EventFunctions::areClear() const {
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    if (system_.pushes(c) || system_.states()[c].gap < kTouching * system_.touching(firstBody(c))) {
      return false;
    }
  }
  return !system_.features().empty();
}

}  // namespace careen
