#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/math/linear_algebra.h"
#include "stage/color.h"

namespace careen {

// Shapes of overlays. Points are in pixels from the picture's upper left corner, x rightward, y downward.

/// sRGB colour with opacity.
struct Ink {
  Color color;
  double alpha = 1;  ///< 0 … 1
};

/// A line with round ends, or an arrow; a disc if both ends coincide.
struct Stroke {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();  ///< the arrow's tip
  double width = 1;        ///< [px]
  double head = 0;         ///< [px] length of the arrow's head; 0: none
  double halo = 0;         ///< [px] width of the dark rim around it
  Ink ink = {};
};

struct RibbonPoint {
  Vec2 at = Vec2::Zero();
  double strength = 1;  ///< 0 … 1, scales width and ink
  double alpha = 1;     ///< 0 … 1, scales ink only
};

/// A polyline without seams where it is translucent.
struct Ribbon {
  std::vector<RibbonPoint> points;
  double width = 1;  ///< [px] at strength 1
  Ink ink = {};
};

/// An axis-aligned rectangle.
struct Plate {
  Vec2 min = Vec2::Zero();
  Vec2 max = Vec2::Zero();
  double rounding = 0;  ///< [px] radius of its corners
  double hatching = 0;  ///< [px] distance of the stripes; 0: filled
  Ink ink = {};
};

enum class Typeface { kPlain, kMonospaced };

/// One line of text.
struct Label {
  std::string text;        ///< UTF-8
  Vec2 at = Vec2::Zero();  ///< start of its baseline
  double size = 12;        ///< [px] of the em square
  Typeface typeface = Typeface::kPlain;
  Ink ink = {};
};

/// Drawn in order, later ones over earlier ones.
using OverlayShape = std::variant<Stroke, Ribbon, Plate, Label>;
using OverlayShapes = std::vector<OverlayShape>;

}  // namespace careen
