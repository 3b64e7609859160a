#include "physics/pile/clip.h"

#include <cmath>

#include "physics/pile/index.h"

namespace careen {
namespace {

// A vertex, and the line that leads from it to the next.
struct Corner {
  Vec3 point;
  std::uint32_t line = 0;
};
using Polygon = std::array<Corner, 12>;

int clip(const Polygon& in, int count, Polygon& out, int axis, double sign, double limit,
         std::uint32_t line) {
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    const Corner& here = in[at(k)];
    const Corner& next = in[at(k + 1 < count ? k + 1 : 0)];
    const double depthHere = limit - sign * here.point[axis];
    const double depthNext = limit - sign * next.point[axis];
    if (depthHere >= 0) {
      out[at(kept++)] = here;
    }
    if ((depthHere >= 0) != (depthNext >= 0)) {
      const double part = depthHere / (depthHere - depthNext);
      Corner& crossing = out[at(kept++)];
      crossing.point = here.point + part * (next.point - here.point);
      crossing.line = depthHere >= 0 ? line : here.line;
    }
  }
  return kept;
}

}  // namespace

ClippedFace clipFace(const PileBox& owner, const PileBox& incident, const Mat3& ownerFromIncident,
                     const Vec3& incidentCenter, int axis, double sign, double slack) {
  int face = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(ownerFromIncident(axis, i)) > std::fabs(ownerFromIncident(axis, face))) {
      face = i;
    }
  }
  const double faceSign = sign * ownerFromIncident(axis, face) > 0 ? -1 : 1;
  const int face1 = (face + 1) % 3;
  const int face2 = (face + 2) % 3;
  const Vec3 middle = incidentCenter + faceSign * incident.halfExtents[face] * ownerFromIncident.col(face);
  const Vec3 side1 = incident.halfExtents[face1] * ownerFromIncident.col(face1);
  const Vec3 side2 = incident.halfExtents[face2] * ownerFromIncident.col(face2);
  Polygon first;
  Polygon second;
  first[0] = {.point = middle + side1 + side2, .line = 0};
  first[1] = {.point = middle - side1 + side2, .line = 1};
  first[2] = {.point = middle - side1 - side2, .line = 2};
  first[3] = {.point = middle + side1 - side2, .line = 3};
  const int axis1 = (axis + 1) % 3;
  const int axis2 = (axis + 2) % 3;
  const double limit1 = owner.halfExtents[axis1] + slack;
  const double limit2 = owner.halfExtents[axis2] + slack;
  int count = clip(first, 4, second, axis1, 1, limit1, 4);
  count = clip(second, count, first, axis1, -1, limit1, 5);
  count = clip(first, count, second, axis2, 1, limit2, 6);
  count = clip(second, count, first, axis2, -1, limit2, 7);

  ClippedFace result;
  result.faces = static_cast<std::uint32_t>(axis * 2 + (sign > 0 ? 1 : 0)) * 8 +
                 static_cast<std::uint32_t>(face * 2 + (faceSign > 0 ? 1 : 0));
  for (int k = 0; k < count && result.count < 8; ++k) {
    const Corner& corner = first[at(k)];
    const Corner& before = first[at(k > 0 ? k - 1 : count - 1)];
    result.points[at(result.count++)] = {.point = corner.point,
                                         .gap = sign * corner.point[axis] - owner.halfExtents[axis],
                                         .feature = before.line * 8 + corner.line};
  }
  return result;
}

}  // namespace careen
