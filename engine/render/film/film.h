#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "film/frame_range.h"
#include "image/video_format.h"
#include "render/draw/renderer.h"
#include "trajectory/trajectory.h"

namespace careen {

/// How a film is made; what its pictures are like is the run's (Stage::picture).
struct FilmSettings {
  std::filesystem::path folder;    ///< of the frames: 000000.png, …
  std::vector<FrameRange> frames;  ///< empty: all
  /// Film of the frames asked for, by ffmpeg; its size and rate are taken from the run's pictures.
  std::optional<VideoSettings> video;
  bool resume = false;  ///< frames of the same film that are there already are left as they are
  /// Processes that draw, each a frame at a time; absent: one for each core. Never more than there are frames
  /// to draw.
  std::optional<int> jobs;
  /// Its threads: for each job; absent: as many as there are cores for it, none for a core of its own.
  RenderOptions render;
  std::string program;  ///< name and version, to be kept with the film
};

inline constexpr int kMostJobs = 1024;

/// What a frame took, by the clock of the process that drew it.
struct FrameFigures {
  std::int64_t frame = -1;
  double time = 0;           ///< [s] of the film
  double drawSeconds = 0;    ///< [s]
  double readSeconds = 0;    ///< [s] reading back
  double encodeSeconds = 0;  ///< [s] making and writing the PNG file
};

struct FilmProgress {
  std::int64_t done = 0;       ///< frames there, old ones too
  std::int64_t total = 0;      ///< frames asked for
  double framesPerSecond = 0;  ///< drawn by this run
  double secondsLeft = 0;      ///< [s] at that rate
  FrameFigures frame;          ///< the one just done; they come in any order
};
using FilmCallback = std::function<void(const FilmProgress&)>;

/// What a film took.
struct FilmFigures {
  std::int64_t drawn = 0;
  std::int64_t skipped = 0;  ///< were there already
  int jobs = 0;              ///< processes that drew
  double drawSeconds = 0;    ///< [s] sum over all frames
  double readSeconds = 0;    ///< [s] likewise, reading back
  double encodeSeconds = 0;  ///< [s] likewise, making and writing PNG files
  double wallSeconds = 0;    ///< [s] all of it
  double coreSeconds = 0;    ///< [s] of all cores; ffmpeg's not counted
  std::string renderer;      ///< empty if nothing had to be drawn
};

/// Films a run: frame k shows film time k/fps exactly, as the stage's camera and time map want it, by the
/// same bytes however the work is split. Frames appear whole or not at all, so a run that was interrupted
/// (Interrupted, after the frames at hand) or killed can be completed, to the same bytes. A film of careen's
/// that is in the folder already is replaced, or with `resume` completed if it is the same one, drawn by the
/// same program and renderer; nothing else there is touched. A job that dies ends the film, with
/// MachineError.
///
/// Memory does not grow with the film, but for 9 bytes a frame: with J jobs and P pixels it is the run, once,
/// 60 MB, and J times GL (about 40 MB and 20 P bytes with Mesa on the processor); with a video, (J + 2)·3 P
/// bytes more, for frames that wait for their turn, and what ffmpeg takes.
///
/// Jobs are forked, so this process must not have opened GL before (GL's threads are not forked with it).
FilmFigures renderFilm(const Trajectory& run, const FilmSettings& settings, const FilmCallback& progress = {},
                       const std::stop_token& stop = {});

}  // namespace careen
