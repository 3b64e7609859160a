// The pictures and films of a run.
#include <algorithm>
#include <mutex>
#include <utility>

#include "core/error.h"
#include "core/math/arithmetic.h"
#include "core/system/file.h"
#include "core/system/processor.h"
#include "core/system/shared_work.h"
#include "film/frame_range.h"
#include "library/careen.h"
#include "library/run_data.h"
#include "library/translated.h"
#include "truth/truth_film.h"
#include "truth/truth_frame.h"
#ifdef CAREEN_RENDER
#include "image/video_format.h"
#include "page/run_page.h"
#include "render/film/film.h"
#include "render/film/film_pictures.h"
#include "sound/sound_track.h"
#endif

namespace careen::v1 {

namespace {

// Of the process: GL is current to one thread at a time, and the size of a run's pictures stands in the run.
std::mutex& drawing() {
  static std::mutex mutex;
  return mutex;
}

// Sets size and alpha for as long as it lives.
class ShownAs {
 public:
  ShownAs(PictureSettings& picture, const std::optional<std::array<int, 2>>& size, bool alpha = false)
      : picture_(picture), before_(picture) {
    picture_.alpha = alpha;
    if (!size) {
      return;
    }
    for (const int side : *size) {
      if (side < 1 || side > kLargestFilm) {
        throw Error("found a picture of " + std::to_string((*size)[0]) + "x" + std::to_string((*size)[1]) +
                    ", expected 1 to " + std::to_string(kLargestFilm) + " px each");
      }
    }
    picture_.width = (*size)[0];
    picture_.height = (*size)[1];
  }
  ~ShownAs() { picture_ = before_; }
  ShownAs(const ShownAs&) = delete;
  ShownAs& operator=(const ShownAs&) = delete;

 private:
  PictureSettings& picture_;
  PictureSettings before_;
};

}  // namespace

#ifdef CAREEN_RENDER
std::vector<Image> Run::frames(const std::vector<double>& filmTimes,
                               std::optional<std::array<int, 2>> size) const {
  const std::scoped_lock alone(drawing());
  const DefaultFloatEnvironment usual;
  return translated("", [&] {
    Trajectory& run = data_->trajectory;
    const ShownAs shown(run.stage.picture, size);
    FilmPictures pictures(run);
    const double duration = pictures.duration();
    for (const double time : filmTimes) {
      if (!(time >= 0 && time <= duration)) {
        throw Error("found the moment " + std::to_string(time) + " s, expected one of the film, from 0 to " +
                    std::to_string(duration) + " s");
      }
    }
    pictures.makeOverlays();
    pictures.open({});
    std::vector<Image> images;
    for (const double time : filmTimes) {
      Picture drawn = pictures.draw(time);
      images.push_back({.width = drawn.width, .height = drawn.height, .rgb = std::move(drawn.rgb)});
    }
    return images;
  });
}

void Run::film(const Film& film) const {
  const std::scoped_lock alone(drawing());
  const DefaultFloatEnvironment usual;
  translated("", [&] {
    Trajectory& run = data_->trajectory;
    const ShownAs shown(run.stage.picture, film.size, film.alpha);
    FilmSettings settings;
    settings.folder = film.folder;
    settings.frames = film.frames.empty() ? std::vector<FrameRange>() : parseFrameRanges(film.frames);
    if (!film.video.empty()) {
      settings.video =
          VideoSettings{.path = film.video, .quality = videoQualityNamed(film.quality), .alpha = film.alpha};
    }
    settings.there = film.replace ? FilmThere::kReplace : FilmThere::kDrawAgain;
    settings.jobs = film.jobs;
    settings.program = version();
    const std::string sound = film.sound ? wavOf(soundTrackOf(run, settings.frames, Pitch::kSlows)) : "";
    if (settings.video) {
      settings.video->sound = sound;
      checkVideo(*settings.video);
    }
    renderFilm(run, settings);
    if (film.sound) {
      writeFile(film.folder / "sound.wav", sound);
    }
  });
}

void Run::page(const Page& page) const {
  const std::scoped_lock alone(drawing());
  const DefaultFloatEnvironment usual;
  translated("", [&] {
    const careen::Run& run = data_->audited();
    const ShownAs shown(data_->trajectory.stage.picture, page.size);
    FilmSettings settings;
    settings.program = version();
    settings.video = VideoSettings{.path = "film.mp4", .quality = videoQualityNamed(page.quality)};
    if (page.sound) {
      settings.video->sound = wavOf(soundTrackOf(run.trajectory, {}, Pitch::kSlows));
    }
    const PageFilm film{.bytes = filmAsMp4(run.trajectory, settings), .type = "video/mp4"};
    writeFile(page.path, runPage(run.trajectory, run.audit, film, version()));
  });
}
#else
std::vector<Image> Run::frames(const std::vector<double>& /*filmTimes*/,
                               std::optional<std::array<int, 2>> /*size*/) const {
  throw Error("this build of careen draws nothing (CAREEN_RENDER=OFF)");
}

void Run::film(const Film& /*film*/) const {
  throw Error("this build of careen draws nothing (CAREEN_RENDER=OFF)");
}

void Run::page(const Page& /*page*/) const {
  throw Error("this build of careen draws nothing (CAREEN_RENDER=OFF)");
}
#endif

void Run::labels(const Labels& labels) const {
  const std::scoped_lock alone(drawing());
  const DefaultFloatEnvironment usual;
  translated("", [&] {
    Trajectory& run = data_->trajectory;
    const ShownAs shown(run.stage.picture, labels.size);
    const TruthSettings settings{
        .folder = labels.folder,
        .frames = labels.frames.empty() ? std::vector<FrameRange>() : parseFrameRanges(labels.frames),
        .channels = channelsNamed(labels.channels),
        .jobs = std::clamp(labels.jobs.value_or(usableCores()), 1, kMostProcesses),
        .program = version()};
    writeTruth(run, settings);
  });
}

Image Run::frame(double filmTime, std::optional<std::array<int, 2>> size) const {
  return frames({filmTime}, size).front();
}

}  // namespace careen::v1
