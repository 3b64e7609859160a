#pragma once

#include "study/contestant.h"

namespace careen {

/// careen's own methods, one contestant each, in the order of kMethods; and "crowd": exact where all that is
/// jointed goes on as a crowd.
Contestants ownMethods();

}  // namespace careen
