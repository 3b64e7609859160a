#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/search/concave_bound.h"
#include "physics/search/first_contact_search.h"
#include "physics/search/time_of_impact.h"

namespace careen {
namespace {

// Below this sine of the angle between edges their cross product is not used as a rotating direction: the
// proof is the one fixed in space, which needs no derivative of the direction.
constexpr double kTurningEdges = 0x1p-7;
// While a grazing contact is tested for sinking, edges must be this far from parallel, so that the floor
// means the same.
constexpr double kGrazingEdges = 0x1p-3;

double sumOfSizes(const Vec3& v) { return std::fabs(v.x()) + std::fabs(v.y()) + std::fabs(v.z()); }

class BoxApproach {
 public:
  BoxApproach(const MovingBox& a, const MovingBox& b)
      : a_(a),
        b_(b),
        bToA_(a.positionAt(0) - b.positionAt(0)),
        velocity_(a.velocityAt(0) - b.velocityAt(0)),
        acceleration_(a.accelerationAfter(a.age) - b.accelerationAfter(b.age)),
        radiusA_(a.radius()),
        radiusB_(b.radius()),
        offCenter_(!a.center.isZero(0) || !b.center.isZero(0)),
        spheres_((radiusA_ + radiusB_) * kSphere),
        turningA_(turningBound(a)),
        turningB_(turningBound(b)),
        turningBoth_((turningA_ + turningB_) + 2 * a.angularSpeedBound * b.angularSpeedBound),
        steps_(!a.isFlight() || !b.isFlight() || a.jerk != b.jerk),
        gravity_(steps_ ? accelerationOf(a) + accelerationOf(b) : acceleration_.norm()) {}

  double skip(double time) const;
  void moveTo(double time);

  double gap() const { return axes_->gap(); }
  double tolerance() const { return tolerance_; }
  // Rates are needed only where the search ends.
  bool closing() {
    findRates();
    return closing_;
  }
  bool closesHard() const { return fasterThanSinking(approach_, curvature_, tolerance_); }
  double freeStep(double floor, double most) const;
  double polish(double level) const { return newtonStep(gap() - level, approach_, curvature_); }
  FirstContact describe() {
    findRates();
    FirstContact contact;
    contact.approach = approach_;
    contact.axis = axes_->best();
    contact.normal = axes_->normal(contact.axis);
    return contact;
  }

 private:
  static double accelerationOf(const MovingBox& box) {
    return box.isFlight() ? std::max(box.acceleration.norm(), box.accelerationAfter(box.lasts).norm())
                          : box.accelerationBound;
  }
  Vec3 offsetAt(double time) const {
    return steps_ ? a_.positionAt(time) - b_.positionAt(time)
                  : Vec3(bToA_ + (velocity_ + 0.5 * time * acceleration_) * time);
  }
  Vec3 velocityAt(double time) const {
    return steps_ ? a_.velocityAt(time) - b_.velocityAt(time) : Vec3(velocity_ + time * acceleration_);
  }
  double skipStraight(double time) const;
  double skipCurved(double time) const;
  double skipInSteps(double time) const;
  void boundTranslation(double time);
  void findRates();

  /// Bound along a direction that rotates with the boxes; for edges, times sine(axis).
  ConcaveBound bound(BoxAxis axis) const;
  ConcaveBound faceOfABound(int i) const;
  ConcaveBound faceOfBBound(int j) const;
  ConcaveBound edgeBound(int i, int j) const;
  /// Bound along the axis' current direction, fixed in space.
  ConcaveBound restingBound(BoxAxis axis) const;
  bool turnsWell(BoxAxis axis, double least) const {
    return axis.kind() != BoxAxis::Kind::kEdges || sine(axis) >= least;
  }
  double sine(BoxAxis axis) const {
    return axis.kind() == BoxAxis::Kind::kEdges ? axes_->sine(axis.edgeOfA(), axis.edgeOfB()) : 1;
  }
  /// Rate of aᵢ·bⱼ.
  double cosineRate(int i, int j) const { return dot(relativeTurning_, axes_->cross(i, j)); }

  const MovingBox& a_;
  const MovingBox& b_;
  const Vec3 bToA_;
  const Vec3 velocity_;
  const Vec3 acceleration_;
  const double radiusA_;
  const double radiusB_;
  const bool offCenter_;
  const double spheres_;
  const double turningA_;
  const double turningB_;
  const double turningBoth_;
  const bool steps_;      // one of them is in a ContactStep, or driven, or has a jerk of its own
  const double gravity_;  // [m/s²] bounds the relative acceleration

  // At the current time:
  Attitude nowA_;
  Attitude nowB_;
  Vec3 offset_ = Vec3::Zero();
  Vec3 rate_ = Vec3::Zero();
  Vec3 relativeTurning_ = Vec3::Zero();
  std::optional<BoxAxes> axes_;
  double mostDistance_ = 0;  // [m] |Δ| and
  double mostSpeed_ = 0;     // [m/s] |Δ̇| stay below these
  double validity_ = 0;      // [s] for this long
  double tolerance_ = 0;
  double rateTolerance_ = 0;
  double approach_ = 0;
  double curvature_ = 0;
  bool closing_ = false;
  bool ratesKnown_ = false;
};

double BoxApproach::skip(double time) const {
  if (offsetAt(time).squaredNorm() <= spheres_ * spheres_) {
    return time;
  }
  return steps_ ? skipInSteps(time) : gravity_ == 0 ? skipStraight(time) : skipCurved(time);
}

// |Δ + Δ̇ s| = R. The discriminant as a cross product: no cancellation far away.
double BoxApproach::skipStraight(double time) const {
  const Vec3 offset = offsetAt(time);
  const double along = dot(offset, velocity_);
  const double discriminant =
      velocity_.squaredNorm() * spheres_ * spheres_ - offset.cross(velocity_).squaredNorm();
  if (along >= 0 || discriminant < 0) {
    return kNever;
  }
  const double clear = offset.squaredNorm() - spheres_ * spheres_;
  return time + clear / (std::sqrt(discriminant) - along);
}

// A body in flight against a fixed one: |Δ| is at least its component along any direction u, which is a
// parabola; step to its root, update u, repeat. Stops short of contact, where the spheres come close.
double BoxApproach::skipCurved(double time) const {
  constexpr int kMostSteps = 64;
  const double close = spheres_ * (1 + 0x1p-10);
  for (int step = 0; step < kMostSteps && time < kNever; ++step) {
    const Vec3 offset = offsetAt(time);
    const double distance = offset.norm();
    if (distance <= close) {
      return time;
    }
    const Vec3 u = offset / distance;
    time += firstRoot(distance - spheres_, dot(u, velocityAt(time)), -dot(u, acceleration_), kNever);
  }
  return time;
}

// At the current relative speed plus what it can gain.
double BoxApproach::skipInSteps(double time) const {
  const Vec3 offset = offsetAt(time);
  const double distance = offset.norm();
  const Vec3 velocity = velocityAt(time);
  return time + firstRoot(distance - spheres_, dot(offset, velocity) / distance, gravity_, kNever);
}

// In straight flight the distance of the centres is a convex function of time: it stays below R_a + R_b until
// the spheres separate for good. Otherwise the bounds hold until the centres can have moved half that length.
void BoxApproach::boundTranslation(double time) {
  if (gravity_ == 0 && !steps_) {
    mostSpeed_ = velocity_.norm();
    mostDistance_ = std::max(spheres_, offset_.norm());
    const double squaredSpeed = velocity_.squaredNorm();
    const double along = dot(offset_, velocity_);
    const double discriminant = squaredSpeed * spheres_ * spheres_ - offset_.cross(velocity_).squaredNorm();
    const double ahead = discriminant > 0 ? std::sqrt(discriminant) - along : -along;
    validity_ = squaredSpeed > 0 && ahead < kNever * squaredSpeed ? ahead / squaredSpeed : kNever;
    // At the very edge of the spheres rounding may leave no time: a tiny distance, added to the bound, gives
    // some.
    const double least = 0x1p-20 * spheres_;
    if (squaredSpeed > 0 && validity_ * mostSpeed_ < least) {
      validity_ = least / mostSpeed_;
      mostDistance_ += least;
    }
    return;
  }
  const double speed = velocityAt(time).norm();
  const double reach = 0.5 * spheres_;
  // v s + ½ g s² ≤ reach for s = reach / (v + sqrt(½ g reach)).
  const double pace = speed + std::sqrt(0.5 * gravity_ * reach);
  validity_ = pace > 0 ? reach / pace : kNever;
  mostSpeed_ = speed + gravity_ * validity_;
  mostDistance_ = offset_.norm() + reach;
}

void BoxApproach::moveTo(double time) {
  const double elapsedA = a_.age + time;
  const double elapsedB = b_.age + time;
  nowA_ = a_.attitudeAfter(elapsedA);
  nowB_ = b_.attitudeAfter(elapsedB);
  offset_ = offsetAt(time);
  rate_ = velocityAt(time);
  relativeTurning_ = nowA_.angularVelocity - nowB_.angularVelocity;
  boundTranslation(time);
  if (offCenter_) {  // from here on, of the boxes' middles
    const Vec3 armA = nowA_.worldFromBody * a_.center;
    const Vec3 armB = nowB_.worldFromBody * b_.center;
    offset_ += armA - armB;
    rate_ += nowA_.angularVelocity.cross(armA) - nowB_.angularVelocity.cross(armB);
  }
  axes_.emplace(nowA_.worldFromBody, a_.halfExtents, nowB_.worldFromBody, b_.halfExtents, offset_);

  const auto lengths = [](const MovingBox& box, double elapsed) {
    if (box.step != nullptr) {
      return sumOfSizes(box.step->position[0]) + box.speedBound * elapsed;
    }
    if (box.driven != nullptr) {
      return sumOfSizes(box.driven->pivot) + sumOfSizes(box.driven->arm) + sumOfSizes(box.driven->amplitude) +
             box.speedBound * elapsed;
    }
    return sumOfSizes(box.position) +
           elapsed * (sumOfSizes(box.velocity) + 0.5 * elapsed * sumOfSizes(mostOf(box)));
  };
  const auto speeds = [](const MovingBox& box, double elapsed) {
    if (!box.isFlight()) {
      return box.speedBound;
    }
    return sumOfSizes(box.velocity) + elapsed * sumOfSizes(mostOf(box));
  };
  tolerance_ = kGapRounding * ((lengths(a_, elapsedA) + lengths(b_, elapsedB)) + spheres_);
  rateTolerance_ = kRateRounding * ((speeds(a_, elapsedA) + speeds(b_, elapsedB)) +
                                    spheres_ * (a_.angularSpeedBound + b_.angularSpeedBound));
  ratesKnown_ = false;
}

// The gap is the largest separation, so its rate is the largest among the axes that attain it.
void BoxApproach::findRates() {
  if (ratesKnown_) {
    return;
  }
  ratesKnown_ = true;
  closing_ = true;
  approach_ = kNever;
  curvature_ = 0;
  // Boxes that overlap within the contact tolerance may separate along any axis.
  const double alike = axes_->gap() < -tolerance_ ? kSimultaneous * std::min(radiusA_, radiusB_) : tolerance_;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    const BoxAxis axis{k};
    if (axes_->separation(axis) < axes_->gap() - alike) {
      continue;
    }
    const bool turning = turnsWell(axis, kTurningEdges);
    const double length = turning ? sine(axis) : 1;
    const ConcaveBound f = turning ? bound(axis) : restingBound(axis);
    const double closing = -f.rateAhead(tolerance_ * length);
    curvature_ = std::max(curvature_, f.curvature() / length);
    closing_ = closing_ && closing > rateTolerance_;
    approach_ = std::min(approach_, closing / length);
  }
}

double BoxApproach::freeStep(double floor, double most) const {
  const double reach = std::min(most, validity_);
  const bool grazing = floor < 0;
  double best = 0;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    const BoxAxis axis{k};
    const double separation = axes_->separation(axis);
    // Far from contact only the axis of largest separation is worth evaluating; ties are all evaluated, so
    // that the result does not depend on which box is called a.
    if (separation <= floor || (!grazing && separation < axes_->gap())) {
      continue;
    }
    if (turnsWell(axis, grazing ? kGrazingEdges : kTurningEdges)) {
      double allowed = reach;
      if (grazing && axis.kind() == BoxAxis::Kind::kEdges) {
        const double turning = a_.angularSpeedBound + b_.angularSpeedBound;
        allowed = 2 * turning * reach > sine(axis) ? 0.5 * sine(axis) / turning : reach;
      }
      best = std::max(best, bound(axis).firstReach(floor * sine(axis), allowed));
    }
    best = std::max(best, restingBound(axis).firstReach(floor, reach));
  }
  return best;
}

ConcaveBound BoxApproach::bound(BoxAxis axis) const {
  switch (axis.kind()) {
    case BoxAxis::Kind::kFaceOfA:
      return faceOfABound(axis.index);
    case BoxAxis::Kind::kFaceOfB:
      return faceOfBBound(axis.index - 3);
    case BoxAxis::Kind::kEdges:
      break;
  }
  return edgeBound(axis.edgeOfA(), axis.edgeOfB());
}

ConcaveBound BoxApproach::faceOfABound(int i) const {
  const Vec3 face = nowA_.worldFromBody.col(i);
  const double along = dot(face, offset_);
  const double alongRate = dot(nowA_.angularVelocity.cross(face), offset_) + dot(face, rate_);
  const double curvature =
      turningA_ * mostDistance_ + 2 * a_.angularSpeedBound * mostSpeed_ + gravity_ + turningBoth_ * radiusB_;
  ConcaveBound f(std::fabs(along) - a_.halfExtents(i), along < 0 ? -alongRate : alongRate, curvature);
  for (int j = 0; j < 3; ++j) {
    f.addKink(b_.halfExtents(j), axes_->cosine(i, j), cosineRate(i, j));
  }
  return f;
}

ConcaveBound BoxApproach::faceOfBBound(int j) const {
  const Vec3 face = nowB_.worldFromBody.col(j);
  const double along = dot(face, offset_);
  const double alongRate = dot(nowB_.angularVelocity.cross(face), offset_) + dot(face, rate_);
  const double curvature =
      turningB_ * mostDistance_ + 2 * b_.angularSpeedBound * mostSpeed_ + gravity_ + turningBoth_ * radiusA_;
  ConcaveBound f(std::fabs(along) - b_.halfExtents(j), along < 0 ? -alongRate : alongRate, curvature);
  for (int i = 0; i < 3; ++i) {
    f.addKink(a_.halfExtents(i), axes_->cosine(i, j), cosineRate(i, j));
  }
  return f;
}

// N = aᵢ × bⱼ. For the other edges, N·a is up to sign the cosine of b's edge with a's third, and likewise for
// b: kinks have no sign. For which products cancel, see BoxAxes.
ConcaveBound BoxApproach::edgeBound(int i, int j) const {
  const Vec3 edgeA = nowA_.worldFromBody.col(i);
  const Vec3 edgeB = nowB_.worldFromBody.col(j);
  const Vec3& n = axes_->cross(i, j);
  const Vec3 nRate =
      nowA_.angularVelocity.cross(edgeA).cross(edgeB) + edgeA.cross(nowB_.angularVelocity.cross(edgeB));
  const double along = dot(n, offset_);
  const double alongRate = dot(nRate, offset_) + dot(n, rate_);
  const double curvature = turningBoth_ * (mostDistance_ + (radiusA_ + radiusB_)) +
                           2 * (a_.angularSpeedBound + b_.angularSpeedBound) * mostSpeed_ + gravity_;
  ConcaveBound f(std::fabs(along), along < 0 ? -alongRate : alongRate, curvature);
  for (int k = 1; k < 3; ++k) {
    const int across = (i + k) % 3;
    const int other = (i + 3 - k) % 3;
    f.addKink(a_.halfExtents(across), axes_->cosine(other, j), cosineRate(other, j));
  }
  f.beginSecondBox();
  for (int k = 1; k < 3; ++k) {
    const int across = (j + k) % 3;
    const int other = (j + 3 - k) % 3;
    f.addKink(b_.halfExtents(across), axes_->cosine(i, other), cosineRate(i, other));
  }
  return f;
}

ConcaveBound BoxApproach::restingBound(BoxAxis axis) const {
  const Vec3 u = axes_->normal(axis);
  const double curvature = std::max(
      0.0, (turningA_ * radiusA_ + turningB_ * radiusB_) + (steps_ ? gravity_ : -dot(u, acceleration_)));
  ConcaveBound f(dot(u, offset_), dot(u, rate_), curvature);
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = nowA_.worldFromBody.col(i);
    f.addKink(a_.halfExtents(i), dot(u, edge), dot(u, nowA_.angularVelocity.cross(edge)));
  }
  f.beginSecondBox();
  for (int j = 0; j < 3; ++j) {
    const Vec3 edge = nowB_.worldFromBody.col(j);
    f.addKink(b_.halfExtents(j), dot(u, edge), dot(u, nowB_.angularVelocity.cross(edge)));
  }
  return f;
}

}  // namespace

FirstContact firstContactOfBoxes(const MovingBox& a, const MovingBox& b, const SearchWindow& window) {
  BoxApproach approach(a, b);
  return findFirstContact(approach, window);
}

}  // namespace careen
