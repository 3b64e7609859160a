#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "exchange/mjcf_model.h"

namespace careen {

/// What <equality> joins beside the joints of bodies.
struct MjcfClosing {
  bool isFixed = false;  ///< a weld; else a point in common
  std::string name;
  std::size_t from = 0;           ///< a box that moves
  std::optional<std::size_t> to;  ///< none: the world
  Vec3 at = Vec3::Zero();         ///< [m] world, at the start
};

/// An actuator of a joint that follows something.
struct MjcfMotor {
  std::size_t surface = 0;  ///< whose joint it is
  double kp = 0;            ///< [N m/rad] or [N/m]
  double kd = 0;            ///< [N m s/rad] or [N s/m]
  double target = 0;        ///< [rad] or [m]
  double largest = 0;       ///< [N m] or [N]; 0: no bound
};

struct MjcfLinks {
  std::vector<MjcfClosing> closings;
  std::vector<MjcfMotor> motors;
  double timestep = 0.002;  ///< [s] MuJoCo's own, unless the model says another
};

/// Reads <equality> and <actuator>: <connect> and <weld>; <position> and <velocity> of hinges and slides with
/// the controls of the key frame "start", and motors, which do nothing without a control. What does not hold
/// at the start, and all others, are refused: InputError.
MjcfLinks readLinks(MjcfDocument& document, MjcfModel& model);

}  // namespace careen
