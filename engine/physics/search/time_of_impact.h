#pragma once

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/geometry/separation.h"
#include "physics/motion/motion.h"

// Time of impact of a tumbling box with a wall or another tumbling box. Nothing is sampled (conservative
// advancement): time advances by steps each *proved* free of contact, so no contact is missed however fast,
// thin or grazing.
//
// The proof. Along a direction u every vertex (or pair of vertices) c has a height f_c(t), and the gap is the
// lowest: d = min_c f_c. With a bound M ≥ −f̈_c valid for the whole flight,
//     d(t₀+δ) ≥ min_c [ f_c(t₀) + ḟ_c(t₀) δ ] − ½Mδ²  =:  F(δ),
// and min_c [...] = level + rate·δ − Σ hₖ|qₖ + q̇ₖδ| has one kink per edge. F is concave and known in closed
// form; up to its first root there is no contact. A gap that closes at a finite speed is approached
// quadratically, as by Newton's method, but never overshot.
//
// Bounds. W ≥ |ω| and W' ≥ |ω̇| over the flight; a vector of length r fixed in the body has |r̈| ≤ K r with K
// = W² + W' (Eq. 13). R is the half diagonal, Δ runs from b's centre to a's, V ≥ |Δ̇|, G = |relative
// gravity|, and K_ab = K_a + 2 W_a W_b + K_b bounds the second derivative of any product of a vector of each.
//     wall                      M = K R − n·g
//     u rotating with b's face  M = K_b|Δ| + 2 W_b V + G + K_ab R_a   (f = u·Δ + u·r_a; likewise a's face)
//     N = aᵢ×bⱼ rotating        M = K_ab|Δ| + 2 (W_a+W_b) V + G + K_ab (ρ_a+ρ_b)
//     u fixed in space          M = K_a R_a + K_b R_b − u·g
// Of a flight with jerk, g is that of its start or its end, where it does more. Two with the same jerk have
// none relative to each other.
// Where the middle of a box is not its centre of mass, Δ is that of the centres of mass, R the distance to
// the furthest corner, and the constant part of f moves with the boxes: the bounds M stay.
// ρ is the half diagonal across the edge. In a ContactStep the centre's path is no parabola: G then bounds
// the relative acceleration in any direction; nor is that of what is driven. N keeps its length sin θ: its
// root is that of the unit direction and M does not grow as θ → 0. Directions that rotate with the boxes
// converge quadratically; the fixed one is cheap, also safe for nearly parallel edges, and gives the long
// time steps. Each proves its step on its own, so the longest is taken.
//
// Touching. A gap within rounding is zero (kGapRounding). If it closes, that is an impact; if not, the pair
// is followed until it separates, or sinks by 4 roundings without ever closing at a speed above rounding
// (resting on the wall, rolling, or a hop too low to resolve): then flight ends and contact stepping takes
// over.

namespace careen {

/// Attitude and angular velocity of a body at one time.
struct Attitude {
  Mat3 worldFromBody = Mat3::Identity();
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s] world frame
};

/// Non-owning view of a callable that maps the time since the flight began [s] to an Attitude; the callable
/// must outlive it.
class AttitudeView {
 public:
  template <class Rotation>
  explicit AttitudeView(const Rotation& rotation)
      : rotation_(&rotation), call_([](const void* self, double elapsed) -> Attitude {
          return (*static_cast<const Rotation*>(self))(elapsed);
        }) {}
  Attitude operator()(double elapsed) const { return call_(rotation_, elapsed); }

 private:
  const void* rotation_;
  Attitude (*call_)(const void*, double);
};

/// A box in flight, at rest (velocity, acceleration and bounds zero), in a ContactStep, or driven.
struct MovingBox {
  Vec3 halfExtents;
  Vec3 center = Vec3::Zero();           ///< [m] middle of the box, own frame
  const Mat3* bodyFromBox = nullptr;    ///< null: its axes are the body's
  Vec3 position;                        ///< [m] of the centre of mass when the flight began, world
  Vec3 velocity;                        ///< [m/s] likewise
  Vec3 acceleration;                    ///< [m/s²] likewise
  double age = 0;                       ///< [s] time since the flight began, at search time 0
  double angularSpeedBound = 0;         ///< [rad/s] never exceeded in this flight
  double angularAccelerationBound = 0;  ///< [rad/s²] likewise
  AttitudeView attitude;
  const ContactStep* step = nullptr;  ///< motion of the centre, in place of the above
  double speedBound = 0;              ///< [m/s] of the centre in this step, or driven
  double accelerationBound = 0;       ///< [m/s²] likewise
  const Driven* driven = nullptr;     ///< likewise
  Vec3 jerk = Vec3::Zero();           ///< [m/s³] of a flight, constant
  double lasts = 0;                   ///< [s] of one with jerk, since it began: no search goes on for longer

  bool isFlight() const { return step == nullptr && driven == nullptr; }
  Vec3 positionAt(double time) const {
    const double elapsed = age + time;
    return isFlight()
               ? position +
                     (velocity + 0.5 * elapsed * acceleration + (elapsed * elapsed / 6) * jerk) * elapsed
           : step != nullptr ? careen::positionAt(*step, elapsed)
                             : driven->at(elapsed).pose.position;
  }
  Vec3 velocityAt(double time) const {
    const double elapsed = age + time;
    return isFlight()        ? velocity + elapsed * acceleration + (0.5 * elapsed * elapsed) * jerk
           : step != nullptr ? careen::velocityAt(*step, elapsed)
                             : driven->at(elapsed).velocity;
  }
  /// [m/s²] Of a flight, `elapsed` [s] after it began.
  Vec3 accelerationAfter(double elapsed) const { return acceleration + elapsed * jerk; }
  /// [m] From the centre of mass to the furthest corner.
  double radius() const { return (center.cwiseAbs() + halfExtents).norm(); }
  /// Of the box's own axes, `elapsed` [s] after the flight began.
  Attitude attitudeAfter(double elapsed) const {
    Attitude now = attitude(elapsed);
    if (bodyFromBox != nullptr) {
      now.worldFromBody = now.worldFromBody * *bodyFromBox;
    }
    return now;
  }
  Pose poseAt(double time) const {
    return {.position = positionAt(time), .worldFromBody = attitudeAfter(age + time).worldFromBody};
  }
};

enum class ContactKind {
  kNone,      ///< proved free of contact up to `time`
  kImpact,    ///< at `time` the gap is zero and closes
  kTouching,  ///< from `time` on the gap stays zero within rounding and sinks: needs contact stepping
};

struct FirstContact {
  ContactKind kind = ContactKind::kNone;
  /// [s] kNone: the end of the search, or earlier if its evaluation budget ran out (resume from there).
  double time = 0;
  double approach = 0;         ///< [m/s] closing speed of the gap, of the fastest of the lowest corners
  Vec3 normal = Vec3::Zero();  ///< [1] unit, from b (or the wall) to a
  BoxAxis axis;                ///< box and box: separating axis whose gap closed
  CornerSet corners = 0;       ///< box and wall: the lowest corners, within kSimultaneous
  int evaluations = 0;         ///< number of attitude evaluations
};

/// [s] Search time is 0 where the ages put it. A search from 0 depends on the two flights alone, so its
/// result is the same bits whenever it is run: let 0 be the time at which the later of the two flights began.
struct SearchWindow {
  double from = 0;
  double until = 0;
};

/// First contact of a box with the wall normal·x = offset (normal unit, towards the free side). A box that
/// was just resolved and separates is no contact; one that starts in penetration is none either unless it
/// closes further.
FirstContact firstContactWithWall(const MovingBox& box, const Vec3& normal, double offset,
                                  const SearchWindow& window);

/// [s] Time (≥ 0) until which the box's bounding sphere is clear of the wall.
double sphereClearUntil(const MovingBox& box, const Vec3& normal, double offset);

/// First contact of two boxes. Swapping a and b gives the same bits in time (normal reversed).
FirstContact firstContactOfBoxes(const MovingBox& a, const MovingBox& b, const SearchWindow& window);

}  // namespace careen
