#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "film/frame_range.h"
#include "image/video_format.h"
#include "render/draw/renderer.h"
#include "render/film/film_pictures.h"
#include "trajectory/trajectory.h"

namespace careen {

/// What becomes of the careen film that is in the folder already. Only kReplace accepts another film than the
/// one asked for; the others then throw InputError.
enum class FilmThere {
  kDrawAgain,  ///< requested frames are drawn again, others stay
  kResume,     ///< whole frames stay, missing ones are drawn
  kReplace,    ///< its frames are removed
};

/// How a film is made; the picture settings are part of the run (Stage::picture).
struct FilmSettings {
  std::filesystem::path folder;    ///< for the frames: 000000.png, …
  std::vector<FrameRange> frames;  ///< empty: all
  /// Video of the requested frames, encoded by ffmpeg; its size and rate are those of the run's pictures.
  std::optional<VideoSettings> video;
  FilmThere there = FilmThere::kDrawAgain;
  ShownBesides besides;  ///< the runs must last until the film is done
  /// Number of worker processes, each drawing one frame at a time; absent: one per core. Never more than
  /// there are frames to draw.
  std::optional<int> jobs;
  /// Its thread count applies to each job; absent: cores per job, or none if that is one.
  RenderOptions render;
  std::string program;  ///< name and version, stored in the manifest
};

inline constexpr int kMostJobs = 1024;

/// Timings of one frame, measured by the process that drew it.
struct FrameFigures {
  std::int64_t frame = -1;
  double time = 0;              ///< [s] of the film
  double drawSeconds = 0;       ///< [s]
  double readSeconds = 0;       ///< [s] reading back
  double encodeSeconds = 0;     ///< [s] encoding and writing the PNG file
  std::array<char, 16> hash{};  ///< of the bytes of the PNG file, as text
};

struct FilmProgress {
  std::int64_t done = 0;       ///< finished frames, existing ones included
  std::int64_t total = 0;      ///< requested frames
  double framesPerSecond = 0;  ///< drawn in this call
  double secondsLeft = 0;      ///< [s] at that rate
  FrameFigures frame;          ///< the one just finished; in any order
};
using FilmCallback = std::function<void(const FilmProgress&)>;

/// Totals of one film.
struct FilmFigures {
  std::int64_t drawn = 0;
  std::int64_t skipped = 0;  ///< existed already
  int jobs = 0;              ///< worker processes
  double drawSeconds = 0;    ///< [s] sum over all frames
  double readSeconds = 0;    ///< [s] likewise, reading back
  double encodeSeconds = 0;  ///< [s] likewise, encoding and writing PNG files
  double wallSeconds = 0;    ///< [s] in total
  double coreSeconds = 0;    ///< [s] CPU time over all cores, without ffmpeg's
  PictureSettings picture;   ///< of what the film shows, other runs and plot included
  std::string renderer;      ///< empty if nothing was drawn
};

/// InputError if the film in the folder shows another scene than the one of this text, and is not to be
/// replaced: that much is known before a simulation, which may take long.
void refuseFilmOfAnotherScene(const FilmSettings& settings, std::string_view sceneText);

/// Renders a film of a run: frame k shows film time k/fps exactly, with the stage's camera and time map, and
/// with the same bytes however the work is split. Frames are written atomically, so a render that was
/// interrupted (Interrupted, after the frames in progress) or killed can be completed to the same bytes. An
/// careen film in the folder is treated as `there` says; it is the same film if it shows the same run in the
/// same way, by the same program and renderer. Nothing else there is changed. MachineError if a job dies.
///
/// Apart from 9 bytes a frame, memory does not grow with the film: with J jobs and P pixels it is the run,
/// once, 60 MB, and J times GL (about 40 MB and 20 P bytes with Mesa on the CPU); with a video, (J + 2)·3 P
/// bytes more to buffer frames, and what ffmpeg needs.
///
/// Jobs are forked, so this process must not have opened GL before (its threads do not survive a fork).
FilmFigures renderFilm(const Trajectory& run, const FilmSettings& settings, const FilmCallback& progress = {},
                       const std::stop_token& stop = {});

/// The film as the bytes of an MP4 file, of the quality and with the sound in the settings' video; its frames
/// are in a folder that is gone afterwards. Throws as renderFilm().
std::string filmAsMp4(const Trajectory& run, FilmSettings settings, const FilmCallback& progress = {},
                      const std::stop_token& stop = {});

}  // namespace careen
