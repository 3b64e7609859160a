#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "physics/world/partner.h"
#include "physics/world/world.h"

namespace careen {

/// What of a box a question may compare. Places and speeds are those of the box's middle, as in tables of
/// poses, and not of its centre of mass.
enum class Quantity : int {
  kHeight,  ///< [m] z of the middle
  kX,       ///< [m] likewise
  kY,
  kZ,
  kSpeed,    ///< [m/s] of the middle
  kSpin,     ///< [rad/s] |ω|
  kEnergy,   ///< [J] kinetic
  kTilt,     ///< [deg] between the box's z axis and the world's
  kDistance  ///< [m] of the middles of two boxes
};
inline constexpr std::array<std::string_view, 9> kQuantityNames = {
    "height", "x", "y", "z", "speed", "spin", "energy", "tilt", "distance"};

/// A statement about a run that is true at some times.
struct Question {
  enum class Kind {
    kTouches,  ///< one box touches another box or a wall
    kLeaves,   ///< the same, when it ends
    kBelow,    ///< a quantity is less than `level`
    kAbove,    ///< it is more
    kRests     ///< the boxes lie still until something strikes them
  };
  std::string text;  ///< as it was asked
  Kind kind = Kind::kRests;
  Quantity quantity = Quantity::kHeight;
  double level = 0;
  /// Whom it is about, a box first. Of kTouches one is with anything; of kRests none are all that can move.
  std::vector<Partner> of;
};

/// Reads one of
///   a touches b      a leaves b      boxes or walls; without b, or with `anything`, whatever it is
///   QUANTITY(a) < NUMBER             or >; distance(a, b)
///   rest(a)          rest
/// Blanks may stand between words. A name with blanks, or with one of ( ) , < > " ' in it, is quoted: "big
/// box" or 'big box'. InputError with the column, from 1, what was found and what was expected.
Question readQuestion(const std::string& text, const World& world);

/// Name of a box or wall of the world.
const std::string& nameOf(Partner partner, const World& world);

}  // namespace careen
