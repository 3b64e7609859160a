#pragma once

#include "physics/impact/impact_law.h"

namespace careen {

/// resolveImpact for one contact, by its closed form. `b` is null for a wall.
ImpactShare resolveSingleImpact(const ImpactBody& a, const ImpactBody* b, const ImpactContact& contact);

/// Two unit vectors that complete a unit normal to an orthogonal frame. Mirrored in a coordinate plane, a
/// normal has the mirrored tangents, up to their signs.
struct Tangents {
  Vec3 first;
  Vec3 second;
};
Tangents tangentsOf(const Vec3& normal);

}  // namespace careen
