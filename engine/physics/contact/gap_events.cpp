#include "physics/contact/gap_events.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/falling_bracket.h"

namespace careen {
namespace {

constexpr int kMostRootPasses = 50;
/// [1] of a step: roots are told apart.
constexpr double kPolynomialRootWidth = 0x1p-50;
constexpr int kDipDepth = 8;

}  // namespace

void GapEvents::list(const FoundContacts& contacts, const GroupState& start, double h, double acceleration) {
  events_.clear();
  for (std::size_t c = 0; c < contacts.features().size(); ++c) {
    const ContactFeature& feature = contacts.features()[c];
    if (feature.axes != 0) {
      continue;  // its gap is that of the pair
    }
    if (!contacts.obeys(c, h)) {
      add({.kind = Kind::kFeature, .feature = feature}, start);
    } else if (feature.kind != ContactFeature::Kind::kPointOnWall && !feature.isOfJoint()) {
      add({.kind = Kind::kBeyond, .feature = feature}, start);
    }
  }
  for (const ContactFeature& joint : contacts.joints()) {
    if (!joint.holds() && !contacts.has(joint)) {
      add({.kind = Kind::kFeature, .feature = joint}, start);
    }
  }
  std::vector<double> reach;  // [m] by body: how far a point of it may come
  for (std::size_t i = 0; i < group_.boxes(); ++i) {
    const Kinematics at = group_.kinematics(i, start[i]);
    const double speed = at.velocity.norm() + at.angularVelocity.norm() * radiusOf(group_.body(i));
    reach.push_back(group_.isHeld(i) && !group_.isDriven(i) ? 0
                                                            : 2 * h * (speed + h * acceleration) + closed_);
  }
  for (std::size_t i = 0; i < group_.boxes(); ++i) {
    listCorners(contacts, start, i, reach[i], h);
    for (std::size_t j = i + 1; j < group_.boxes(); ++j) {
      if (group_.mayMeet(i, j, start, reach[i] + reach[j])) {
        listPairs(i, j, start);
      }
    }
  }
}

// Of all boxes of two bodies.
void GapEvents::listPairs(std::size_t a, std::size_t b, const GroupState& start) {
  for (int i = 0; i < group_.body(a).partCount(); ++i) {
    for (int j = 0; j < group_.body(b).partCount(); ++j) {
      add({.kind = Kind::kPair,
           .feature = {.a = static_cast<int>(a), .b = static_cast<int>(b), .boxA = i, .boxB = j}},
          start);
    }
  }
}

// Those of a body's corners that a half-space may stop and that are no contacts.
void GapEvents::listCorners(const FoundContacts& contacts, const GroupState& start, std::size_t body,
                            double reach, double h) {
  const double radius = radiusOf(group_.body(body));
  const auto isNear = [&](std::size_t wall) {
    const Pose frame = start[wall].pose();
    const WallPlane plane = planeOf(*group_.bodies()[wall].halfSpace, frame);
    double within = radius + reach;
    if (group_.isDriven(wall)) {
      const Kinematics at = group_.kinematics(wall, start[wall]);
      within += 2 * h * (at.velocityAt(start[body].position - frame.position).norm() +
                         at.angularVelocity.norm() * within);
    }
    return dot(plane.normal, start[body].position) - plane.offset <= within;
  };
  forCorners(group_.bodies(), body, isNear, [&](const ContactFeature& feature) {
    if (!contacts.has(feature)) {
      add({.kind = Kind::kFeature, .feature = feature}, start);
    }
  });
}

void GapEvents::add(const Event& added, const GroupState& start) {
  Moment now = momentOf(added, 0, start);
  if (added.kind == Kind::kBeyond && now.value < closed_) {
    return;
  }
  Event& event = events_.emplace_back(added);
  event.margin = std::max(0.0, 0.25 * closed_ - now.value);
  now.value += event.margin;
  for (double& face : now.faces) {
    face += event.margin;
  }
  event.start = now;
}

BoxAxes GapEvents::axesOf(const Event& pair, const GroupState& at) const {
  const Pose ofA = at[pair.a()].pose();
  const Pose ofB = at[pair.b()].pose();
  return {boxAt(ofA, group_.body(pair.a()), pair.feature.boxA),
          boxAt(ofB, group_.body(pair.b()), pair.feature.boxB)};
}

double GapEvents::value(const Event& event, const GroupState& at) const {
  if (event.kind == Kind::kPair) {
    return event.margin + axesOf(event, at).gap();
  }
  const ContactState state = group_.contactAt(event.feature, at);
  return event.margin + (event.kind == Kind::kBeyond ? -state.beyond : state.gap);
}

GapEvents::Moment GapEvents::momentOf(const Event& event, double time, const GroupState& at) const {
  Moment moment{.time = time};
  if (event.kind == Kind::kPair) {
    const BoxAxes axes = axesOf(event, at);
    moment.value = event.margin + axes.gap();
    moment.onEdges = axes.best().kind() == BoxAxis::Kind::kEdges;
    for (int k = 0; k < 6; ++k) {
      moment.faces[static_cast<std::size_t>(k)] = event.margin + axes.separation({k});
    }
  } else {
    moment.value = value(event, at);
  }
  return moment;
}

// The states of an event's bodies within the step.
const GroupState& GapEvents::within(const GroupPath& path, const Event& event, double time) {
  within_.resize(group_.size());
  within_[event.a()] = path.at(event.a(), time);
  within_[event.b()] = path.at(event.b(), time);
  return within_;
}

double GapEvents::firstRoot(const GroupPath& path) {
  double first = path.length();
  for (const Event& event : events_) {
    if (const double atEnd = value(event, path.step().end); atEnd < least()) {
      first = std::min(first, rootOf(event, path, atEnd));
    }
  }
  return first;
}

// Time at which an event function falls to about zero, on the polynomials of the step.
double GapEvents::rootOf(const Event& event, const GroupPath& path, double atEnd) {
  const double aim = 0.0625 * closed_;
  FallingBracket bracket{
      .high = path.length(), .valueLow = event.start.value - aim, .valueHigh = atEnd - aim};
  for (int k = 0; k < kMostRootPasses; ++k) {
    const double middle = bracket.next(kPolynomialRootWidth * path.length());
    const double now = value(event, within(path, event, middle)) - aim;
    if (std::fabs(now) <= aim) {
      return middle;
    }
    bracket.add(middle, now);
  }
  return bracket.low;
}

double GapEvents::firstDip(const GroupPath& path) {
  double first = 0;
  for (const Event& event : events_) {
    if (event.kind == Kind::kBeyond) {
      continue;
    }
    const Moment end = momentOf(event, path.length(), path.step().end);
    if (end.value < least()) {
      continue;
    }
    const double dip = dipWithin(event, path, boundsOn(event, path), event.start, end, kDipDepth);
    first = dip > 0 && (first == 0 || dip < first) ? dip : first;
  }
  return first;
}

// A time within the step where a gap is closed that is open at both its ends; else 0.
double GapEvents::dipWithin(const Event& event, const GroupPath& path, const Bounds& bounds,
                            const Moment& from, const Moment& to, int depth) {
  if (depth == 0 || staysOpen(event, path, bounds, from, to)) {
    return 0;
  }
  const double time = 0.5 * (from.time + to.time);
  const Moment middle = momentOf(event, time, within(path, event, time));
  if (middle.value < least()) {
    return time;
  }
  const double before = dipWithin(event, path, bounds, from, middle, depth - 1);
  return before > 0 ? before : dipWithin(event, path, bounds, middle, to, depth - 1);
}

GapEvents::Bounds GapEvents::boundsOn(const Event& event, const GroupPath& path) const {
  Bounds bounds;
  double linear = 0;
  double turning = 0;  // [1/s²]
  double spin = 0;
  double speed = 0;
  double lengths = 0;
  const auto add = [&](std::size_t body) {
    const double radius = radiusOf(group_.body(body));
    lengths += radius;
    if (!group_.isHeld(body) || group_.isDriven(body)) {
      const StepBounds of = group_.isDriven(body) ? boundsOf(group_.bodies()[body].drivenBy->motion)
                                                  : boundsOf(path.motion(body));
      const double turns = of.angularSpeed * of.angularSpeed + of.angularAcceleration;
      linear += of.acceleration;
      speed += of.speed;
      spin += of.angularSpeed;
      turning += turns;
      bounds.rate += of.speed + of.angularSpeed * radius;
      bounds.fixed += of.acceleration + turns * radius;
    }
  };
  add(event.a());
  add(event.b());
  const bool isBox = group_.bodies()[event.b()].isBox();
  if (!isBox && group_.isDriven(event.b())) {  // its origin may be far from the body
    const GroupState& start = path.step().start;
    lengths += (start[event.a()].position - start[event.b()].position).norm() + path.length() * speed;
  }
  bounds.curvature = linear + (isBox || group_.isDriven(event.b()) ? 2 * spin * speed + 2 * turning * lengths
                                                                   : turning * lengths);
  return bounds;
}

// Whether an event function stays open between two moments, as far as bounds tell. A function whose second
// derivative is at most c lies at most c h²/8 below its chord. The gap of two boxes is none: it is the
// largest of many separations, falls along one and rises along another. But where one of them is open, it is:
// that of a face, or along the edges' normal, fixed in space.
bool GapEvents::staysOpen(const Event& event, const GroupPath& path, const Bounds& bounds, const Moment& from,
                          const Moment& to) const {
  const double span = to.time - from.time;
  const double below = 0.125 * span * span;
  if (event.kind != Kind::kPair) {
    return std::min(from.value, to.value) - below * bounds.curvature >= least();
  }
  for (std::size_t k = 0; k < from.faces.size(); ++k) {
    if (std::min(from.faces[k], to.faces[k]) - below * bounds.curvature >= least()) {
      return true;
    }
  }
  return 0.5 * (from.value + to.value - bounds.rate * span) >= least() ||
         ((from.onEdges || to.onEdges) && staysOpenOnEdges(event, path, below * bounds.fixed, from, to));
}

bool GapEvents::staysOpenOnEdges(const Event& event, const GroupPath& path, double below, const Moment& from,
                                 const Moment& to) const {
  const Body& bodyA = group_.body(event.a());
  const Body& bodyB = group_.body(event.b());
  const auto posesAt = [&](double time) {
    return std::array<Pose, 2>{path.atOrEnd(event.a(), time).pose(), path.atOrEnd(event.b(), time).pose()};
  };
  const std::array<Pose, 2> first = posesAt(from.time);
  const std::array<Pose, 2> second = posesAt(to.time);
  const auto along = [&](const Vec3& direction, const std::array<Pose, 2>& poses) {
    return gapAlong(boxAt(poses[0], bodyA, event.feature.boxA), boxAt(poses[1], bodyB, event.feature.boxB),
                    direction);
  };
  const auto isOpenAlongNormalOf = [&](const std::array<Pose, 2>& poses) {
    const BoxAxes axes(boxAt(poses[0], bodyA, event.feature.boxA),
                       boxAt(poses[1], bodyB, event.feature.boxB));
    const Vec3 direction = axes.normal(axes.best());
    const double lowest = std::min(along(direction, first), along(direction, second));
    return event.margin + lowest - below >= least();
  };
  return (from.onEdges && isOpenAlongNormalOf(first)) || (to.onEdges && isOpenAlongNormalOf(second));
}

}  // namespace careen
