#pragma once

#include "study/contestant.h"

namespace careen {

/// The other engines for which this build has adapters, each with its defaults and with the best settings
/// found; empty without CAREEN_PEERS.
Contestants peers();

}  // namespace careen
