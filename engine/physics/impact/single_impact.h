#pragma once

#include "physics/impact/impact_law.h"

namespace careen {

/// resolveImpact for one contact, in closed form. `b` is null for a wall.
ImpactShare resolveSingleImpact(const ImpactBody& a, const ImpactBody* b, const ImpactContact& contact);

}  // namespace careen
