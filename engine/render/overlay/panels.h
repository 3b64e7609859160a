#pragma once

#include <string>

#include "render/overlay/frame.h"

namespace careen {

// Of panels at the picture's edges, in em squares.
inline constexpr double kPanelMargin = 0.9;
inline constexpr double kPanelPadding = 0.7;
inline constexpr double kPanelRow = 1.45;

/// Baseline of the row of text that begins at `top` [px].
double rowBaseline(const OverlayFrame& frame, double top);
/// Text of a panel, from the start of its baseline.
Label panelText(const OverlayFrame& frame, const std::string& text, const Vec2& at);

/// A panel of one line of text.
enum class PanelCorner { kUpperLeft, kLowerRight };
void addNote(OverlayShapes& shapes, const OverlayFrame& frame, const std::string& text, PanelCorner corner,
             Typeface typeface);

}  // namespace careen
