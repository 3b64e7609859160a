#pragma once

#include <functional>
#include <span>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/impact/impact_law.h"
#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// A joint's condition at one moment, of a (the body of its end `from`) and b. With r the arms to both
/// points, d from b's point to a's, F the frames of both ends, ℓ [m] the half diagonal of the smaller body,
/// so that turning counts in metres too:
///
///                      coordinate      rows of a; of b                    bias
///   point along e      e·d             e, r_a×e; −e, −r_b×e               e·κ
///   across n of b      n·d             n, r_a×n; −n, −(r_b+d)×n           n·κ′ + 2 ṅ·ḋ′
///   e of a ⟂ f of b    ℓ e·f           0, ℓ e×f; 0, −ℓ e×f                ℓ ((ω_a×e)×f +
///   e×(ω_b×f))·(ω_a−ω_b) distance, u along d  ±(|d| − L)    ±(u, r_a×u; −u, −r_b×u)            ±(u·κ + |ḋ
///   across u|²/|d|) angle θ            ±ℓ (θ − θ₀)     0, ±ℓ z_b; 0, ∓ℓ z_b               ±ℓ
///   (ω_b×z_b)·(ω_a−ω_b)
///
/// A grip has the row of the angle, or that of a point along b's axis; its coordinate counts as 0.
///
/// κ = ω_a×(ω_a×r_a) − ω_b×(ω_b×r_b) [m/s²]; κ′ and ḋ′ are those of b's point that is where a's is.
ContactState jointState(const ContactFeature& feature, const Kinematics& a, TouchingShape shapeA,
                        const Kinematics& b, TouchingShape shapeB);

/// The conditions of all joints that have not let go by `time` [s]. `placeOf(end)`: the index of its body, or
/// −1; joints of which an end has none are left out.
std::vector<ContactFeature> jointFeatures(const World& world, double time,
                                          const std::function<int(const JointEnd&)>& placeOf);

/// What the condition of a joint passed on in an impact; the middle [m] of its first body.
JointImpulse jointImpulseOf(const World& world, double time, const ContactFeature& feature,
                            const ImpactContact& contact, const ImpactShare& share, const Vec3& position);

}  // namespace careen
