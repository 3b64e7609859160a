#pragma once

#include <functional>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// Keys of an animation between which players interpolate linearly, as glTF 2.0 has it ("LINEAR"). Times and
/// values are single precision, and the errors include their rounding.
template <class Value>
struct AnimationKeys {
  std::vector<float> times;   ///< [s] ascending
  std::vector<Value> values;  ///< one for each time; of single precision
  double error = 0;           ///< the largest found, at ten and more moments between any two keys

  /// Whether a single value says all.
  bool isConstant() const;
};

/// The moments that keys are chosen for.
struct AnimatedSpan {
  double duration = 0;        ///< [s] from 0
  std::vector<double> kinks;  ///< [s] ascending: where velocities jump, and where rest begins and ends
  std::vector<double> seams;  ///< [s] ascending: where the motion goes over into another one without a jump
};

/// A line between two points, drawn as one of unit length along z that is moved, turned and stretched.
struct LinePlacement {
  Vec3 from = Vec3::Zero();               ///< [m]
  Quat worldFromLine = Quat::Identity();  ///< turns z towards the other end
  double length = 0;                      ///< [m]

  Vec3 to() const { return from + worldFromLine * Vec3(0, 0, length); }
  bool operator==(const LinePlacement& other) const {
    return from == other.from && worldFromLine.coeffs() == other.worldFromLine.coeffs() &&
           length == other.length;
  }
};
LinePlacement linePlacement(const Vec3& from, const Vec3& to);

/// Chooses keys on the motion, as few as hold the error within `within`: each key is as far from the last as
/// the error of the line between them allows, which is the least number for keys that lie on the motion. Two
/// keys, at neighbouring numbers of single precision, enclose each kink. Errors: distance [m]; angle [rad],
/// both by spherical and by normalised linear interpolation (three.js and VTK do the first, Blender the
/// second); distance of a line's ends [m]. Signs of quaternions are such that neighbours have a positive
/// product. `at` maps a time in [0, duration] to a value.
/// InputError if the rounding alone is more than the bound, as 1e6 m from the origin, and beyond ten million
/// keys.
AnimationKeys<Vec3> positionKeys(const AnimatedSpan& span, double within,
                                 const std::function<Vec3(double)>& at);
AnimationKeys<Quat> rotationKeys(const AnimatedSpan& span, double within,
                                 const std::function<Quat(double)>& at);
AnimationKeys<LinePlacement> lineKeys(const AnimatedSpan& span, double within,
                                      const std::function<LinePlacement(double)>& at);

}  // namespace careen
