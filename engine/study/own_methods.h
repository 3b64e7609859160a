#pragma once

#include "study/contestant.h"

namespace careen {

/// careen's own methods, one contestant each, in the order of kMethods.
Contestants ownMethods();

}  // namespace careen
