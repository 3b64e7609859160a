#include "physics/pile/solver_body.h"

namespace careen {

SolverBody solverBody(const PileBody& body, double change) {
  if (body.still()) {
    return {};
  }
  const Mat3 axes = body.principalAxes();
  const Mat3 scaled = axes * body.inverseInertiaBody.asDiagonal();
  const auto entry = [&](int i, int j) { return dot(scaled.row(i), axes.row(j)); };
  return {.inverseMass = body.inverseMass,
          .xx = entry(0, 0),
          .yy = entry(1, 1),
          .zz = entry(2, 2),
          .xy = entry(0, 1),
          .xz = entry(0, 2),
          .yz = entry(1, 2),
          .radius = body.radius,
          .change = change,
          .place = body.position};
}

}  // namespace careen
