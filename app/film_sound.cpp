#include "film_sound.h"

#include "core/error.h"
#include "sound/sound_track.h"

namespace careen {

CommandOption SoundChoice::addTo(const CommandLine& command) {
  const CommandOption option = command.addFlag(
      "--sound", asked,
      "The film's sound, as sound.wav among its frames and in its video: boxes ring where they are "
      "struck, and hiss where they slide");
  command
      .addFlag("--sound-pitch", keepsPitch,
               "In slow motion sounds begin later, but are as high and as long as otherwise")
      .needs(option);
  return option;
}

std::string SoundChoice::of(const Trajectory& run, FilmSettings& settings,
                            const std::stop_token& stop) const {
  if (!asked) {
    return {};
  }
  try {
    std::string wav =
        wavOf(soundTrackOf(run, settings.frames, keepsPitch ? Pitch::kStays : Pitch::kSlows, stop));
    if (settings.video) {
      settings.video->sound = wav;
      checkVideo(*settings.video);
    }
    return wav;
  } catch (const InputError& error) {
    throw InputError(std::string("--sound: ") + error.what());
  }
}

}  // namespace careen
