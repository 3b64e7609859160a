#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "physics/geometry/contact_points.h"

namespace careen {

/// Collects the contact points of a pair of boxes that share a normal. Points on either box are relative to
/// its middle [m]; `bToA` is the way from b's middle to a's, `within` [m] the distance of points that are
/// one.
class ContactManifold {
 public:
  ContactManifold(Vec3 normal, Vec3 bToA, double within)
      : normal_(std::move(normal)), bToA_(std::move(bToA)), within_(within) {}
  /// The normal is the middle of a cone of normals.
  void liesInCone() { inCone_ = true; }

  void addOnA(const Vec3& armA) { add(armA, armA + bToA_); }
  void addOnB(const Vec3& armB) { add(armB - bToA_, armB); }
  void add(const Vec3& armA, const Vec3& armB) {
    add({.armA = armA, .armB = armB, .normal = normal_, .inCone = inCone_});
  }
  // Of points closer together than the tolerance, the one furthest from both centres: none for being listed
  // first, which mirrors would change.
  ContactPoints points() const {
    ContactPoints points;
    for (std::size_t k = 0; k < count_; ++k) {
      if (std::none_of(points.begin(), points.end(), [&](const ContactPoint& other) {
            return (other.armA - all_[k].armA).squaredNorm() <= within_ * within_;
          })) {
        points.add(all_[k]);
      }
    }
    return points;
  }

 private:
  static double squaredArms(const ContactPoint& point) {
    return point.armA.squaredNorm() + point.armB.squaredNorm();
  }
  void add(const ContactPoint& point) {
    std::size_t k = count_++;
    for (; k > 0 && squaredArms(all_[k - 1]) < squaredArms(point); --k) {
      all_[k] = all_[k - 1];
    }
    all_[k] = point;
  }

  Vec3 normal_;
  Vec3 bToA_;
  double within_;
  bool inCone_ = false;
  std::array<ContactPoint, ContactPoints::kMost> all_;  // furthest first
  std::size_t count_ = 0;
};

}  // namespace careen
