#pragma once

#include <algorithm>

#include "render/overlay/shapes.h"

namespace careen {

// Style of overlays: muted colours that suit the scene, with a dark rim or plate for contrast on both light
// walls and dark background.

inline constexpr Color kIvory{242, 238, 228};
inline constexpr Color kSlate{19, 23, 28};
inline constexpr Color kTeal{72, 164, 176};     // velocity and translational energy
inline constexpr Color kViolet{158, 132, 204};  // angular momentum and rotational energy
inline constexpr Color kMoss{132, 172, 98};     // spin axis
inline constexpr Color kAmber{232, 168, 62};    // impulses
inline constexpr Color kSand{205, 186, 140};    // potential energy
inline constexpr Color kRose{200, 122, 116};    // spring energy and efforts of motors
inline constexpr Color kCoral{226, 108, 62};    // forces of contact
inline constexpr Color kGrey{132, 136, 140};    // lost energy

inline constexpr double kPlateAlpha = 0.70;
inline constexpr double kEasyText = 12;     // [px] em square: easily read
inline constexpr double kSmallestText = 8;  // [px] just read

/// Sizes [px] in proportion to the picture height [px], but never too small to read. Text is easily read from
/// 360 px of height on; on smaller pictures it shrinks with them for a while, so that something else is seen
/// too.
struct OverlayStyle {
  explicit OverlayStyle(int height)
      : text(std::max({kSmallestText, std::min(kEasyText, kEasyText * height / 360), 0.0236 * height})),
        line(std::max(1.5, 0.0032 * height)),
        halo(std::max(1.0, 0.0016 * height)),
        head(6 * line),
        longestArrow(0.2 * height) {}

  double text;          ///< em square
  double line;          ///< width of an arrow's shaft
  double halo;          ///< width of its dark rim
  double head;          ///< length of its head
  double longestArrow;  ///< for the largest value of the film, perpendicular to the line of sight
};

}  // namespace careen
