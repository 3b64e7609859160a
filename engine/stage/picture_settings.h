#pragma once

#include <array>
#include <string>
#include <string_view>

#include "stage/frame_rate.h"
#include "stage/overlay.h"
#include "stage/shutter.h"

namespace careen {

/// How a film looks; each is a small set of numbers of the renderer's.
enum class Look { kStudio, kBlueprint, kClay };
inline constexpr std::array<std::string_view, 3> kLooks = {"studio", "blueprint",
                                                           "clay"};  ///< their names, in order

/// How edges are kept smooth.
enum class Antialiasing {
  kOff,
  kEdges,         ///< every pixel that an edge crosses gets its share of both sides: nearly as cheap as off
  kMultisampled,  ///< four samples a pixel
  kSupersampled,  ///< drawn twice as large each way, for stills: patterns are smooth too
};
inline constexpr std::array<std::string_view, 4> kAntialiasings = {"off", "edges", "4x", "supersampled"};

std::string nameOf(Look look);
std::string nameOf(Antialiasing antialiasing);
/// InputError, with the names there are, for any other.
Look lookNamed(std::string_view name);
Antialiasing antialiasingNamed(std::string_view name);

/// [px] in width and height: what GL drivers draw into.
inline constexpr int kLargestFilm = 16384;

/// What the pictures of a film are like, whatever they show: the one description that scene, run, command
/// line, renderer and film.json share.
struct PictureSettings {
  int width = 1280;  ///< [px] 1 … kLargestFilm
  int height = 720;  ///< [px] likewise
  FrameRate rate;
  Look look = Look::kStudio;
  Antialiasing antialiasing = Antialiasing::kEdges;
  Shutter shutter;
  OverlaySet overlays;

  double aspect() const { return static_cast<double>(width) / height; }
};

}  // namespace careen
