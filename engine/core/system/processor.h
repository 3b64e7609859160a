#pragma once

namespace careen {

/// Cores that this process may use: a job on a cluster gets only some of a machine's cores.
int usableCores();

}  // namespace careen
