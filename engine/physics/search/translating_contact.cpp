#include "physics/search/translating_contact.h"

#include <cmath>
#include <optional>

#include "physics/geometry/separation.h"

namespace careen {
namespace {

// First t > 0 at which d + v t + ½ a t² falls to zero, for d > 0, or d = 0 and v > 0. No cancellation: the
// root is taken in whichever form adds.
std::optional<double> firstFall(double d, double v, double a) {
  if (d == 0) {
    return a < 0 ? std::optional(2 * v / -a) : std::nullopt;
  }
  const double discriminant = v * v - 2 * a * d;
  if (discriminant < 0 || (v >= 0 && a >= 0)) {
    return std::nullopt;
  }
  const double root = std::sqrt(discriminant);
  return v < 0 ? 2 * d / (root - v) : (v + root) / -a;
}

}  // namespace

FirstContact firstContactTranslating(const MovingBox& box, const Vec3& normal, double offset, double until) {
  const Pose pose = box.poseAt(0);
  const double gap = gapToPlane({pose, box.halfExtents, box.center}, normal, offset);
  const double rounding =
      kGapRounding * (std::abs(dot(normal, pose.position)) + std::abs(offset) + box.radius());
  const double v = dot(normal, box.velocityAt(0));
  const double a = dot(normal, box.acceleration);
  const double d = gap > rounding ? gap : 0;
  FirstContact contact;
  contact.time = until;
  contact.normal = normal;
  contact.evaluations = 1;
  if (d == 0 && v <= 0) {
    if (v < 0 || a < 0) {
      contact.kind = v < 0 ? ContactKind::kImpact : ContactKind::kTouching;
      contact.time = 0;
      contact.approach = -v;
    }
  } else if (const std::optional<double> time = firstFall(d, v, a); time && *time <= until) {
    contact.kind = ContactKind::kImpact;
    contact.time = *time;
    contact.approach = -(v + a * *time);
  }
  return contact;
}

}  // namespace careen
