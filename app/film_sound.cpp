#include "film_sound.h"

#include <cstdint>
#include <vector>

#include "core/error.h"
#include "film/frame_range.h"
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
  const FrameRate& rate = run.stage.picture.rate;
  const double duration = run.stage.timeMap.within(run.settings.duration).duration();
  const std::vector<std::int64_t> frames = framesOf(settings.frames, rate.frameCount(duration));
  for (std::size_t k = 1; k < frames.size(); ++k) {
    if (frames[k] != frames[k - 1] + 1) {
      throw InputError("--sound: found frame " + std::to_string(frames[k]) + " after frame " +
                       std::to_string(frames[k - 1]) +
                       " in --frames, expected frames that follow each other");
    }
  }
  try {
    const double from = frames.empty() ? 0 : rate.frameTime(frames.front());
    const double to = frames.empty() ? 0 : rate.frameTime(frames.back() + 1);
    std::string wav = wavOf(soundTrackOf(run, from, to, keepsPitch ? Pitch::kStays : Pitch::kSlows, stop));
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
