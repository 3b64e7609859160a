#include <array>
#include <cmath>
#include <cstdio>

#include "render/overlay/panels.h"

namespace careen {

std::string timeCode(double seconds) {
  const long long milliseconds = std::llround(1000 * seconds);
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%02lld:%02lld:%02lld.%03lld", milliseconds / 3600000,
                milliseconds / 60000 % 60, milliseconds / 1000 % 60, milliseconds % 1000);
  return text.data();
}

constexpr OverlayKind kTimeOverlay = {
    .shows = "the scene's time as hours:minutes:seconds",
    .layer = OverlayLayer::kPanels,
    .needs = OverlayNeeds::kText,
    .add = [](OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& /*shown*/) {
      addNote(shapes, frame, timeCode(frame.time), PanelCorner::kUpperLeft, Typeface::kMonospaced);
    }};

}  // namespace careen
