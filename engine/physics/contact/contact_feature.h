#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/geometry/contact_frame.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/separating_axes.h"
#include "physics/solver/contact_rows.h"
#include "physics/world/body.h"
#include "physics/world/kinematics.h"
#include "physics/world/world.h"

namespace careen {

/// Which of a joint's conditions a feature is.
enum class JointPart : unsigned char {
  kPoint,    ///< places of two points
  kTurning,  ///< directions of axes
  kLength,   ///< the distance of two points
  kLowest,   ///< the lower limit of its coordinate
  kHighest,  ///< the upper one
  kGrip,     ///< the rate of its coordinate
};

/// One of the boxes of a body, which is given by its index.
struct BoxOf {
  int body = 0;
  int box = 0;
  bool operator==(const BoxOf&) const = default;
};

/// A contact given by the touching parts of the bodies rather than by a point, so that it stays valid while
/// they move. Coincident faces, edges and corners give one feature for each point of the contact manifold. Or
/// a condition of a joint: one that holds takes every impulse; one that only ends on one side, as a limit or
/// a rope, is like a contact without friction, that closes where its gap does.
struct ContactFeature {
  enum class Kind {
    kPointOnWall,
    kPointOnFace,  ///< a point of a on a face of b
    kEdgeOnEdge,   ///< the crossing of an edge of a and one of b
    kInCone,       ///< points on an edge or a corner of each, with a cone of normals (NormalCone)
    kJoint,        ///< a joint's condition that holds
    kJointEnd,     ///< one that ends on one side
    kJointGrip,    ///< one that holds a rate, by no more than its grip
  };

  Kind kind = Kind::kPointOnWall;
  int a = 0;                    ///< index of a body; the normal points to it
  int b = 0;                    ///< index of a body, which may be a half-space
  int boxA = kWhole;            ///< of two boxes: which of a's
  int boxB = kWhole;            ///< likewise of b's
  Vec3 onA = Vec3::Zero();      ///< [m] in the frame of a's box, else a's: the point, or its edge's middle
  Vec3 onB = Vec3::Zero();      ///< [m] likewise of b's
  int axisA = 0;                ///< axis of its box along a's edge; kNoEdge for a point
  int axisB = 0;                ///< likewise along b's edge, or normal to b's face; kNoEdge for a point
  double sign = 1;              ///< of the face's outward normal, or of the edges' cross product
  Material material = {};       ///< of the pair
  Vec3 normalA = Vec3::Zero();  ///< [1] kInCone: the normal when it began, in the frame of a's box
  Vec3 normalB = Vec3::Zero();  ///< [1] likewise of b's
  AxisSet axes = 0;             ///< of both boxes, one of which keeps them apart as well as the normal does

  const Joint* joint = nullptr;  ///< of which it is a condition
  JointPart part{};

  static constexpr int kNoEdge = -1;
  static constexpr int kWhole = -1;  ///< no box in particular

  BoxOf ofA() const { return {a, boxA}; }
  BoxOf ofB() const { return {b, boxB}; }
  /// Whether it is a contact of two boxes, in any order.
  bool isBetween(const BoxOf& x, const BoxOf& y) const {
    return !isOfJoint() && ((ofA() == x && ofB() == y) || (ofA() == y && ofB() == x));
  }
  bool isOfJoint() const { return joint != nullptr; }
  bool holds() const { return kind == Kind::kJoint; }
  bool grips() const { return kind == Kind::kJointGrip; }
  /// Whether its impulse, along its rows, may have any sign.
  bool isTwoSided() const { return holds() || grips(); }
  ContactProblem::Admissible admissible() const {
    using Set = ContactProblem::Admissible;
    return holds() ? Set::kSpace : grips() ? Set::kInterval : Set::kCone;
  }
};

/// A feature at one moment. Its gap d and its slip change with accelerations v̇ and ω̇ of both sides, which of
/// what is driven are among the biases:
///   d̈ = n·(v̇_a + ω̇_a×armA − v̇_b − ω̇_b×armB) + gapBias,   d(slip)/dt = the same without n + slipBias,
///   gapBias = n·centripetal + 2 ṅ·slip.
struct ContactState {
  Vec3 normal = Vec3::UnitZ();     ///< [1] unit, from b to a
  Vec3 armA = Vec3::Zero();        ///< [m] world, from a's centre of mass to the contact
  Vec3 armB = Vec3::Zero();        ///< [m] likewise from b's
  double gap = 0;                  ///< [m]
  double rate = 0;                 ///< [m/s] of the gap
  Vec3 slip = Vec3::Zero();        ///< [m/s] tangential velocity of a relative to b's surface
  Vec3 surface = Vec3::Zero();     ///< [m/s] tangential, of b's surface relative to b
  Vec3 given = Vec3::Zero();       ///< [m/s] of b less that of a, as far as they are driven
  double gapBias = 0;              ///< [m/s²]
  Vec3 normalRate = Vec3::Zero();  ///< [1/s]
  /// [m/s²] Of the two points relative to each other: ω×(ω×arm), and what is driven.
  Vec3 centripetal = Vec3::Zero();
  Vec3 slipBias = Vec3::Zero();  ///< [m/s²]
  /// [m] How far the contact is past the end of its face or edge, negative within. kInCone: also how far
  /// apart its points are sideways, and how far its normal has left the cone, at the smaller box's half
  /// diagonal.
  double beyond = 0;
  Vec3 offset = Vec3::Zero();  ///< [m] kInCone: sideways, from b's point to a's
  /// [1] Of the feature's axes: the contact takes part only where the boxes would enter each other along all.
  std::vector<Vec3> directions = {};
  /// Of a joint's condition that is no point's along the normal: its rows, in place of those of normal and
  /// arms. Gap and rate are then the sizes of its own, if it holds.
  std::shared_ptr<const ConstraintRows> rows = {};
  double kept = 0;   ///< [m/s] that a grip keeps to: its rate is relative to it
  double grip = 0;   ///< [N] its largest force along its row
  double still = 0;  ///< [m/s] what rounding errors of its rate may amount to

  /// The rows of a and of b; of a contact, in that frame of its normal.
  RowSide sideA(const ContactFrame& frame) const { return rows ? rows->a : pointSide(frame.axes(), armA, 1); }
  RowSide sideB(const ContactFrame& frame) const {
    return rows ? rows->b : pointSide(frame.axes(), armB, -1);
  }

  /// [m/s] What velocities along its rows are to be, in that frame of its normal: of those of a and b that
  /// can be moved.
  ContactProblem::Triple target(const ContactFrame& frame) const {
    const Vec3 aim = surface + given;
    return {kept + dot(frame.normal, given), dot(aim, frame.tangent1), dot(aim, frame.tangent2)};
  }
  /// [m/s] of a relative to b's surface.
  Vec3 velocity() const { return slip + rate * normal; }
  /// [m/s] How fast the boxes part, and how fast they pass each other along any of the directions.
  double parting() const { return directions.empty() ? rate : partingSpeed(directions, velocity()); }
  double passing() const;
  /// Sets rate, slip and gapBias by this normal [1] and its rate [1/s].
  void setNormal(const Vec3& normal, const Vec3& normalRate);
};

/// A shape of a body, as an argument: a view, not to be stored. A box, by its size and place in the body, or
/// a half-space.
struct TouchingShape {
  const Vec3& halfExtents;         ///< [m]
  const Vec3& center = kCentered;  ///< [m] its middle, own frame
  const Wall* halfSpace = nullptr;
  const Mat3* bodyFromBox = nullptr;  ///< null: its axes are the body's

  static inline const Vec3 kCentered = Vec3::Zero();
};
/// One box of a body, or that around all of them.
TouchingShape shapeOf(const Body& body, int index);

/// Whether both are the same parts of the same bodies, whatever else is known of them.
bool isSame(const ContactFeature& x, const ContactFeature& y);

/// Whether the features include that corner of a body at that half-space.
bool hasCorner(std::span<const ContactFeature> features, const ContactFeature& corner);

/// Eq. 13 and its derivative; n rotates with b's face, or with both edges.
///
/// In a cone n is the mean of the two directions that it had in each body's frame when the contact began,
/// perpendicular to the edge on which the contact can move: the bodies carry it half way each, so it stays
/// symmetric. For parallel edges that is the bisector of the fan as it moves. With w from b's point to a's,
/// d = n·w, and where they touch d̈ = n·ẅ + 2ṅ·ẇ.
ContactState contactState(const ContactFeature& feature, const Kinematics& a, TouchingShape shapeA,
                          const Kinematics& b, TouchingShape shapeB);

/// The feature of two boxes at a point of boxContactPoints. `apart` [m] is their gap, negative for
/// penetration: a crossing of edges lies halfway between them.
ContactFeature featureAt(const ContactPoint& point, double apart, int a, const BoxAt& boxA, int b,
                         const BoxAt& boxB);

}  // namespace careen
