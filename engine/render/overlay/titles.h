#pragma once

#include <span>

#include "render/overlay/frame.h"
#include "stage/scenery.h"

namespace careen {

/// [s] Titles come and go within this time, or a quarter of their own if that is shorter.
inline constexpr double kTitleFade = 0.25;

/// The titles of this moment of the film [s], each line in the middle; those at one place one above the
/// other.
void addTitles(OverlayShapes& shapes, const OverlayFrame& frame, std::span<const Title> titles,
               double filmTime);

}  // namespace careen
