#include "physics/attitude/torque_free_rotation.h"

namespace careen {

template class TorqueFreeRotation<double>;

}  // namespace careen
