#pragma once

#include <optional>
#include <vector>

#include "physics/motion/recorder.h"
#include "physics/world/forces.h"
#include "physics/world/world.h"

namespace careen {

/// A body that contacts may push at a moment.
struct PushedBody {
  BodyState state;
  /// What contacts and joints give to it together; nothing: it flies, and no contact does.
  std::optional<Load> given = {};
  enum class Touches { kExactly, kInCrowd };
  Touches touches = Touches::kExactly;  ///< how its contacts are found: as those are that moved it
  double scale = 0;                     ///< [N] of the forces of which that is what remains
  double near = 0;                      ///< [m] what is no farther apart may push
  double slow = 0;                      ///< [m/s] what slips no faster may stick
  double over = 0;                      ///< [s] before and after, of which what it is given is the mean
};

/// The force of a contact at one point of a body, on it, or on the first of two. Where nothing was found that
/// gives a body what it is given, one without a partner and without force.
struct ContactPush {
  BodyIndex a;
  std::optional<Partner> b = {};
  Vec3 point = Vec3::Zero();    ///< [m] world
  Vec3 normal = Vec3::UnitZ();  ///< [1] from b to a
  Vec3 force = Vec3::Zero();    ///< [N] on a; the opposite on b
  /// [N] The more of both: what no contacts and joints give of the force that a body is given, and of the
  /// torque over its radius.
  double left = 0;
};

/// The forces of contact that move bodies as they move, in the order of bodies: such as are in the cones of
/// friction, and opposite to the slip of what slips, where that can be; of all these those with the least sum
/// of squares, together with those of joints at that time [s]. If what is near does not suffice, what is
/// farther away may push too. What moves with a contact's surface is what the material says.
std::vector<ContactPush> contactPushes(const World& world, const std::vector<PushedBody>& bodies,
                                       double time);

}  // namespace careen
