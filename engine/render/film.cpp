#include "render/film.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "core/error.h"
#include "image/frame_writer.h"
#include "image/video_pipe.h"
#include "render/film_folder.h"
#include "render/film_manifest.h"
#include "render/filming.h"
#include "render/overlays.h"
#include "render/renderer.h"

namespace careen {
namespace {

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double coreSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

FilmManifest manifestOf(const Trajectory& trajectory, const FilmSettings& settings, double duration) {
  FilmManifest manifest{.sceneHash = trajectory.sceneHash(),
                        .stateHash = trajectory.stateHash(),
                        .width = settings.width,
                        .height = settings.height,
                        .rate = settings.rate,
                        .shutter = settings.shutter.text(),
                        .overlays = settings.overlays.text(),
                        .frameCount = settings.rate.frameCount(duration),
                        .frames = {}};
  manifest.frames = framesOf(settings.frames, manifest.frameCount);
  return manifest;
}

void refuseAnotherFilm(const FilmFolder& folder, const FilmManifest& asked) {
  const std::string difference = folder.manifest() ? differenceOf(*folder.manifest(), asked) : "";
  if (!difference.empty()) {
    throw InputError(folder.path().string() +
                     ": the film there is another one, it cannot be resumed: " + difference);
  }
}

std::unique_ptr<VideoPipe> startVideo(const FilmSettings& settings) {
  if (!settings.video) {
    return nullptr;
  }
  return std::make_unique<VideoPipe>(VideoSettings{.path = *settings.video,
                                                   .width = settings.width,
                                                   .height = settings.height,
                                                   .rateNumerator = settings.rate.numerator,
                                                   .rateDenominator = settings.rate.denominator});
}

FilmProgress progressOf(const FilmFigures& figures, const FilmManifest& asked, std::int64_t toDraw,
                        double seconds) {
  FilmProgress progress{.done = figures.drawn + figures.skipped, .total = std::ssize(asked.frames)};
  if (figures.drawn > 0 && seconds > 0) {
    progress.framesPerSecond = static_cast<double>(figures.drawn) / seconds;
    progress.secondsLeft = static_cast<double>(toDraw - figures.drawn) / progress.framesPerSecond;
  }
  return progress;
}

}  // namespace

FilmFigures renderFilm(const Trajectory& trajectory, const Scene& scene, const FilmSettings& settings,
                       const FilmCallback& progress, const std::stop_token& stop) {
  const double wallBegun = wallSeconds();
  const double coreBegun = coreSeconds();
  const Filming filming(scene, trajectory, static_cast<double>(settings.width) / settings.height);
  const FilmManifest asked = manifestOf(trajectory, settings, filming.duration());
  filming.checkCamera(asked.frames, settings.rate);
  FilmFolder folder(settings.folder);
  if (settings.resume) {
    refuseAnotherFilm(folder, asked);
  }
  const std::vector<std::int64_t> missing = settings.resume ? folder.missing(asked) : asked.frames;

  // All that may fail comes before the film that is there is touched. What is there already needs no GL.
  std::unique_ptr<Renderer> renderer;
  std::optional<Overlays> overlays;
  if (!missing.empty()) {
    if (settings.overlays.any()) {
      overlays.emplace(trajectory, scene, settings.overlays, settings.rate.frameTime(1));
    }
    RenderOptions options = settings.render;
    options.camera = filming.camera(0);
    renderer = std::make_unique<Renderer>(scene, settings.width, settings.height, options);
  }
  std::unique_ptr<VideoPipe> video = startVideo(settings);
  folder.begin(asked, settings.resume);

  FilmFigures figures;
  const double drawBegun = wallSeconds();
  FrameWriter writer(folder.path(), std::move(video));
  for (const std::int64_t frame : asked.frames) {
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    if (std::binary_search(missing.begin(), missing.end(), frame)) {
      const double time = settings.rate.frameTime(frame);
      Picture picture = filming.draw(*renderer, time, settings.shutter, settings.rate);
      if (overlays) {
        renderer->drawOver(picture, filming.camera(time), [&](const View& view) {
          return overlays->shapesAt(filming.sceneTime(time), view, settings.width, settings.height);
        });
      }
      writer.push(frame, std::move(picture));
      ++figures.drawn;
    } else {
      writer.pushWritten(frame);
      ++figures.skipped;
    }
    if (progress) {
      progress(progressOf(figures, asked, std::ssize(missing), wallSeconds() - drawBegun));
    }
  }
  writer.finish();

  if (renderer) {
    figures.drawSeconds = renderer->figures().drawSeconds;
    figures.readSeconds = renderer->figures().readSeconds;
    figures.renderer = renderer->rendererName();
  }
  figures.encodeSeconds = writer.coreSeconds();
  figures.wallSeconds = wallSeconds() - wallBegun;
  figures.coreSeconds = coreSeconds() - coreBegun;
  return figures;
}

}  // namespace careen
