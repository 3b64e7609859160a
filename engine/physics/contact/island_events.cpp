#include <algorithm>
#include <cmath>

#include "core/math/falling_bracket.h"
#include "physics/contact/island.h"
#include "physics/geometry/separation.h"

// What ends a smooth motion of an island, and when.

namespace careen {
namespace {

using Mode = ContactForces::Mode;
using Kind = ContactFeature::Kind;

constexpr int kMostRefinements = 60;
/// [1] of a step: a root is good enough.
constexpr double kRootWidth = 0x1p-50;
constexpr double kRootValue = 0x1p-42;
constexpr double kShortestHop = 0x1p-30;
constexpr double kShortestStep = 0x1p-40;
/// [1] of the tolerance.
constexpr double kStrideDepth = 0.5;

}  // namespace

double Island::touching(std::size_t body) const {
  return touchingWithin(system_.kinematics(body).pose, bodies()[body].body->halfExtents);
}

void Island::watchAll() {
  watches_.clear();
  const std::vector<ContactFeature>& features = system_.features();
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (!system_.pushes(c)) {
      watches_.push_back({.kind = Watch::Kind::kGap, .contact = c});
      continue;
    }
    watches_.push_back({.kind = Watch::Kind::kPush, .contact = c});
    if (system_.modes()[c] == Mode::kStick) {
      watches_.push_back({.kind = Watch::Kind::kStick, .contact = c});
    }
    if (features[c].kind != Kind::kPointOnWall) {
      watches_.push_back({.kind = Watch::Kind::kWithin, .contact = c});
    }
  }
  for (std::size_t c = 0; c < features.size(); ++c) {
    const bool first = std::none_of(features.begin(), features.begin() + static_cast<std::ptrdiff_t>(c),
                                    [&](const ContactFeature& other) {
                                      return (other.a == features[c].a && other.b == features[c].b) ||
                                             (features[c].b.isBody(other.a) && other.b.isBody(features[c].a));
                                    });
    if (features[c].kind != Kind::kPointOnWall && first) {
      watches_.push_back({.kind = Watch::Kind::kOverlap, .contact = c});
    }
  }
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    for (std::size_t w = 0; w < (bodies()[i].isHeld() ? 0 : world_.walls.size()); ++w) {
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(bodies()[i].body->halfExtents, k);
        if (!hasCorner(features, static_cast<int>(i), Partner::ofWall(w), at)) {
          watches_.push_back(
              {.kind = Watch::Kind::kCorner, .contact = i, .wall = static_cast<int>(w), .corner = k});
        }
      }
    }
  }
}

// Forces are watched in smooth motion only: a stride shares them out itself.
void Island::noteStart() {
  atStart_.clear();
  for (Watch& watch : watches_) {
    watch.margin = 0;
    const double bare = strode_ && !Watch::isOfPlaces(watch.kind) ? 0 : value(watch);
    if (Watch::isOfPlaces(watch.kind)) {
      watch.margin = marginOf(watch, bare);
    }
    atStart_.push_back(bare + watch.margin);
    watch.rate = watch.kind == Watch::Kind::kCorner ? rateOf(watch) : 0;
  }
}

// [m] How deep it counts as nothing, if the gap is that much at the start of the step.
double Island::marginOf(const Watch& watch, double gap) const {
  if (watch.kind == Watch::Kind::kCorner) {
    // A corner that touches and yet is no contact parts: rounding is no landing.
    const double within = touching(watch.contact);
    return gap > within ? 0 : kTouching * within;
  }
  const ContactFeature& feature = system_.features()[watch.contact];
  const double within = kTouching * std::max(touching(static_cast<std::size_t>(feature.a)),
                                             touching(static_cast<std::size_t>(feature.b.body())));
  // What touches is brought together again where a stride ends, not on its way.
  return strode_ && gap <= within ? kStrideDepth * tolerance_ : within;
}

// The step ends where the first of the watches falls. What has been looked at where the step ended before may
// have fallen where it ends now.
void Island::locate(Step& step) {
  constexpr int kMostPasses = 4;
  const double shortest = kShortestStep * step.length;  // for what falls at once
  bool shorter = true;
  for (int pass = 0; pass < kMostPasses && shorter; ++pass) {
    shorter = false;
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      if (!strode_ || Watch::isOfPlaces(watches_[w].kind)) {
        shorter = locate(w, shortest, step) || shorter;
      }
    }
  }
}

bool Island::locate(std::size_t watch, double shortest, Step& step) {
  double until = step.length;
  double now = value(watches_[watch]);
  if (const double lowest = lowestWithin(step.length, watch, now); lowest > 0) {
    restep(lowest);
    const double there = value(watches_[watch]);
    if (there < 0) {
      until = lowest;
      now = there;
    } else {
      restep(step.length);
    }
  }
  const bool fell = now < 0 && (atStart_[watch] >= 0 || now < 2 * atStart_[watch]);
  if (!fell) {
    return false;
  }
  const double length = std::min(step.length, std::max(shortest, rootWithin(until, watch, now)));
  const bool shorter = length < step.length;
  step.length = length;
  step.end = End::kChanges;
  restep(step.length);
  return shorter;
}

bool Island::watches(std::size_t a, std::size_t b) const {
  const std::vector<ContactFeature>& features = system_.features();
  const auto isBetween = [&](std::size_t c) {
    const auto first = static_cast<std::size_t>(features[c].a);
    const auto second = static_cast<std::size_t>(features[c].b.body());
    return (first == a && second == b) || (first == b && second == a);
  };
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (!features[c].b.isWall() && isBetween(c) && system_.pushes(c)) {
      return true;
    }
  }
  const double within = kTouching * std::max(touching(a), touching(b));
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    if (watches_[w].kind == Watch::Kind::kOverlap && isBetween(watches_[w].contact) &&
        atStart_[w] - watches_[w].margin <= within) {
      return true;
    }
  }
  return false;
}

// [m/s] of a corner's gap.
double Island::rateOf(const Watch& corner) const {
  const Kinematics& at = system_.kinematics(corner.contact);
  const Vec3 arm =
      at.pose.worldFromBody * careen::corner(bodies()[corner.contact].body->halfExtents, corner.corner);
  return world_.walls[static_cast<std::size_t>(corner.wall)].normal.dot(at.velocity +
                                                                        at.angularVelocity.cross(arm));
}

// Where within the step something may have sunk and come up again; else 0.
double Island::lowestWithin(double h, std::size_t watch, double atEnd) const {
  if (!(atEnd >= 0)) {
    return 0;
  }
  switch (watches_[watch].kind) {
    case Watch::Kind::kCorner:
      return atStart_[watch] >= 0 ? lowestOfCorner(h, watch, atEnd) : 0;
    case Watch::Kind::kOverlap:
      return strode_ ? 0 : deepWithin(h, watches_[watch]);
    default:
      return 0;
  }
}

// The lowest point of the cubic through the corner's gap and rate at both ends, if that is below zero.
double Island::lowestOfCorner(double h, std::size_t watch, double atEnd) const {
  const double from = h * watches_[watch].rate;
  const double to = h * rateOf(watches_[watch]);
  const double rise = atEnd - atStart_[watch];
  const double b = 3 * rise - 2 * from - to;  // gap = start + from s + b s² + c s³
  const double c = from + to - 2 * rise;
  const double squared = b * b - 3 * from * c;
  if (!(squared > 0)) {
    return 0;
  }
  const double root = std::sqrt(squared);
  const double above = b > 0 ? -from : root - b;
  const double below = b > 0 ? b + root : 3 * c;
  if (!(above > 0 && above < below)) {
    return 0;
  }
  const double s = above / below;
  return atStart_[watch] + s * (from + s * (b + s * c)) < 0 ? s * h : 0;
}

// The first of a few moments at which the two share more than the tolerance.
double Island::deepWithin(double h, const Watch& watch) const {
  constexpr int kMoments = 4;
  const ContactFeature& feature = system_.features()[watch.contact];
  const auto a = static_cast<std::size_t>(feature.a);
  const auto b = static_cast<std::size_t>(feature.b.body());
  const Motion ofA = bodies()[a].isHeld() ? Motion(Rest{system_.kinematics(a).pose}) : motion(a, h);
  const Motion ofB = bodies()[b].isHeld() ? Motion(Rest{system_.kinematics(b).pose}) : motion(b, h);
  for (int k = 1; k < kMoments; ++k) {
    const double time = h * k / kMoments;
    const Pose poseA = stateAt(ofA, bodies()[a].body->mass, time).pose;
    const Pose poseB = stateAt(ofB, bodies()[b].body->mass, time).pose;
    if (BoxAxes(poseA, bodies()[a].body->halfExtents, poseB, bodies()[b].body->halfExtents).gap() <
        -tolerance_) {
      return time;
    }
  }
  return 0;
}

double Island::value(const Watch& watch) const {
  const std::size_t c = watch.contact;
  const ContactForces& forces = system_.forces();
  switch (watch.kind) {
    case Watch::Kind::kPush:
      return forces.forces()[c][0] / forces.normalMass(c);
    case Watch::Kind::kStick: {
      const ContactForces::Force& force = forces.forces()[c];
      return (system_.features()[c].material.friction * force[0] -
              std::sqrt(force[1] * force[1] + force[2] * force[2])) /
             forces.normalMass(c);
    }
    case Watch::Kind::kGap:
      return system_.states()[c].gap +
             kTouching * touching(static_cast<std::size_t>(system_.features()[c].a));
    case Watch::Kind::kWithin:
      return kTouching * touching(static_cast<std::size_t>(system_.features()[c].a)) -
             system_.states()[c].beyond;
    case Watch::Kind::kOverlap: {
      const ContactFeature& feature = system_.features()[c];
      const auto a = static_cast<std::size_t>(feature.a);
      const auto b = static_cast<std::size_t>(feature.b.body());
      return BoxAxes(system_.kinematics(a).pose, bodies()[a].body->halfExtents, system_.kinematics(b).pose,
                     bodies()[b].body->halfExtents)
                 .gap() +
             watch.margin;
    }
    case Watch::Kind::kCorner: {
      const Wall& wall = world_.walls[static_cast<std::size_t>(watch.wall)];
      return cornerGap(system_.kinematics(c).pose, corner(bodies()[c].body->halfExtents, watch.corner),
                       wall.normal, wall.offset) +
             watch.margin;
    }
  }
  return 0;
}

// Where watch falls to zero in (0, h]. The end where it has fallen is taken.
double Island::rootWithin(double h, std::size_t watch, double atEnd) {
  double valueLow = atStart_[watch];
  double valueHigh = atEnd;
  FallingBracket bracket{.high = h};
  // What has just parted is positive in between.
  for (double part = 0.5; !(valueLow > 0); part /= 2) {
    if (part < kShortestHop) {
      return bracket.high;
    }
    restep(part * h);
    const double at = value(watches_[watch]);
    if (at > 0) {
      bracket.low = part * h;
      valueLow = at;
    } else {
      bracket.high = part * h;
      valueHigh = at < 0 ? at : valueHigh;
    }
  }
  bracket.valueLow = valueLow;
  bracket.valueHigh = valueHigh;
  for (int k = 0; k < kMostRefinements && bracket.width() > kRootWidth * h; ++k) {
    if (-valueHigh <= kRootValue * valueLow) {
      break;
    }
    // A watch may be level and then fall: every third cut is in the middle.
    double middle = bracket.cut();
    if (k % 3 == 2 || !(middle > bracket.low && middle < bracket.high)) {
      middle = 0.5 * (bracket.low + bracket.high);
    }
    restep(middle);
    const double at = value(watches_[watch]);
    if (at < 0) {
      bracket.moveHigh(middle, at);
      valueHigh = at;
    } else {
      // The last bit of the way by bisection towards the far side: regula falsi would stay on this one.
      bracket.moveLow(middle, at);
      if (at <= kRootValue * valueLow) {
        const double beyond = std::min(bracket.high, middle + 0x1p-44 * h);
        restep(beyond);
        if (value(watches_[watch]) < 0) {
          return beyond;
        }
        bracket.low = beyond;
      }
    }
  }
  return bracket.high;
}

}  // namespace careen
