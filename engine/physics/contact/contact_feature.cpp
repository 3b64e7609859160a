#include "physics/contact/contact_feature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "physics/contact/joint_rows.h"

namespace careen {
namespace {

// Touching tolerances: a point this near to an edge counts as on it.
constexpr double kOnEdge = 4;
// [1] Sine of the angle, seen along the normal, below which edges do not cross.
constexpr double kParallelEdges = 0x1p-30;
// [1] A contact normal with this cosine or more to a face normal counts as equal to it.
constexpr double kAlongFace = 1 - 0x1p-40;

ContactState onPlane(const Vec3& arm, const Kinematics& a, const Kinematics* b, const Vec3& normal,
                     double offset) {
  ContactState state;
  const Vec3 velocity = a.velocity + a.angularVelocity.cross(arm);
  state.armA = arm;
  state.centripetal = a.angularVelocity.cross(a.angularVelocity.cross(arm));
  state.slipBias = state.centripetal;
  state.slip = velocity;
  Vec3 normalRate = Vec3::Zero();
  if (b == nullptr) {
    state.gap = dot(normal, a.pose.position) + dot(normal, arm) - offset;
  } else {
    const Vec3& spin = b->angularVelocity;
    state.armB = (a.pose.position - b->pose.position) + arm;
    state.gap = dot(normal, state.armB) - offset;
    const Vec3 relative = velocity - b->velocity;
    state.slip = relative - spin.cross(state.armB);
    state.centripetal -= spin.cross(spin.cross(state.armB));
    state.slipBias -= spin.cross(relative);
    normalRate = spin.cross(normal);
  }
  state.setNormal(normal, normalRate);
  return state;
}

ContactState onEdge(const ContactFeature& feature, const Kinematics& a, const Vec3& halfExtentsA,
                    const Kinematics& b, const Vec3& halfExtentsB) {
  ContactState state;
  const Vec3 edgeA = a.pose.worldFromBody.col(feature.axisA);
  const Vec3 edgeB = b.pose.worldFromBody.col(feature.axisB);
  const Vec3 middleA = a.pose.worldFromBody * feature.onA;
  const Vec3 middleB = b.pose.worldFromBody * feature.onB;
  const Vec3 link = (a.pose.position - b.pose.position) + (middleA - middleB);
  const Vec3 cross = feature.sign * edgeA.cross(edgeB);
  const double sine = cross.norm();
  const Vec3 n = cross / sine;
  const double alongA = -feature.sign * dot(link, edgeB.cross(n)) / sine;
  const double alongB = -feature.sign * dot(link, edgeA.cross(n)) / sine;
  // One point for both, halfway: else it would be at another depth than those of the faces' corners.
  state.gap = dot(n, link);
  state.armA = middleA + alongA * edgeA - 0.5 * state.gap * n;
  state.armB = middleB + alongB * edgeB + 0.5 * state.gap * n;
  state.beyond = std::max(std::fabs(alongA) - halfExtentsA[feature.axisA],
                          std::fabs(alongB) - halfExtentsB[feature.axisB]);

  const Vec3& spinA = a.angularVelocity;
  const Vec3& spinB = b.angularVelocity;
  const Vec3 velocityA = a.velocity + spinA.cross(state.armA);
  state.slip = velocityA - (b.velocity + spinB.cross(state.armB));
  state.centripetal = spinA.cross(spinA.cross(state.armA)) - spinB.cross(spinB.cross(state.armB));
  const Vec3 turning = feature.sign * (spinA.cross(edgeA).cross(edgeB) + edgeA.cross(spinB.cross(edgeB)));
  state.setNormal(n, (turning - dot(n, turning) * n) / sine);
  // The crossing itself moves along both edges.
  const double wander = -feature.sign * dot(n, state.slip.cross(edgeB)) / sine;
  const Vec3 crossing = velocityA + wander * edgeA;
  state.slipBias = spinA.cross(crossing - a.velocity) - spinB.cross(crossing - b.velocity);
  return state;
}

// [1] The least component of a direction along the outward normals of the faces through a point.
double marginAt(const Vec3& direction, const Mat3& worldFromBody, const Vec3& point, TouchingShape box) {
  double least = 1;
  for (int i = 0; i < 3; ++i) {
    const double place = point[i] - box.center[i];
    // The sum of middle and half extent is rounded.
    const double rounding =
        box.center[i] == 0 ? 0 : 0x1p-50 * (box.halfExtents[i] + std::fabs(box.center[i]));
    if (std::fabs(std::fabs(place) - box.halfExtents[i]) <= rounding) {
      least = std::min(least, (place < 0 ? -1 : 1) * dot(direction, worldFromBody.col(i)));
    }
  }
  return least;
}

// A direction and its rate.
struct Turning {
  Vec3 direction = Vec3::Zero();
  Vec3 rate = Vec3::Zero();
};

// Mean of the normals kept by both bodies, perpendicular to an edge (or to a zero vector), of length 1.
Turning meanNormal(const Turning& a, const Turning& b, const Turning& edge) {
  const Vec3 mean = a.direction + b.direction;
  const Vec3 meanRate = a.rate + b.rate;
  const double along = dot(mean, edge.direction);
  const double alongRate = dot(meanRate, edge.direction) + dot(mean, edge.rate);
  const Vec3 across = mean - along * edge.direction;
  const Vec3 acrossRate = meanRate - alongRate * edge.direction - along * edge.rate;
  const double size = across.norm();
  const Vec3 normal = across / size;
  return {.direction = normal, .rate = (acrossRate - dot(normal, acrossRate) * normal) / size};
}

ContactState inCone(const ContactFeature& feature, const Kinematics& a, TouchingShape boxA,
                    const Kinematics& b, TouchingShape boxB) {
  const auto turning = [](const Kinematics& body, const Vec3& inBody) {
    const Vec3 direction = body.pose.worldFromBody * inBody;
    return Turning{.direction = direction, .rate = body.angularVelocity.cross(direction)};
  };
  const bool movesOnA = feature.axisA != ContactFeature::kNoEdge;
  const bool movesOnB = feature.axisB != ContactFeature::kNoEdge;
  Turning edge;
  if (movesOnA || movesOnB) {
    edge = movesOnA ? turning(a, Vec3::Unit(feature.axisA)) : turning(b, Vec3::Unit(feature.axisB));
  }
  const Turning normal = meanNormal(turning(a, feature.normalA), turning(b, feature.normalB), edge);
  const Vec3& n = normal.direction;
  ContactState state;
  state.armA = a.pose.worldFromBody * feature.onA;
  state.armB = b.pose.worldFromBody * feature.onB;
  const Vec3 link = (a.pose.position - b.pose.position) + (state.armA - state.armB);
  const double along = dot(link, edge.direction);
  state.gap = dot(n, link);
  state.offset = link - state.gap * n - along * edge.direction;
  const double reach = std::min(boxA.halfExtents.norm(), boxB.halfExtents.norm());
  const double margin = std::min(marginAt(-n, a.pose.worldFromBody, feature.onA, boxA),
                                 marginAt(n, b.pose.worldFromBody, feature.onB, boxB));
  state.beyond = std::max(state.offset.norm(), -margin * reach);
  if (movesOnA) {
    state.armA -= along * edge.direction;
    state.beyond = std::max(state.beyond, std::fabs(along) - boxA.halfExtents[feature.axisA]);
  } else if (movesOnB) {
    state.armB += along * edge.direction;
    state.beyond = std::max(state.beyond, std::fabs(along) - boxB.halfExtents[feature.axisB]);
  }

  const Vec3& spinA = a.angularVelocity;
  const Vec3& spinB = b.angularVelocity;
  const Vec3 velocityA = a.velocity + spinA.cross(state.armA);
  const Vec3 velocityB = b.velocity + spinB.cross(state.armB);
  state.slip = velocityA - velocityB;
  state.centripetal = spinA.cross(spinA.cross(state.armA)) - spinB.cross(spinB.cross(state.armB));
  state.setNormal(n, normal.rate);
  // The contact moves with the body whose point it is.
  const Vec3 mean = 0.5 * (velocityA + velocityB);
  const Vec3& contact = movesOnA ? velocityB : movesOnB ? velocityA : mean;
  state.slipBias = spinA.cross(contact - a.velocity) - spinB.cross(contact - b.velocity);
  return state;
}

// The axes along which the point lies on the box's surface.
struct Sides {
  std::array<bool, 3> at{};
  int count = 0;
};
Sides sidesAt(const Vec3& point, const Vec3& halfExtents, double within) {
  Sides sides;
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(point[i]) >= halfExtents[i] - within) {
      sides.at[static_cast<std::size_t>(i)] = true;
      ++sides.count;
    }
  }
  return sides;
}

// The face of a box with its normal along a direction, else -1.
int faceAlong(const Mat3& worldFromBody, const Vec3& direction) {
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(dot(worldFromBody.col(i), direction)) >= kAlongFace) {
      return i;
    }
  }
  return -1;
}

Vec3 atSides(const Vec3& point, const Vec3& halfExtents, int except) {
  Vec3 moved = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (i != except) {
      moved[i] = point[i] < 0 ? -halfExtents[i] : halfExtents[i];
    }
  }
  return moved;
}

// Of the box's edges through the point, the one nearest to perpendicular to `other`, seen along the normal.
int edgeThrough(const Sides& sides, const Mat3& worldFromBody, const Vec3& normal, const Vec3& other) {
  int best = -1;
  double most = -1;
  for (int i = 0; i < 3; ++i) {
    const int atOthers = sides.count - (sides.at[static_cast<std::size_t>(i)] ? 1 : 0);
    const double across = std::fabs(dot(worldFromBody.col(i).cross(other), normal));
    if (atOthers == 2 && across > most) {
      best = i;
      most = across;
    }
  }
  return best;
}

// The edge through a point on two sides, along which the contact can move.
int freeEdge(const Sides& sides) {
  for (int i = 0; i < 3; ++i) {
    if (sides.count == 2 && !sides.at[static_cast<std::size_t>(i)]) {
      return i;
    }
  }
  return ContactFeature::kNoEdge;
}

// Of two edges the ends of the common part touch, each a corner of one of them; if of neither, b's moves.
ContactFeature pointInCone(int a, const BoxAt& boxA, const Vec3& placeA, const Sides& sidesA, int b,
                           const BoxAt& boxB, const Vec3& placeB, const Sides& sidesB, const Vec3& normal) {
  ContactFeature feature{.kind = ContactFeature::Kind::kInCone,
                         .a = a,
                         .b = b,
                         .axisA = freeEdge(sidesA),
                         .axisB = freeEdge(sidesB),
                         .normalA = boxA.pose.worldFromBody.transpose() * normal,
                         .normalB = boxB.pose.worldFromBody.transpose() * normal};
  feature.onA = atSides(placeA, boxA.halfExtents, feature.axisA);
  feature.onB = atSides(placeB, boxB.halfExtents, feature.axisB);
  if (feature.axisA != ContactFeature::kNoEdge && feature.axisB != ContactFeature::kNoEdge) {
    feature.onA[feature.axisA] = placeA[feature.axisA];
    feature.axisA = ContactFeature::kNoEdge;
  }
  return feature;
}

ContactFeature pointOnFace(int a, const Vec3& point, int b, const Mat3& worldFromB, int face,
                           const Vec3& normal) {
  return {.kind = ContactFeature::Kind::kPointOnFace,
          .a = a,
          .b = b,
          .onA = point,
          .axisB = face,
          .sign = dot(worldFromB.col(face), normal) < 0 ? -1.0 : 1.0};
}

// Places of the feature are from the boxes' middles.
ContactFeature featureInOrder(const ContactPoint& point, double apart, int a, const BoxAt& boxA, int b,
                              const BoxAt& boxB) {
  const Pose& poseA = boxA.pose;
  const Pose& poseB = boxB.pose;
  const Vec3& halfExtentsA = boxA.halfExtents;
  const Vec3& halfExtentsB = boxB.halfExtents;
  const Vec3 placeA = poseA.worldFromBody.transpose() * point.armA - boxA.center;
  const Vec3 placeB = poseB.worldFromBody.transpose() * point.armB - boxB.center;
  const double within = kOnEdge * touchingWithin(boxA, boxB) + std::fabs(apart);
  const Sides sidesA = sidesAt(placeA, halfExtentsA, within);
  const Sides sidesB = sidesAt(placeB, halfExtentsB, within);
  if (point.inCone) {
    return pointInCone(a, boxA, placeA, sidesA, b, boxB, placeB, sidesB, point.normal);
  }
  const int faceA = faceAlong(poseA.worldFromBody, point.normal);
  const int faceB = faceAlong(poseB.worldFromBody, point.normal);
  if (sidesA.count == 3 && faceB >= 0) {
    return pointOnFace(a, atSides(placeA, halfExtentsA, -1), b, poseB.worldFromBody, faceB, point.normal);
  }
  if (sidesB.count == 3 && faceA >= 0) {
    return pointOnFace(b, atSides(placeB, halfExtentsB, -1), a, poseA.worldFromBody, faceA, -point.normal);
  }
  // The pair of edges nearest to perpendicular, out of all pairs.
  int edgeA = -1;
  int edgeB = -1;
  double most = kParallelEdges;
  for (int j = 0; j < 3; ++j) {
    if (sidesB.count - (sidesB.at[static_cast<std::size_t>(j)] ? 1 : 0) != 2) {
      continue;
    }
    const Vec3 other = poseB.worldFromBody.col(j);
    const int i = edgeThrough(sidesA, poseA.worldFromBody, point.normal, other);
    const double across = i < 0 ? 0 : std::fabs(dot(poseA.worldFromBody.col(i).cross(other), point.normal));
    if (across > most) {
      most = across;
      edgeA = i;
      edgeB = j;
    }
  }
  if (edgeA >= 0) {
    const Vec3 cross = poseA.worldFromBody.col(edgeA).cross(poseB.worldFromBody.col(edgeB));
    return {.kind = ContactFeature::Kind::kEdgeOnEdge,
            .a = a,
            .b = b,
            .onA = atSides(placeA, halfExtentsA, edgeA),
            .onB = atSides(placeB, halfExtentsB, edgeB),
            .axisA = edgeA,
            .axisB = edgeB,
            .sign = dot(cross, point.normal) < 0 ? -1.0 : 1.0};
  }
  // A point inside a face, such as a face's centre projected onto another: it stays fixed to its body.
  if (faceB >= 0 || faceA < 0) {
    int face = faceB;
    if (face < 0) {
      Eigen::Index best = 0;
      (poseB.worldFromBody.transpose() * point.normal).cwiseAbs().maxCoeff(&best);
      face = static_cast<int>(best);
    }
    return pointOnFace(a, placeA, b, poseB.worldFromBody, face, point.normal);
  }
  return pointOnFace(b, placeB, a, poseA.worldFromBody, faceA, -point.normal);
}

// All but its directions.
ContactState stateOfNormal(const ContactFeature& feature, const Kinematics& a, TouchingShape boxA,
                           const Kinematics& b, TouchingShape boxB) {
  if (feature.kind == ContactFeature::Kind::kEdgeOnEdge) {
    return onEdge(feature, a, boxA.halfExtents, b, boxB.halfExtents);
  }
  if (feature.kind == ContactFeature::Kind::kInCone) {
    return inCone(feature, a, boxA, b, boxB);
  }
  const Vec3 arm = a.pose.worldFromBody * feature.onA;
  if (feature.kind == ContactFeature::Kind::kPointOnWall) {
    const WallPlane plane = planeOf(*boxB.halfSpace, b.pose);
    ContactState state =
        b.isDriven ? onPlane(arm, a, &b, plane.normal, 0) : onPlane(arm, a, nullptr, plane.normal, plane.offset);
    state.beyond = -std::numeric_limits<double>::infinity();
    return state;
  }
  const int face = feature.axisB;
  const Vec3 normal = feature.sign * b.pose.worldFromBody.col(face);
  ContactState state = onPlane(arm, a, &b, normal, boxB.halfExtents[face] + feature.sign * boxB.center[face]);
  const Vec3 place = b.pose.worldFromBody.transpose() * state.armB;
  state.beyond = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (i != face) {
      state.beyond = std::max(state.beyond, std::fabs(place[i] - boxB.center[i]) - boxB.halfExtents[i]);
    }
  }
  return state;
}

}  // namespace

bool isSame(const ContactFeature& x, const ContactFeature& y) {
  return x.kind == y.kind && x.joint == y.joint && x.part == y.part && x.a == y.a && x.b == y.b &&
         x.boxA == y.boxA && x.boxB == y.boxB && x.axisA == y.axisA && x.axisB == y.axisB &&
         x.sign == y.sign && (x.onA - y.onA).isZero(1e-9 * x.onA.norm()) &&
         (x.onB - y.onB).isZero(1e-9 * x.onB.norm());
}

bool hasCorner(std::span<const ContactFeature> features, const ContactFeature& corner) {
  return std::any_of(features.begin(), features.end(), [&](const ContactFeature& feature) {
    return feature.a == corner.a && feature.b == corner.b && feature.onA == corner.onA;
  });
}

namespace {

// Of a surface that moves along itself. The contact is where a's point is, whichever of the two is held.
void addSurface(const SurfaceMotion& surface, const Kinematics& a, ContactState& state) {
  const Vec3 point = a.pose.position + state.armA;
  const Vec3 velocity = a.velocity + a.angularVelocity.cross(state.armA);
  const Vec3 all = surface.velocity + surface.spin.cross(point);
  state.surface = surface.along(state.normal, point);
  state.slip -= state.surface;
  state.slipBias -= surface.spin.cross(velocity) - dot(state.normal, all) * state.normalRate;
}

void addDriven(const Kinematics& a, const Kinematics& b, ContactState& state) {
  const auto add = [&](const Kinematics& body, const Vec3& arm, double sign) {
    if (body.isDriven) {
      state.given -= sign * body.velocityAt(arm);
      const Vec3 acceleration = sign * body.accelerationAt(arm);
      state.centripetal += acceleration;
      state.gapBias += dot(state.normal, acceleration);
      state.slipBias += acceleration;
    }
  };
  add(a, state.armA, 1);
  add(b, state.armB, -1);
}

}  // namespace

TouchingShape shapeOf(const Body& body, int index) {
  if (body.parts.empty() || index == ContactFeature::kWhole) {
    return {.halfExtents = body.halfExtents, .center = body.boxCenter};
  }
  const BodyPart& part = body.part(index);
  return {.halfExtents = part.halfExtents,
          .center = part.center,
          .bodyFromBox = part.turned ? &part.bodyFromPart : nullptr};
}

ContactState contactState(const ContactFeature& feature, const Kinematics& a, TouchingShape boxA,
                          const Kinematics& b, TouchingShape boxB) {
  if (feature.isOfJoint()) {
    return jointState(feature, a, boxA, b, boxB);
  }
  if (boxA.bodyFromBox != nullptr || boxB.bodyFromBox != nullptr) {
    const auto inBox = [](const Kinematics& body, TouchingShape& box) {
      Kinematics own = body;
      if (box.bodyFromBox != nullptr) {
        own.pose.worldFromBody = body.pose.worldFromBody * *box.bodyFromBox;
      }
      box.bodyFromBox = nullptr;
      return own;
    };
    const Kinematics ofA = inBox(a, boxA);
    const Kinematics ofB = inBox(b, boxB);
    return contactState(feature, ofA, boxA, ofB, boxB);
  }
  ContactState state = stateOfNormal(feature, a, boxA, b, boxB);
  if (feature.axes != 0) {
    state.directions = directionsOf(feature.axes, {a.pose, boxA.halfExtents, boxA.center},
                                    {b.pose, boxB.halfExtents, boxB.center});
  }
  if (feature.material.surface.moves()) {
    addSurface(feature.material.surface, a, state);
  }
  if (a.isDriven || b.isDriven) {
    addDriven(a, b, state);
  }
  return state;
}

void ContactState::setNormal(const Vec3& to, const Vec3& rateOfNormal) {
  const Vec3 relative = velocity();
  normal = to;
  normalRate = rateOfNormal;
  rate = dot(normal, relative);
  slip = relative - rate * normal;
  gapBias = dot(normal, centripetal) + 2 * dot(normalRate, slip);
}

double ContactState::passing() const {
  double fastest = 0;
  for (const Vec3& direction : directions) {
    fastest = std::max(fastest, std::fabs(dot(direction, velocity())));
  }
  return fastest;
}

ContactFeature featureAt(const ContactPoint& point, double apart, int a, const BoxAt& boxA, int b,
                         const BoxAt& boxB) {
  ContactFeature feature = comesFirst(boxB, boxA) ? featureInOrder(swapped(point), apart, b, boxB, a, boxA)
                                                  : featureInOrder(point, apart, a, boxA, b, boxB);
  if (!boxA.isCentered() || !boxB.isCentered()) {
    feature.onA += (feature.a == a ? boxA : boxB).center;
    if (feature.kind != ContactFeature::Kind::kPointOnFace) {
      feature.onB += (feature.a == a ? boxB : boxA).center;
    }
  }
  feature.boxA = (feature.a == a ? boxA : boxB).part;
  feature.boxB = (feature.a == a ? boxB : boxA).part;
  return feature;
}

}  // namespace careen
