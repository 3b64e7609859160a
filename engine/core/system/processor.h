#pragma once

namespace careen {

/// Cores that this process may use: a cluster's job is given some of a machine's.
int usableCores();

}  // namespace careen
