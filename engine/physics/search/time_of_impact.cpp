#include "physics/search/time_of_impact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/search/concave_bound.h"
#include "physics/search/first_contact_search.h"

namespace careen {
namespace {

class WallApproach {
 public:
  WallApproach(const MovingBox& box, const Vec3& normal, double offset)
      : box_(box),
        normal_(normal),
        height_(dot(normal, box.position) - offset),
        rate_(dot(normal, box.velocity)),
        acceleration_(dot(normal, box.acceleration)),
        jerk_(dot(normal, box.jerk)),
        lowest_(std::min(acceleration_, dot(normal, box.accelerationAfter(box.lasts)))),
        radius_(box.radius()),
        offCenter_(!box.center.isZero(0)),
        curvature_(std::max(0.0, radius_ * turningBound(box) - lowest_)) {
    const Vec3 weights = normal.cwiseAbs();
    sizes_ = {dot(weights, box.position.cwiseAbs()) + std::fabs(offset) + radius_,
              dot(weights, box.velocity.cwiseAbs()), dot(weights, mostOf(box))};
  }

  double skip(double time) const {
    const double elapsed = box_.age + time;
    const double clear = heightAt(elapsed) - radius_ * kSphere;
    return clear > 0 ? time + firstRoot(clear, rateAt(elapsed), -lowest_, kNever) : time;
  }

  void moveTo(double time) {
    const double elapsed = box_.age + time;
    const Attitude now = box_.attitudeAfter(elapsed);
    const Vec3 turning = normal_.cross(now.angularVelocity);
    double height = heightAt(elapsed);
    double rate = rateAt(elapsed);
    if (offCenter_) {
      const Vec3 arm = now.worldFromBody * box_.center;
      height += dot(normal_, arm);
      rate += dot(turning, arm);
    }
    bound_ = ConcaveBound(height, rate, curvature_);
    for (int i = 0; i < 3; ++i) {
      up_(i) = dot(normal_, now.worldFromBody.col(i));
      bound_.addKink(box_.halfExtents(i), up_(i), dot(turning, now.worldFromBody.col(i)));
    }
    gap_ = bound_.value();
    tolerance_ = kGapRounding * (sizes_[0] + elapsed * (sizes_[1] + 0.5 * elapsed * sizes_[2]));
    approach_ = -bound_.rateAhead(tolerance_);
    rateTolerance_ = kRateRounding * (sizes_[1] + elapsed * sizes_[2] + radius_ * box_.angularSpeedBound);
  }

  double gap() const { return gap_; }
  double tolerance() const { return tolerance_; }
  bool closing() const { return approach_ > rateTolerance_; }
  bool closesHard() const { return fasterThanSinking(approach_, curvature_, tolerance_); }
  double freeStep(double floor, double most) const { return bound_.firstReach(floor, most); }
  double polish(double level) const { return newtonStep(gap_ - level, approach_, curvature_); }

  FirstContact describe() const {
    FirstContact contact;
    contact.approach = approach_;
    contact.normal = normal_;
    const double within = std::max(kSimultaneous * radius_, tolerance_);
    for (unsigned corner = 0; corner < 8; ++corner) {
      double above = 0;
      for (int i = 0; i < 3; ++i) {
        const bool minus = (corner & (4U >> static_cast<unsigned>(i))) != 0;
        if (minus != (up_(i) > 0)) {
          above += 2 * box_.halfExtents(i) * std::fabs(up_(i));
        }
      }
      contact.corners |= above <= within ? 1U << corner : 0U;
    }
    return contact;
  }

 private:
  double heightAt(double elapsed) const {
    return height_ + elapsed * (rate_ + 0.5 * elapsed * acceleration_ + (elapsed * elapsed / 6) * jerk_);
  }
  double rateAt(double elapsed) const {
    return rate_ + elapsed * acceleration_ + (0.5 * elapsed * elapsed) * jerk_;
  }

  const MovingBox& box_;
  const Vec3 normal_;
  const double height_;
  const double rate_;
  const double acceleration_;
  const double jerk_;
  const double lowest_;  // of the acceleration
  const double radius_;
  const bool offCenter_;
  const double curvature_;
  std::array<double, 3> sizes_{};  // magnitudes of lengths, speeds and accelerations, for rounding bounds
  Vec3 up_ = Vec3::Zero();
  ConcaveBound bound_{0, 0, 0};
  double gap_ = 0;
  double tolerance_ = 0;
  double approach_ = 0;
  double rateTolerance_ = 0;
};

}  // namespace

double sphereClearUntil(const MovingBox& box, const Vec3& normal, double offset) {
  return WallApproach(box, normal, offset).skip(0);
}

FirstContact firstContactWithWall(const MovingBox& box, const Vec3& normal, double offset,
                                  const SearchWindow& window) {
  WallApproach approach(box, normal, offset);
  return findFirstContact(approach, window);
}

}  // namespace careen
