#pragma once

#include <stop_token>
#include <string>

#include "command_line.h"
#include "render/film/film.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Whether a film has sound.
struct SoundChoice {
  bool asked = false;
  bool keepsPitch = false;  ///< in slow motion

  /// The option that asks for it.
  CommandOption addTo(const CommandLine& command);
  /// Of the frames in the settings, as bytes of a WAV file, which their video gets as well; empty if none is
  /// asked for. InputError if the frames do not follow each other, or the video has no place for sound.
  std::string of(const Trajectory& run, FilmSettings& settings, const std::stop_token& stop) const;
};

}  // namespace careen
