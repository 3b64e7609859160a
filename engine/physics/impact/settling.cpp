#include "physics/impact/settling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double largestArm(std::span<const Vec3> arms) {
  double squared = 0;
  for (const Vec3& arm : arms) {
    squared = std::max(squared, arm.squaredNorm());
  }
  return std::sqrt(squared);
}

/// Whether the line through the centre of mass along `down` passes through the convex hull of the points,
/// seen along the normal (support polygon). It does not iff it is strictly outside some edge between two
/// points that has all points on its other side; a hull without area gives no stable support.
bool carries(std::span<const Vec3> arms, const Vec3& normal, const Vec3& down, double length) {
  const double slack = kSettlingRounding * length * length;
  bool hasArea = false;
  // The foot of the line: arm·normal is the same for all points, and −normal·down > 0 here.
  const Vec3 foot = down * (dot(arms[0], normal) / dot(down, normal));
  for (const Vec3& from : arms) {
    for (const Vec3& to : arms) {
      const Vec3 edge = to - from;
      const Vec3 inward = normal.cross(edge);
      bool isEdge = edge.squaredNorm() > slack;
      double widest = 0;
      for (const Vec3& other : arms) {
        const double side = dot(inward, other - from);
        isEdge = isEdge && side >= -slack;
        widest = std::max(widest, side);
      }
      hasArea = hasArea || (isEdge && widest > slack);
      if (isEdge && dot(inward, foot - from) < -slack) {
        return false;
      }
    }
  }
  return hasArea;
}

}  // namespace

double nextHop(const Bouncing& bouncing) {
  return bouncing.acceleration < 0 ? 2 * bouncing.departure / -bouncing.acceleration : kNever;
}

double settlingTail(const Bouncing& bouncing) {
  return bouncing.acceleration < 0 && bouncing.restitution < 1
             ? 2 * bouncing.departure / (-bouncing.acceleration * (1 - bouncing.restitution))
             : kNever;
}

double nextHeight(const Bouncing& bouncing) {
  return bouncing.acceleration < 0 ? bouncing.departure * bouncing.departure / (-2 * bouncing.acceleration)
                                   : kNever;
}

double settlingHop(const Bouncing& bouncing, double smallestHalfExtent) {
  return bouncing.acceleration < 0
             ? kSettlingFraction * std::sqrt(2 * smallestHalfExtent / -bouncing.acceleration)
             : 0;
}

bool settles(const Bouncing& bouncing, double smallestHalfExtent) {
  if (!(bouncing.acceleration < 0 && bouncing.restitution < 1)) {
    return false;
  }
  const double lost = 1 - bouncing.restitution * bouncing.restitution;
  return nextHop(bouncing) < settlingHop(bouncing, smallestHalfExtent) ||
         nextHeight(bouncing) * lost < kRoundingsOfAHop * bouncing.gapRounding;
}

Settled afterTail(const Settling& settling) {
  const double length = largestArm(settling.arms);
  const double allowed = kSettlingRounding * settling.speed;
  if (settling.arms.empty() || settling.angularVelocity.norm() * length > allowed) {
    return Settled::kRocks;
  }
  if (settling.velocity.norm() > allowed) {
    return Settled::kSlides;
  }
  const double size = settling.gravity.norm();
  const double into = -dot(settling.gravity, settling.normal);
  if (!(into > 0)) {
    return Settled::kRocks;
  }
  if (!carries(settling.arms, settling.normal, settling.gravity / size, length)) {
    return Settled::kRocks;
  }
  const double tangential = (settling.gravity + into * settling.normal).norm();
  return tangential <= settling.friction * into + kSettlingRounding * size ? Settled::kRests
                                                                           : Settled::kSlipsDown;
}

}  // namespace careen
