#include "physics/search/driven_wall.h"

#include <algorithm>
#include <cmath>

#include "physics/search/concave_bound.h"
#include "physics/search/first_contact_search.h"

namespace careen {
namespace {

class DrivenWallApproach {
 public:
  DrivenWallApproach(const MovingBox& box, const DrivenWall& wall)
      : box_(box),
        wall_(wall),
        rates_(boundsOf(wall.driven)),
        turningWall_(rates_.angularSpeed * rates_.angularSpeed + rates_.angularAcceleration),
        turningBoth_(turningBound(box) + 2 * box.angularSpeedBound * rates_.angularSpeed + turningWall_),
        radius_(box.radius()),
        acceleration_(std::max(box.acceleration.norm(), box.accelerationAfter(box.lasts).norm()) +
                      rates_.acceleration) {}

  // At the current speed plus what it can gain.
  double skip(double time) {
    moveCentre(time);
    const double clear = dot(normal_, offset_) - radius_ * kSphere;
    return clear > 0 ? time + std::min(validity_, firstRoot(clear, centreRate(), centreCurvature(), kNever))
                     : time;
  }

  void moveTo(double time) {
    moveCentre(time);
    const double elapsed = box_.age + time;
    const Attitude now = box_.attitudeAfter(elapsed);
    const Vec3 turning = normal_.cross(now.angularVelocity - at_.angularVelocity);
    const Vec3 arm = now.worldFromBody * box_.center;
    const double height = dot(normal_, offset_) + dot(normal_, arm);
    gap_ = height;
    for (int i = 0; i < 3; ++i) {
      gap_ -= box_.halfExtents(i) * std::fabs(dot(normal_, now.worldFromBody.col(i)));
    }
    const Driven& driven = wall_.driven;
    tolerance_ = kGapRounding *
                 (box_.position.norm() + elapsed * speedAt(0.5 * elapsed) + radius_ + driven.pivot.norm() +
                  driven.arm.norm() + driven.amplitude.norm() + (wall_.age + time) * rates_.speed);
    bound_ = ConcaveBound(height, centreRate() + dot(turning, arm),
                          chooseCurvature(box_.accelerationAfter(elapsed)));
    for (int i = 0; i < 3; ++i) {
      const Vec3 edge = now.worldFromBody.col(i);
      bound_.addKink(box_.halfExtents(i), dot(normal_, edge), dot(turning, edge));
    }
    approach_ = -bound_.rateAhead(tolerance_);
    rateTolerance_ = kRateRounding * (speedAt(elapsed) + rates_.speed + rates_.angularSpeed * offset_.norm() +
                                      radius_ * (box_.angularSpeedBound + rates_.angularSpeed));
  }

  double gap() const { return gap_; }
  double tolerance() const { return tolerance_; }
  bool closing() const { return approach_ > rateTolerance_; }
  bool closesHard() const { return fasterThanSinking(approach_, bound_.curvature(), tolerance_); }
  double freeStep(double floor, double most) const {
    return bound_.firstReach(floor, std::min(most, validity_));
  }
  double polish(double level) const { return newtonStep(gap_ - level, approach_, bound_.curvature()); }
  FirstContact describe() const {
    FirstContact contact;
    contact.approach = approach_;
    contact.normal = normal_;
    return contact;
  }

 private:
  double speedAt(double elapsed) const { return box_.velocity.norm() + elapsed * acceleration_; }
  double centreRate() const { return dot(normal_, rate_) + dot(at_.angularVelocity.cross(normal_), offset_); }
  double centreCurvature() const {
    return turningWall_ * mostDistance_ + 2 * rates_.angularSpeed * mostSpeed_ + acceleration_;
  }

  // Of one that swings without a turn, for a little longer than the bound for ever would reach, what it is
  // now and what it becomes meanwhile: where a floor that swings lets go, it is small.
  double chooseCurvature(const Vec3& acceleration) {
    constexpr double kLonger = 16;
    const double ever = centreCurvature() + turningBoth_ * radius_;
    if (rates_.angularSpeed != 0 || !wall_.driven.swings()) {
      return ever;
    }
    const double ahead = kLonger * std::sqrt(2 * std::max(gap_, 8 * tolerance_) / ever);
    const double now = dot(normal_, at_.acceleration - acceleration) + turningBoth_ * radius_;
    const double soon =
        std::max(0.0, now + ahead * (wall_.driven.rate * rates_.acceleration + box_.jerk.norm()));
    if (soon >= ever) {
      return ever;
    }
    validity_ = ahead;
    return soon;
  }

  // Of a wall that turns the bounds hold until the centre can have moved half the length that they have.
  void moveCentre(double time) {
    at_ = wall_.driven.at(wall_.age + time);
    normal_ = at_.pose.worldFromBody * wall_.normal;
    offset_ = box_.positionAt(time) - at_.pose.position;
    rate_ = box_.velocityAt(time) - at_.velocity;
    if (rates_.angularSpeed == 0) {
      validity_ = kNever;
      return;
    }
    const double speed = rate_.norm();
    const double distance = offset_.norm();
    const double reach = 0.5 * (radius_ + distance);
    const double pace = speed + std::sqrt(0.5 * acceleration_ * reach);
    validity_ = pace > 0 ? reach / pace : kNever;
    mostSpeed_ = speed + acceleration_ * validity_;
    mostDistance_ = distance + reach;
  }

  const MovingBox& box_;
  const DrivenWall& wall_;
  const MotionRates rates_;
  const double turningWall_;   // [1/s²]
  const double turningBoth_;   // [1/s²]
  const double radius_;        // [m]
  const double acceleration_;  // [m/s²] bounds the relative acceleration of the origins

  // At the current time:
  Kinematics at_;
  Vec3 normal_ = Vec3::Zero();
  Vec3 offset_ = Vec3::Zero();
  Vec3 rate_ = Vec3::Zero();
  double mostDistance_ = 0;  // [m] of the origins and
  double mostSpeed_ = 0;     // [m/s] their relative speed stay below these
  double validity_ = 0;      // [s] for this long
  ConcaveBound bound_{0, 0, 0};
  double gap_ = 0;
  double tolerance_ = 0;
  double approach_ = 0;
  double rateTolerance_ = 0;
};

}  // namespace

MovingBox seenFrom(const DrivenWall& wall, const MovingBox& box) {
  MovingBox seen = box;
  seen.velocity -= wall.driven.velocity;
  return seen;
}

FirstContact firstContactWithWall(const MovingBox& box, const DrivenWall& wall, const SearchWindow& window) {
  DrivenWallApproach approach(box, wall);
  return findFirstContact(approach, window);
}

}  // namespace careen
