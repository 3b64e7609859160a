#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace careen {

/// What may be drawn over a film's pictures to explain them.
enum class Overlay {
  kContacts,         ///< where boxes struck something, and the normals there
  kImpulses,         ///< what they got from it
  kAngularMomentum,  ///< about the centre of mass
  kSpinAxis,         ///< what a box turns about at the moment
  kTrail,            ///< where a corner of each box came from
  kVelocity,         ///< of the centre of mass
  kNames,            ///< of boxes
  kTime,             ///< of the scene, as a time code
  kEnergy            ///< its parts, and what of it is lost
};

/// In the order of Overlay: as scenes and commands spell them.
inline constexpr std::array<std::string_view, 9> kOverlayNames = {
    "contacts", "impulses", "angular-momentum", "spin-axis", "trail", "velocity", "names", "time", "energy"};

/// Which overlays a film has.
class OverlaySet {
 public:
  void add(Overlay overlay) { shown_.at(static_cast<std::size_t>(overlay)) = true; }
  bool has(Overlay overlay) const { return shown_.at(static_cast<std::size_t>(overlay)); }
  bool any() const;
  /// Names with commas between; "none" if there is none.
  std::string text() const;

  friend bool operator==(const OverlaySet&, const OverlaySet&) = default;

 private:
  std::array<bool, kOverlayNames.size()> shown_{};
};

/// Reads what text() writes, names in any order. InputError, with the names there are, for any other.
OverlaySet overlaysNamed(std::string_view text);

}  // namespace careen
