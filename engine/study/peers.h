#pragma once

#include "study/contestant.h"

namespace careen {

/// The other engines that this build has adapters to, each at its defaults and at the best settings found;
/// none without CAREEN_PEERS.
Contestants peers();

}  // namespace careen
