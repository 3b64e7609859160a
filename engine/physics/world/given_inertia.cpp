#include "physics/world/given_inertia.h"

#include <cmath>
#include <cstddef>

#include "core/brief.h"
#include "core/error.h"
#include "physics/world/principal_axes.h"

namespace careen {
namespace {

/// [1] of the trace: parts of a tensor this small are rounding.
constexpr double kNone = 0x1p-50;
constexpr double kSymmetric = 1e-9;

bool isDiagonal(const Mat3& inertia) {
  const double most = kNone * inertia.trace();
  return std::fabs(inertia(0, 1)) <= most && std::fabs(inertia(0, 2)) <= most &&
         std::fabs(inertia(1, 2)) <= most;
}

PrincipalAxes axesOf(const Mat3& inertia) {
  if (isDiagonal(inertia)) {
    return {.moments = inertia.diagonal(), .axes = Mat3::Identity()};
  }
  return principalAxes(inertia);
}

}  // namespace

std::string whyNoInertia(const Vec3& moments) {
  constexpr double kRounding = 1e-12;  // of the moments
  for (const double moment : moments) {
    if (!(std::isfinite(moment) && moment > 0)) {
      return "moments of inertia that are positive";
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double others = moments.sum() - moments[axis];
    if (moments[axis] > others * (1 + kRounding)) {
      return "no moment of inertia above the sum of the two others, " + brief(others) + " kg m²";
    }
  }
  return "";
}

std::string whyNoTensor(const Mat3& inertia) {
  if (!inertia.allFinite() || !(inertia.trace() > 0)) {
    return "moments of inertia that are positive";
  }
  if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= kSymmetric * inertia.trace())) {
    return "a symmetric tensor";
  }
  return whyNoInertia(axesOf(inertia).moments);
}

MassProperties massWithTensor(double mass, const Mat3& inertia) {
  if (const std::string why = whyNoTensor(inertia); !why.empty()) {
    throw InputError("a body needs " + why);
  }
  const PrincipalAxes found = axesOf(inertia);
  MassProperties result = massWithInertia(mass, found.moments);
  result.turned = !isDiagonal(inertia);
  result.bodyFromPrincipal = found.axes;
  return result;
}

MassProperties massWithInertia(double mass, const Vec3& moments) {
  const std::string why = whyNoInertia(moments);
  if (!(std::isfinite(mass) && mass > 0) || !why.empty()) {
    throw InputError("a body needs a positive, finite mass and " +
                     (why.empty() ? "moments of inertia" : why));
  }
  return {.mass = mass,
          .inverseMass = 1 / mass,
          .inertiaBody = moments,
          .inverseInertiaBody = moments.cwiseInverse()};
}

}  // namespace careen
