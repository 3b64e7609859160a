#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.h"
#include "stage/color.h"

namespace careen {

/// Of what points up or lies at the top, and of what points down or lies at the bottom.
struct ColorPair {
  Color above;
  Color below;
};

enum class TitlePlace { kTop, kMiddle, kBottom };
inline constexpr std::array<std::string_view, 3> kTitlePlaces = {"top", "middle", "bottom"};

/// Text over the film for a while.
struct Title {
  double from = 0;   ///< [s] of the film
  double to = 0;     ///< [s] likewise, later
  std::string text;  ///< UTF-8; line ends begin new lines
  TitlePlace place = TitlePlace::kBottom;
};

/// What a scene says of light and of what is drawn besides boxes and walls. What it leaves open is the
/// look's.
struct Scenery {
  std::optional<Vec3>
      towardsLight;  ///< [1] unit, world; else over the left shoulder of the film's first camera
  std::optional<double> lightDegrees;   ///< [deg] the angle that the light covers
  std::optional<Color> lightColor;      ///< of a white face that is turned to it
  std::optional<ColorPair> ambient;     ///< of white faces, by light from all around
  std::optional<ColorPair> background;  ///< from the top of the picture to its bottom
  std::optional<double> gloss;          ///< [1] of boxes: 0 matt, 1 like a mirror
  std::optional<bool> marks;            ///< whether boxes have a frame and the pips of a die
  std::vector<Title> titles;
};

/// [deg] The light may cover so much: beyond, shadows are wider than what casts them.
inline constexpr double kWidestLight = 60;

}  // namespace careen
