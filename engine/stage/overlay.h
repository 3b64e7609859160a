#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace careen {

/// Explanatory drawings over a film's pictures.
enum class Overlay {
  kContacts,         ///< contact points and normals of impacts
  kImpulses,         ///< impulses of these impacts
  kAngularMomentum,  ///< about the centre of mass
  kSpinAxis,         ///< instantaneous axis of rotation
  kTrail,            ///< path of a corner of each box
  kVelocity,         ///< of the centre of mass
  kNames,            ///< of boxes
  kTime,             ///< scene time, as a time code
  kEnergy            ///< its parts, and the loss
};

/// Names in scenes and on the command line, in the order of Overlay.
inline constexpr std::array<std::string_view, 9> kOverlayNames = {
    "contacts", "impulses", "angular-momentum", "spin-axis", "trail", "velocity", "names", "time", "energy"};

/// The overlays of a film.
class OverlaySet {
 public:
  void add(Overlay overlay) { shown_.at(static_cast<std::size_t>(overlay)) = true; }
  bool has(Overlay overlay) const { return shown_.at(static_cast<std::size_t>(overlay)); }
  bool any() const;
  /// Names separated by commas; "none" if empty.
  std::string text() const;

  friend bool operator==(const OverlaySet&, const OverlaySet&) = default;

 private:
  std::array<bool, kOverlayNames.size()> shown_{};
};

/// Parses what text() writes, names in any order. InputError for an unknown name; it lists the known ones.
OverlaySet overlaysNamed(std::string_view text);

}  // namespace careen
