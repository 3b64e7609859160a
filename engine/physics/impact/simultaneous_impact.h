#pragma once

#include <span>

#include "physics/impact/impact_law.h"

namespace careen {

/// resolveImpact of contacts that all take part, each along its normal, whatever directions it has.
ContactResiduals resolveTogether(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                                 std::span<ImpactShare> shares, ImpactAccuracy accuracy);

}  // namespace careen
