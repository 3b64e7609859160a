#pragma once

#include <array>
#include <string>
#include <string_view>

#include "stage/frame_rate.h"
#include "stage/light_part.h"
#include "stage/overlay.h"
#include "stage/shutter.h"

namespace careen {

/// Look of a film; each is a small set of the renderer's numbers.
enum class Look { kStudio, kBlueprint, kClay };
inline constexpr std::array<std::string_view, 3> kLooks = {"studio", "blueprint",
                                                           "clay"};  ///< their names, in order

/// How edges are smoothed.
enum class Antialiasing {
  kOff,
  kEdges,         ///< pixels on an edge blend both sides by coverage: nearly as cheap as off
  kMultisampled,  ///< four samples per pixel
  kSupersampled,  ///< drawn at twice the width and height, for stills: patterns are smooth too
};
inline constexpr std::array<std::string_view, 4> kAntialiasings = {"off", "edges", "4x", "supersampled"};

std::string nameOf(Look look);
std::string nameOf(Antialiasing antialiasing);
/// InputError for an unknown name; it lists the known ones.
Look lookNamed(std::string_view name);
Antialiasing antialiasingNamed(std::string_view name);

/// [px] width and height: limit of GL drivers.
inline constexpr int kLargestFilm = 16384;

/// Format and look of a film's pictures, whatever they show: the one description shared by scene, run,
/// command line, renderer and film.json.
struct PictureSettings {
  int width = 1280;  ///< [px] 1 … kLargestFilm
  int height = 720;  ///< [px] likewise
  FrameRate rate;
  Look look = Look::kStudio;
  Antialiasing antialiasing = Antialiasing::kEdges;
  Shutter shutter;
  OverlaySet overlays;
  LightParts light = LightParts::all();  ///< those the look has; a look may have fewer
  bool alpha = false;                    ///< boxes and their shadows on nothing, not on their stage

  double aspect() const { return static_cast<double>(width) / height; }
};

}  // namespace careen
