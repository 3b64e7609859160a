#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "render/frame_range.h"
#include "render/renderer.h"
#include "scene/frame_rate.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

namespace careen {

struct FilmSettings {
  std::filesystem::path folder;    ///< of the frames: 000000.png, …
  std::vector<FrameRange> frames;  ///< empty: all
  int width = 1280;                ///< [px]
  int height = 720;                ///< [px]
  FrameRate rate;
  Shutter shutter;                             ///< in place of the scene's
  std::optional<std::filesystem::path> video;  ///< H.264 film of the frames asked for, by ffmpeg
  OverlaySet overlays;                         ///< drawn over the frames
  bool resume = false;  ///< frames of the same film that are there already are left as they are
  RenderOptions render;
};

struct FilmProgress {
  std::int64_t done = 0;       ///< frames there, old ones too
  std::int64_t total = 0;      ///< frames asked for
  double framesPerSecond = 0;  ///< drawn by this run
  double secondsLeft = 0;      ///< [s] at that rate
};
using FilmCallback = std::function<void(const FilmProgress&)>;

/// What a film took.
struct FilmFigures {
  std::int64_t drawn = 0;
  std::int64_t skipped = 0;  ///< were there already
  double drawSeconds = 0;    ///< [s] by the clock
  double readSeconds = 0;    ///< [s] by the clock, reading back
  double encodeSeconds = 0;  ///< [s] of a core, making and writing PNG files beside the drawing
  double wallSeconds = 0;    ///< [s] all of it
  double coreSeconds = 0;    ///< [s] of all cores; ffmpeg's not counted
  std::string renderer;      ///< empty if nothing had to be drawn
};

/// Films a run: frame k shows film time k/fps exactly, as the scene's camera and time map want it. Frames
/// appear whole or not at all, so a run that was interrupted (Interrupted) or killed can be completed, to the
/// same bytes. A film of careen's that is in the folder already is replaced, or with `resume` completed if it
/// is the same one; nothing else there is touched.
FilmFigures renderFilm(const Trajectory& trajectory, const Scene& scene, const FilmSettings& settings,
                       const FilmCallback& progress = {}, const std::stop_token& stop = {});

}  // namespace careen
