#pragma once

#include "physics/motion/motion.h"

namespace careen {

/// What all forces together give to a body.
struct MomentumRates {
  Vec3 linear = Vec3::Zero();   ///< [N]
  Vec3 angular = Vec3::Zero();  ///< [N m] about the centre of mass
};
/// Those that move the body as the step does.
MomentumRates momentumRatesAt(const ContactStep& step, const MassProperties& mass, double elapsed);

}  // namespace careen
