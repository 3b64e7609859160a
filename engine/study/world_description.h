#pragma once

#include <nlohmann/json_fwd.hpp>

#include "physics/world/world.h"

namespace careen {

/// A world in SI units for engines in programs of their own, tests/peers/runner.mjs describes it. It has
/// no springs and no drag.
nlohmann::ordered_json descriptionOf(const World& world);

}  // namespace careen
