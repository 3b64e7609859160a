#pragma once

#include <array>
#include <string_view>

#include "stage/name_set.h"

/// The explanatory drawings over a film's pictures: name in C++; name in scenes and on the command line. The
/// one list of them, a macro because a build without GL knows the names, not what draws them: that is the
/// OverlayKind k<Name>Overlay, in a source of its own in render/overlay.
#define CAREEN_OVERLAYS(OVERLAY)               \
  OVERLAY(Contacts, "contacts")                \
  OVERLAY(Impulses, "impulses")                \
  OVERLAY(AngularMomentum, "angular-momentum") \
  OVERLAY(SpinAxis, "spin-axis")               \
  OVERLAY(Trail, "trail")                      \
  OVERLAY(Velocity, "velocity")                \
  OVERLAY(Names, "names")                      \
  OVERLAY(Time, "time")                        \
  OVERLAY(Energy, "energy")                    \
  OVERLAY(Joints, "joints")                    \
  OVERLAY(Efforts, "efforts")                  \
  OVERLAY(Forces, "forces")

namespace careen {

#define CAREEN_OVERLAY_ENUMERATOR(Name, name) k##Name,
enum class Overlay { CAREEN_OVERLAYS(CAREEN_OVERLAY_ENUMERATOR) };

/// In the order of Overlay.
#define CAREEN_OVERLAY_NAME(Name, name) std::string_view(name),
inline constexpr std::array kOverlayNames = {CAREEN_OVERLAYS(CAREEN_OVERLAY_NAME)};

/// The overlays of a film.
using OverlaySet = NameSet<Overlay, kOverlayNames>;

}  // namespace careen
