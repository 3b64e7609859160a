#pragma once

#include <array>
#include <optional>

#include "audit/kinds.h"
#include "physics/world/run_settings.h"

namespace careen {

/// The largest size of one kind of finding that a method promises not to exceed; none: it promises nothing.
/// Beyond it, an audit always allows for the rounding of the numbers compared.
struct Promise {
  double absolute = 0;    ///< in the kind's own unit
  double tolerances = 0;  ///< [1] added: so many times RunSettings::tolerance, for kinds in metres; for kinds
                          ///< without a unit, relative to half the diagonal of the smallest box concerned
  double crowdTolerances = 0;  ///< [1] added: so many times CrowdSettings::tolerance
};

using Promises = std::array<std::optional<Promise>, kAuditKindCount>;

/// What a method promises; `crowd`: of bodies that are, or were, members of a crowd. The manual has the same
/// table.
Promises promisesOf(Method method, bool crowd);

/// What a run that comes from a table of poses is held to, though nobody promised it: `tolerance` [1] of what
/// momenta and energies are relative to, and as many times RunSettings::tolerance [m] where boxes overlap or
/// jump. Numbers are finite, and quaternions were normalised, as the table was read.
Promises promisesOfTable(double tolerance);

/// The largest size that is no breach; `length` [m] is what the tolerance is relative to, 1 for kinds in
/// metres.
double allowed(const Promise& promise, const RunSettings& settings, double length);

/// [m] How deep boxes and walls may be in each other, if the method promises that.
std::optional<double> promisedDepth(const RunSettings& settings, bool crowd);

}  // namespace careen
