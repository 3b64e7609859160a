#include <algorithm>
#include <array>
#include <cmath>

#include "physics/contact/time_stepper.h"
#include "physics/geometry/separation.h"

// The event functions of a time step: gaps that may close in it, contacts that may leave their face.

namespace careen {

// The event functions of a step of length h from its start: gaps that may close, contacts that may leave
// their face.
void TimeStepper::listWatches(double h) {
  watches_.clear();
  for (const Found& found : found_) {
    if (found.feature.axes != 0) {
      continue;  // its gap is that of the pair
    }
    if (!obeys(found, h)) {
      watch({.kind = Watch::Kind::kFeature, .feature = found.feature});
    } else if (found.feature.kind != ContactFeature::Kind::kPointOnWall) {
      watch({.kind = Watch::Kind::kBeyond, .feature = found.feature});
    }
  }
  std::vector<double> reach;  // [m] by body: how far a point of it may come
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Kinematics at = equations_.kinematics(i, start_[i]);
    const double speed = at.velocity.norm() + at.angularVelocity.norm() * radiusOf(*bodies_[i].body);
    reach.push_back(bodies_[i].isHeld() ? 0 : 2 * h * (speed + h * acceleration_) + closed());
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      watchWalls(i, reach[i]);
    }
    for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
      if (!(bodies_[i].isHeld() && bodies_[j].isHeld()) && near(start_, i, j, reach[i] + reach[j])) {
        watch({.kind = Watch::Kind::kPair,
               .feature = {.a = static_cast<int>(i), .b = Partner::ofBody(static_cast<int>(j))}});
      }
    }
  }
}

void TimeStepper::watchWalls(std::size_t body, double reach) {
  const double radius = radiusOf(*bodies_[body].body);
  for (std::size_t w = 0; w < world_.walls.size(); ++w) {
    const Wall& wall = world_.walls[w];
    if (dot(wall.normal, start_[body].position) - wall.offset > radius + reach) {
      continue;
    }
    for (int k = 0; k < kCorners; ++k) {
      const ContactFeature feature{
          .a = static_cast<int>(body), .b = Partner::ofWall(w), .onA = corner(*bodies_[body].body, k)};
      if (std::none_of(found_.begin(), found_.end(),
                       [&](const Found& found) { return isSame(found.feature, feature); })) {
        watch({.kind = Watch::Kind::kFeature, .feature = feature});
      }
    }
  }
}

// Adds an event function; one that is already near zero may fall a little further.
void TimeStepper::watch(const Watch& added) {
  Moment now = momentOf(added, 0, start_);
  if (added.kind == Watch::Kind::kBeyond && now.value < closed()) {
    return;
  }
  Watch& watch = watches_.emplace_back(added);
  watch.margin = std::max(0.0, 0.25 * closed() - now.value);
  now.value += watch.margin;
  for (double& face : now.faces) {
    face += watch.margin;
  }
  watch.start = now;
}

BoxAxes TimeStepper::axesOf(const Watch& pair, const GroupState& at) const {
  const auto a = static_cast<std::size_t>(pair.feature.a);
  const auto b = static_cast<std::size_t>(pair.feature.b.body());
  const Pose ofA{at[a].position, at[a].worldFromBody.toRotationMatrix()};
  const Pose ofB{at[b].position, at[b].worldFromBody.toRotationMatrix()};
  return {boxAt(ofA, *bodies_[a].body), boxAt(ofB, *bodies_[b].body)};
}

double TimeStepper::value(const Watch& watch, const GroupState& at) const {
  if (watch.kind == Watch::Kind::kPair) {
    return watch.margin + axesOf(watch, at).gap();
  }
  const ContactState state = equations_.contactAt(watch.feature, at);
  return watch.margin + (watch.kind == Watch::Kind::kBeyond ? -state.beyond : state.gap);
}

GroupBody TimeStepper::bodyWithin(std::size_t body, double time) const {
  if (bodies_[body].isHeld()) {
    return start_[body];
  }
  const BodyState state = stateAt(Motion(motions_[body]), bodies_[body].body->mass, time);
  return {.position = state.pose.position,
          .worldFromBody = Quat(state.pose.worldFromBody),
          .velocity = state.velocity,
          .angularMomentum = state.angularMomentum};
}

// The states of the bodies of a watch within the step.
void TimeStepper::setWithin(const Watch& watch, double time) {
  const auto a = static_cast<std::size_t>(watch.feature.a);
  within_.resize(bodies_.size());
  within_[a] = bodyWithin(a, time);
  if (!watch.feature.b.isWall()) {
    const auto b = static_cast<std::size_t>(watch.feature.b.body());
    within_[b] = bodyWithin(b, time);
  }
}

double TimeStepper::valueWithin(const Watch& watch, double time) {
  setWithin(watch, time);
  return value(watch, within_);
}

TimeStepper::Bounds TimeStepper::boundsOn(const Watch& watch) const {
  Bounds bounds;
  double linear = 0;
  double turning = 0;  // [1/s²]
  double spin = 0;
  double speed = 0;
  double lengths = 0;
  const auto add = [&](std::size_t body) {
    const double radius = radiusOf(*bodies_[body].body);
    lengths += radius;
    if (!bodies_[body].isHeld()) {
      const StepBounds of = boundsOf(motions_[body]);
      const double turns = of.angularSpeed * of.angularSpeed + of.angularAcceleration;
      linear += of.acceleration;
      speed += of.speed;
      spin += of.angularSpeed;
      turning += turns;
      bounds.rate += of.speed + of.angularSpeed * radius;
      bounds.fixed += of.acceleration + turns * radius;
    }
  };
  add(static_cast<std::size_t>(watch.feature.a));
  const bool hasWall = watch.feature.b.isWall();
  if (!hasWall) {
    add(static_cast<std::size_t>(watch.feature.b.body()));
  }
  bounds.curvature = linear + (hasWall ? turning * lengths : 2 * spin * speed + 2 * turning * lengths);
  return bounds;
}

TimeStepper::Moment TimeStepper::momentOf(const Watch& watch, double time, const GroupState& at) const {
  Moment moment{.time = time};
  if (watch.kind == Watch::Kind::kPair) {
    const BoxAxes axes = axesOf(watch, at);
    moment.value = watch.margin + axes.gap();
    moment.onEdges = axes.best().kind() == BoxAxis::Kind::kEdges;
    for (int k = 0; k < 6; ++k) {
      moment.faces[static_cast<std::size_t>(k)] = watch.margin + axes.separation({k});
    }
  } else {
    moment.value = value(watch, at);
  }
  return moment;
}

Pose TimeStepper::poseWithin(std::size_t body, double time) const {
  const GroupBody at = time <= 0 ? start_[body] : time >= length_ ? end_[body] : bodyWithin(body, time);
  return {at.position, at.worldFromBody.toRotationMatrix()};
}

// Whether an event function stays open between two moments, as far as bounds tell. A function whose second
// derivative is at most c lies at most c h²/8 below its chord. The gap of two boxes is none: it is the
// largest of many separations, falls along one and rises along another. But where one of them is open, it is:
// that of a face, or along the edges' normal, fixed in space.
bool TimeStepper::staysOpen(const Watch& watch, const Bounds& bounds, const Moment& from,
                            const Moment& to) const {
  const double least = -0.5 * closed();
  const double span = to.time - from.time;
  const double below = 0.125 * span * span;
  if (watch.kind != Watch::Kind::kPair) {
    return std::min(from.value, to.value) - below * bounds.curvature >= least;
  }
  for (std::size_t k = 0; k < from.faces.size(); ++k) {
    if (std::min(from.faces[k], to.faces[k]) - below * bounds.curvature >= least) {
      return true;
    }
  }
  return 0.5 * (from.value + to.value - bounds.rate * span) >= least ||
         ((from.onEdges || to.onEdges) && staysOpenOnEdges(watch, below * bounds.fixed, from, to));
}

bool TimeStepper::staysOpenOnEdges(const Watch& watch, double below, const Moment& from,
                                   const Moment& to) const {
  const auto a = static_cast<std::size_t>(watch.feature.a);
  const auto b = static_cast<std::size_t>(watch.feature.b.body());
  const Body& bodyA = *bodies_[a].body;
  const Body& bodyB = *bodies_[b].body;
  const std::array<Pose, 2> first{poseWithin(a, from.time), poseWithin(b, from.time)};
  const std::array<Pose, 2> second{poseWithin(a, to.time), poseWithin(b, to.time)};
  const auto along = [&](const Vec3& direction, const std::array<Pose, 2>& poses) {
    return gapAlong(boxAt(poses[0], bodyA), boxAt(poses[1], bodyB), direction);
  };
  const auto isOpenAlongNormalOf = [&](const std::array<Pose, 2>& poses) {
    const BoxAxes axes(boxAt(poses[0], bodyA), boxAt(poses[1], bodyB));
    const Vec3 direction = axes.normal(axes.best());
    const double lowest = std::min(along(direction, first), along(direction, second));
    return watch.margin + lowest - below >= -0.5 * closed();
  };
  return (from.onEdges && isOpenAlongNormalOf(first)) || (to.onEdges && isOpenAlongNormalOf(second));
}

// A time within the step where a gap is closed that is open at both its ends; else 0.
double TimeStepper::dipWithin(const Watch& watch, const Bounds& bounds, const Moment& from, const Moment& to,
                              int depth) {
  if (depth == 0 || staysOpen(watch, bounds, from, to)) {
    return 0;
  }
  const double time = 0.5 * (from.time + to.time);
  setWithin(watch, time);
  const Moment middle = momentOf(watch, time, within_);
  if (middle.value < -0.5 * closed()) {
    return time;
  }
  const double before = dipWithin(watch, bounds, from, middle, depth - 1);
  return before > 0 ? before : dipWithin(watch, bounds, middle, to, depth - 1);
}

void TimeStepper::setMotions(const GroupState& to) {
  motions_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      motions_[i] = motion(i, to);
    }
  }
}

double TimeStepper::firstDip() {
  constexpr int kDepth = 8;
  setMotions(end_);
  double first = 0;
  for (const Watch& watch : watches_) {
    if (watch.kind == Watch::Kind::kBeyond) {
      continue;
    }
    const Moment end = momentOf(watch, length_, end_);
    if (end.value < -0.5 * closed()) {
      continue;
    }
    const double dip = dipWithin(watch, boundsOn(watch), watch.start, end, kDepth);
    first = dip > 0 && (first == 0 || dip < first) ? dip : first;
  }
  return first;
}

}  // namespace careen
