#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "exchange/mjcf_model.h"

namespace careen {

/// What happens where surfaces of a model meet.
struct MjcfContacts {
  std::vector<double> frictions;                        ///< [1] coefficient of each surface
  bool isRefitted = false;                              ///< those are not the file's
  std::set<std::pair<std::size_t, std::size_t>> apart;  ///< boxes that pass through each other, lesser first
};

inline constexpr std::size_t kMostImportedPairs = 10'000'000;  ///< of different friction

/// Whether bodies meet those that they are in, unless these stand still: <flag filterparent>.
enum class FilterParent : unsigned char { kNo, kYes };

/// Reads <contact>, and what MuJoCo lets through each other: boxes of one body or of bodies without a joint
/// between them, a body and the one that it is in, <exclude>, and
/// what contype and conaffinity keep apart; but not what a <pair> names. InputError where a wall would let a
/// box through, where pairs name some geoms of two bodies and not others, or differ for them, and where no
/// coefficients give each pair its friction (exchange/friction_fit.h).
MjcfContacts readContacts(MjcfDocument& document, const MjcfModel& model, FilterParent filterParent);

}  // namespace careen
