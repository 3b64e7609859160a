#pragma once

#include <cstddef>
#include <vector>

#include "physics/contact/contact_system.h"

namespace careen {

// What counts as standing still, of a system at the state at which its forces were last found.

/// Whether nothing moves or begins to.
bool isAtRest(const ContactSystem& system);

/// Slip this slow is what time steps and impacts leave of sticking contacts: its direction means nothing, and
/// friction would end it at once. `tolerance` [m]: of positions.
bool creeps(const ContactSystem& system, std::size_t contact, double tolerance);

/// Stops slip that has nearly ended: integrated up to its end it would take ever shorter steps. Returns
/// whether there was some.
bool stopSlip(ContactSystem& system, std::vector<double>& y, double tolerance);

}  // namespace careen
