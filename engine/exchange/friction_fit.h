#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace careen {

/// Coefficients of friction μᵢ of bodies whose pairs have the geometric means sqrt(μᵢ μⱼ).
struct FrictionFit {
  std::vector<double> coefficients;  ///< [1] one for each body
  std::optional<std::pair<std::size_t, std::size_t>>
      misfit;  ///< the first pair that has another; none: exact
};

inline constexpr double kFrictionFits = 1e-12;  ///< relative

/// Finds the coefficients from the frictions of pairs: programs differ in how they combine two coefficients,
/// and what counts is the pair's. Two immovable bodies are no pair. `own`: what to take where the pairs leave
/// a choice, and taken whole if it fits. `friction` is symmetric; where it is NaN there is no pair. A pair
/// without friction needs one body that is without it. Costs O(n²).
FrictionFit fitFrictions(const std::vector<double>& own, const std::vector<bool>& movable,
                         const std::function<double(std::size_t, std::size_t)>& friction);

}  // namespace careen
