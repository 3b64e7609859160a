#pragma once

#include <array>
#include <string_view>

#include "stage/name_set.h"

namespace careen {

/// Parts of the light that a picture can do without.
enum class LightPart {
  kShadows,    ///< of boxes, by the light
  kOcclusion,  ///< of ambient light, by boxes and walls
  kBounce      ///< colour that occluders send back; nothing without occlusion
};

/// Names in scenes and on the command line, in the order of LightPart.
inline constexpr std::array<std::string_view, 3> kLightPartNames = {"shadows", "occlusion", "bounce"};

using LightParts = NameSet<LightPart, kLightPartNames>;

}  // namespace careen
