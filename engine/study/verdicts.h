#pragma once

#include <array>
#include <optional>
#include <string>

#include "study/results.h"

namespace careen {

/// An answer to a scene that was published with its answer is right if its error, Judgement::error, is never
/// above this: a tenth of a half diagonal, or a tenth of a radian. What was published is what happens (it
/// holds, stands, comes back), not to how many digits: those are the error's.
inline constexpr double kRight = 0.1;

/// "right", "wrong", or "–" without an answer.
std::string verdictOf(const Attempt* attempt);

/// Tolerances of the matrix of kept promises, in units of the scene's own; 1e-4 to 1e-10 m by default.
inline constexpr std::array<double, 4> kPromisedTolerances = {1e2, 1, 1e-2, 1e-4};

/// Judgement::displacement of method exact over the tolerance it was asked for, this factor times the scene's
/// own; above 1 the promise is broken. An answer that depends on no tolerance counts for all of them.
/// std::nullopt if it was not tried, has no answer, or the case measures energy or overlap.
std::optional<double> promiseOf(const CaseResult& result, double factor);

}  // namespace careen
