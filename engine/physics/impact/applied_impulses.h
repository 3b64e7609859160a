#pragma once

#include <span>

#include "physics/impact/impact_law.h"

namespace careen {

/// Adds the impulses of the contacts to velocity and angular momentum of the body with that index, in no
/// order of the contacts: `impulses` [N s], in the world, on a, or, of contacts with rows, those of their
/// shares. A component below the rounding error of its terms becomes zero.
void applyImpulses(int index, const ImpactBody& body, std::span<const ImpactContact> contacts,
                   std::span<const ImpactShare> shares, std::span<const Vec3> impulses);

}  // namespace careen
