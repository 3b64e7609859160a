#include "question/quantity_spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "question/pieces.h"

namespace careen {
namespace {

constexpr double kUlps = 64 * std::numeric_limits<double>::epsilon();
constexpr double kUnseen = 1e-12;        // [1] of the level, where second derivatives are bounded
constexpr double kUnseenInSteps = 1e-9;  // [1] likewise, where only first ones are

constexpr double kSame = 1e-12;  // [1] of the run: rounding

double squared(double x) { return x * x; }

// In place of the quantity itself, a smooth function that grows with it: squares of lengths and speeds, and
// 1 − cos of the tilt.
class Smooth {
 public:
  Smooth(Quantity quantity, const Pieces& pieces) : quantity_(quantity), pieces_(pieces) {}

  double levelOf(double level) const;
  double at(double time) const;
  RateBounds bounds() const;
  /// What it is at most or, of places, what would be a small change.
  double scale() const;
  /// Whether it is a velocity in a step of contact, so short that what is corrected in place changes it more
  /// than it moves.
  bool isLost(const RunSettings& settings) const;

 private:
  RateBounds boundsOfSpeed(const MotionBounds& bounds) const;
  RateBounds boundsOfEnergy(const MotionBounds& bounds) const;
  RateBounds boundsOfDistance(const MotionBounds& bounds) const;
  const MovingBody& first() const { return pieces_[0]; }

  Quantity quantity_;
  const Pieces& pieces_;
};

// What is never negative is more than every negative level.
double Smooth::levelOf(double level) const {
  switch (quantity_) {
    case Quantity::kSpeed:
    case Quantity::kSpin:
    case Quantity::kDistance:
      return level < 0 ? -1 : squared(level);
    case Quantity::kTilt:
      return level < 0 ? -1 : level > 180 ? 3 : 2 * squared(std::sin(level * (M_PI / 360)));
    default:
      return level;
  }
}

double Smooth::at(double time) const {
  const auto state = [&] { return first().at(time); };
  switch (quantity_) {
    case Quantity::kX:
      return first().middleAt(time).x();
    case Quantity::kY:
      return first().middleAt(time).y();
    case Quantity::kHeight:
    case Quantity::kZ:
      return first().middleAt(time).z();
    case Quantity::kSpeed:
      return boxVelocity(*first().body, state()).squaredNorm();
    case Quantity::kSpin:
      return angularVelocity(first().body->mass, state()).squaredNorm();
    case Quantity::kEnergy:
      return kineticEnergy(first().body->mass, state());
    case Quantity::kTilt: {
      const Vec3 axis = state().pose.worldFromBody.col(2);
      // Without cancellation where the axis is nearly upright.
      return axis.z() > 0 ? (squared(axis.x()) + squared(axis.y())) / (1 + axis.z()) : 1 - axis.z();
    }
    default:
      return (first().middleAt(time) - pieces_[1].middleAt(time)).squaredNorm();
  }
}

RateBounds Smooth::boundsOfSpeed(const MotionBounds& bounds) const {
  const double arm = first().body->boxCenter.norm();
  const double speed = bounds.speed + bounds.spin * arm;
  const double rate = bounds.velocity.rate + (bounds.angularVelocity.rate + squared(bounds.spin)) * arm;
  const double third = arm == 0
                           ? 0
                           : (bounds.angularVelocity.bend + 3 * bounds.spin * bounds.angularVelocity.rate +
                              squared(bounds.spin) * bounds.spin) *
                                 arm;
  return {.rate = 2 * speed * rate, .bend = 2 * squared(rate) + 2 * speed * (bounds.velocity.bend + third)};
}

// ½ M v² + ½ ω·L: its rate is M v·a, and ω·dL/dt, where dL/dt is that of Jω in the body.
RateBounds Smooth::boundsOfEnergy(const MotionBounds& bounds) const {
  const MassProperties& mass = first().body->mass;
  RateBounds energy{
      .rate = mass.mass * bounds.speed * bounds.velocity.rate,
      .bend = mass.mass * (squared(bounds.velocity.rate) + bounds.speed * bounds.velocity.bend)};
  if (!std::holds_alternative<Flight>(first().segment.motion)) {  // whose energy of turning is constant
    energy.rate +=
        mass.inertiaBody.maxCoeff() * bounds.spin * (bounds.angularVelocity.rate + squared(bounds.spin));
    energy.bend = std::numeric_limits<double>::infinity();
  }
  return energy;
}

RateBounds Smooth::boundsOfDistance(const MotionBounds& bounds) const {
  const MovingBody& other = pieces_[1];
  const RateBounds a = first().middleBounds(bounds);
  const RateBounds b = other.middleBounds(other.boundsWithin(pieces_.from(), pieces_.to()));
  const double rate = a.rate + b.rate;
  const double near = (first().middleAt(pieces_.from()) - other.middleAt(pieces_.from())).norm();
  const double farthest = near + rate * (pieces_.to() - pieces_.from());
  return {.rate = 2 * farthest * rate, .bend = 2 * squared(rate) + 2 * farthest * (a.bend + b.bend)};
}

RateBounds Smooth::bounds() const {
  const MotionBounds bounds = first().boundsWithin(pieces_.from(), pieces_.to());
  const auto along = [&](const Vec3& direction) {
    const Segment& segment = first().segment;
    RateBounds of =
        boundsAlong(segment.motion, direction, pieces_.from() - segment.start, pieces_.to() - segment.start);
    const RateBounds middle = first().middleBounds(bounds);
    of.rate += middle.rate - bounds.place.rate;
    of.bend += middle.bend - bounds.place.bend;
    return of;
  };
  const RateBounds& turning = bounds.angularVelocity;
  switch (quantity_) {
    case Quantity::kX:
      return along(Vec3::UnitX());
    case Quantity::kY:
      return along(Vec3::UnitY());
    case Quantity::kHeight:
    case Quantity::kZ:
      return along(Vec3::UnitZ());
    case Quantity::kSpeed:
      return boundsOfSpeed(bounds);
    case Quantity::kSpin:
      return {.rate = 2 * bounds.spin * turning.rate,
              .bend = 2 * squared(turning.rate) + 2 * bounds.spin * turning.bend};
    case Quantity::kEnergy:
      return boundsOfEnergy(bounds);
    case Quantity::kTilt:
      return {.rate = bounds.spin, .bend = turning.rate + squared(bounds.spin)};
    default:
      return boundsOfDistance(bounds);
  }
}

double Smooth::scale() const {
  const MotionBounds bounds = first().boundsWithin(pieces_.from(), pieces_.to());
  const double radius = radiusOf(*first().body);
  const MassProperties& mass = first().body->mass;
  switch (quantity_) {
    case Quantity::kSpeed:
      return squared(bounds.speed + bounds.spin * first().body->boxCenter.norm());
    case Quantity::kSpin:
      return squared(bounds.spin);
    case Quantity::kEnergy:
      return 0.5 * (mass.mass * squared(bounds.speed) + mass.inertiaBody.maxCoeff() * squared(bounds.spin));
    case Quantity::kTilt:
      return 2;
    case Quantity::kDistance:
      return squared(radius);
    default:
      return radius;
  }
}

bool Smooth::isLost(const RunSettings& settings) const {
  constexpr double kTooShort = 1e-3;  // [1] of the tolerance: the way in the step
  const Motion& motion = first().segment.motion;
  if (quantity_ != Quantity::kSpeed && quantity_ != Quantity::kSpin && quantity_ != Quantity::kEnergy) {
    return false;
  }
  const MotionBounds bounds = first().boundsWithin(pieces_.from(), pieces_.to());
  const double way = (bounds.speed + bounds.spin * radiusOf(*first().body)) * (pieces_.to() - pieces_.from());
  return (std::holds_alternative<ContactStep>(motion) || std::holds_alternative<CrowdStep>(motion)) &&
         (way < kTooShort * settings.tolerance || pieces_.to() - pieces_.from() < kSame * settings.duration);
}

}  // namespace

std::vector<TrueSpan> quantitySpans(const Trajectory& run, const Question& question, double until) {
  std::vector<std::size_t> bodies;
  for (const Partner& each : question.of) {
    bodies.push_back(static_cast<std::size_t>(each.body()));
  }
  Pieces pieces(run, bodies, until);
  const Smooth smooth(question.quantity, pieces);
  const double level = smooth.levelOf(question.level);
  const double sign = question.kind == Question::Kind::kAbove ? 1 : -1;
  TrueSpans spans;
  while (pieces.next()) {
    SmoothPart part{.from = pieces.from(), .to = pieces.to(), .bounds = smooth.bounds()};
    const double size =
        std::max({std::fabs(level), std::fabs(smooth.at(part.from)), std::fabs(smooth.at(part.to))});
    constexpr double kSmallChange = 1e-2;
    part.size = std::max(size, kSmallChange * smooth.scale());
    part.rounding = kUlps * size;
    part.unseen = (std::isfinite(part.bounds.bend) ? kUnseen : kUnseenInSteps) * size;
    if (smooth.isLost(run.settings)) {
      part.bounds = {};
      const double from = smooth.at(part.from);
      spans.look(part, [&](double) { return sign * (from - level); });
    } else {
      spans.look(part, [&](double time) { return sign * (smooth.at(time) - level); });
    }
  }
  return spans.finish(until, kSame * until);
}

}  // namespace careen
