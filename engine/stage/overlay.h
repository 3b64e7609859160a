#pragma once

#include <array>
#include <string_view>

#include "stage/name_set.h"

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
using OverlaySet = NameSet<Overlay, kOverlayNames>;

}  // namespace careen
