#pragma once

#include <cstddef>

#include "exchange/mjcf_document.h"

namespace careen {

/// Puts copies in the place of each <replicate>: the i-th in a <frame> whose euler is i times that of the
/// element and whose place follows from those before it, with i, in as many digits as the count has, at the
/// end of its names. Elements of <contact> and <tendon> that name what is copied are copied with it, as in
/// MuJoCo; InputError if they name something else too, which MuJoCo has no copies of, or if all copies
/// together have more than kMostReplicated elements.
void replicate(MjcfDocument& document);
inline constexpr std::size_t kMostReplicated = 100'000;

}  // namespace careen
