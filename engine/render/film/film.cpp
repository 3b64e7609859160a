#include "render/film/film.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "core/system/processor.h"
#include "core/system/scratch_folder.h"
#include "film/folder.h"
#include "film/manifest.h"
#include "image/picture_ring.h"
#include "image/png.h"
#include "image/video_pipe.h"
#include "render/film/film_pictures.h"
#include "render/film/workers.h"

namespace careen {
namespace {

constexpr std::chrono::milliseconds kPatience(100);  // between checks of the stop token

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

std::string hashesOf(std::span<const Trajectory* const> runs) {
  std::string hashes;
  for (const Trajectory* const run : runs) {
    hashes.append(hashes.empty() ? "" : ",").append(run->stateHash());
  }
  return hashes;
}

FilmManifest manifestOf(const Trajectory& run, const FilmSettings& settings, const FilmPictures& pictures) {
  const PictureSettings picture = pictures.settings();
  const ShownBesides& besides = settings.besides;
  FilmManifest manifest{.program = settings.program,
                        .renderer = {},
                        .libraries = librariesHere(),
                        .sceneHash = run.sceneHash(),
                        .stateHash = run.stateHash(),
                        .shownAs = run.stage.shownAs,
                        .ghost = besides.ghost != nullptr ? besides.ghost->stateHash() : "",
                        .beside = hashesOf(besides.beside),
                        .plot = besides.plot ? std::string(nameOf(*besides.plot)) : "",
                        .picture = picture,
                        .frameCount = picture.rate.frameCount(pictures.duration()),
                        .frames = {},
                        .hashes = {}};
  manifest.frames = framesOf(settings.frames, manifest.frameCount);
  return manifest;
}

void refuseIf(const std::string& difference, const std::filesystem::path& folder, FilmThere there) {
  if (!difference.empty() && there != FilmThere::kReplace) {
    throw InputError(folder.string() + ": the film there is another one, " +
                     (there == FilmThere::kResume ? "it cannot be resumed: "
                                                  : "name another folder, or --overwrite to replace it: ") +
                     difference);
  }
}

void refuseAnotherFilm(const FilmFolder& folder, const FilmManifest& asked, FilmThere there) {
  refuseIf(folder.manifest() ? differenceOf(*folder.manifest(), asked) : "", folder.path(), there);
}

int jobCount(const FilmSettings& settings, std::size_t framesToDraw) {
  const int jobs = settings.jobs.value_or(std::min(usableCores(), kMostJobs));
  if (jobs < 1 || jobs > kMostJobs) {
    throw InputError("jobs: found " + std::to_string(jobs) + ", expected 1 to " + std::to_string(kMostJobs));
  }
  return static_cast<int>(std::min(static_cast<std::size_t>(jobs), framesToDraw));
}

// A job with one core is fastest without threads.
RenderOptions optionsOfJob(const FilmSettings& settings, int jobs) {
  RenderOptions options = settings.render;
  if (!options.context.threads) {
    const int cores = usableCores() / jobs;
    options.context.threads = cores > 1 ? std::min(cores, kMostThreads) : 0;
  }
  return options;
}

std::size_t bytesOf(const PictureSettings& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
         (picture.alpha ? 4 : 3);
}

// As a video takes them.
std::vector<std::uint8_t> pixelsOf(Picture picture) {
  return picture.alpha.empty() ? std::move(picture.rgb) : rgbaOf(picture);
}

std::unique_ptr<VideoPipe> startVideo(const FilmSettings& settings, const PictureSettings& picture) {
  if (!settings.video) {
    return nullptr;
  }
  VideoSettings video = *settings.video;
  video.width = picture.width;
  video.height = picture.height;
  video.rateNumerator = picture.rate.numerator;
  video.rateDenominator = picture.rate.denominator;
  video.alpha = picture.alpha;
  return std::make_unique<VideoPipe>(std::move(video));
}

// Sets up a job in its own process. The ring has slots if there is a video.
FrameWorkshop openWorkshop(FilmPictures& pictures, const FilmSettings& settings,
                           const std::vector<std::int64_t>& frames, int jobs, const PictureRing& ring) {
  if (glWasOpened()) {  // otherwise it would wait for threads that were not forked
    throw MachineError("no job can draw: GL had been opened before it was forked");
  }
  pictures.open(optionsOfJob(settings, jobs));
  const auto work = [&pictures, &settings, &frames, &ring, rate = pictures.settings().rate](
                        std::int64_t index, std::int64_t frame) {
    if (index < 0 || index >= std::ssize(frames) || frames[static_cast<std::size_t>(index)] != frame) {
      throw MachineError("a job was asked for frame " + std::to_string(frame) + ", which nobody ordered");
    }
    FrameFigures figures{.frame = frame, .time = rate.frameTime(frame)};
    const DrawFigures before = pictures.figures();
    Picture picture = pictures.draw(figures.time);
    const DrawFigures after = pictures.figures();
    figures.drawSeconds = after.drawSeconds - before.drawSeconds;
    figures.readSeconds = after.readSeconds - before.readSeconds;
    const double begun = wallSeconds();
    const std::string bytes = encodePng(picture);
    if (ring.places() > 0) {
      const std::vector<std::uint8_t> pixels = pixelsOf(std::move(picture));
      std::copy(pixels.begin(), pixels.end(), ring[index].begin());
    }
    writeFile(settings.folder / frameFileName(frame), bytes);
    frameHash(bytes).copy(figures.hash.data(), figures.hash.size());
    figures.encodeSeconds = wallSeconds() - begun;
    return figures;
  };
  return {.renderer = pictures.rendererName(), .work = work};
}

/// Gives frames to idle workers; they finish in any order. A video needs them in frame order: the ring
/// buffers those that are early, and no frame is started without a free slot.
class FrameFlow {
 public:
  FrameFlow(const FilmFolder& folder, const std::vector<std::int64_t>& asked,
            const std::vector<std::int64_t>& missing, FilmWorkers& workers, const PictureRing& ring,
            VideoPipe* video)
      : folder_(folder), asked_(asked), workers_(workers), ring_(ring), video_(video) {
    for (const std::int64_t frame : asked) {
      written_.push_back(!std::binary_search(missing.begin(), missing.end(), frame));
    }
    old_ = written_;
    toDraw_ = std::ssize(missing);
    figures_.skipped = total() - toDraw_;
  }

  FilmFigures film(const FilmCallback& progress, const std::stop_token& stop) {
    begun_ = wallSeconds();
    while (figures_.drawn < toDraw_ || (video_ != nullptr && shown_ < total())) {
      if (stop.stop_requested()) {
        throw Interrupted();
      }
      giveOut();
      const bool shows = video_ != nullptr && shown_ < next_ && written_[place(shown_)];
      for (const FilmWorkers::Done& done : workers_.wait(shows ? video_->descriptor() : -1, kPatience)) {
        written_[place(done.index)] = true;
        hashes_[done.figures.frame] = std::string(done.figures.hash.begin(), done.figures.hash.end());
        count(done.figures);
        if (progress) {
          progress(progressNow(done.figures));
        }
      }
      if (shows) {
        show();
      }
    }
    return figures_;
  }

  /// Of the frames drawn so far.
  const std::map<std::int64_t, std::string>& hashes() const { return hashes_; }

 private:
  static std::size_t place(std::int64_t index) { return static_cast<std::size_t>(index); }
  std::int64_t total() const { return std::ssize(asked_); }

  void giveOut() {
    while (next_ < total() && (video_ == nullptr || next_ < shown_ + ring_.places())) {
      if (!old_[place(next_)]) {
        if (!workers_.hasIdle()) {
          return;
        }
        workers_.give(next_, asked_[place(next_)]);
      }
      ++next_;
    }
  }

  // Writes as much of the next frame as ffmpeg accepts now.
  void show() {
    std::span<const std::uint8_t> pixels;
    if (old_[place(shown_)]) {
      if (sent_ == 0) {
        oldPixels_ = pixelsOf(readPng(folder_.path() / frameFileName(asked_[place(shown_)])));
      }
      pixels = oldPixels_;
    } else {
      pixels = ring_[shown_];
    }
    sent_ += video_->write(pixels.subspan(sent_));
    if (sent_ == pixels.size()) {
      sent_ = 0;
      ++shown_;
    }
  }

  void count(const FrameFigures& frame) {
    ++figures_.drawn;
    figures_.drawSeconds += frame.drawSeconds;
    figures_.readSeconds += frame.readSeconds;
    figures_.encodeSeconds += frame.encodeSeconds;
  }

  FilmProgress progressNow(const FrameFigures& frame) const {
    FilmProgress progress{.done = figures_.drawn + figures_.skipped, .total = total(), .frame = frame};
    const double seconds = wallSeconds() - begun_;
    if (seconds > 0) {
      progress.framesPerSecond = static_cast<double>(figures_.drawn) / seconds;
      progress.secondsLeft = static_cast<double>(toDraw_ - figures_.drawn) / progress.framesPerSecond;
    }
    return progress;
  }

  const FilmFolder& folder_;
  const std::vector<std::int64_t>& asked_;
  FilmWorkers& workers_;
  const PictureRing& ring_;
  VideoPipe* video_;
  std::vector<bool> written_;  // requested frames, by index
  std::vector<bool> old_;      // existed before
  std::int64_t toDraw_ = 0;
  std::int64_t next_ = 0;   // next index to assign
  std::int64_t shown_ = 0;  // frames completely written to the video
  std::size_t sent_ = 0;    // [bytes] of the frame after those
  std::vector<std::uint8_t> oldPixels_;
  double begun_ = 0;  // [s]
  FilmFigures figures_;
  std::map<std::int64_t, std::string> hashes_;
};

// For who resumes the film. What stopped it may keep this from being written, too.
void keepHashes(FilmFolder& folder, const FrameFlow& flow) {
  try {
    folder.keep(flow.hashes());
  } catch (const std::exception&) {  // the frames are there; only their hashes are not
  }
}

}  // namespace

void refuseFilmOfAnotherScene(const FilmSettings& settings, std::string_view sceneText) {
  const std::optional<FilmManifest> there = readManifest(settings.folder);
  Hash hash;
  hash.add(sceneText);
  refuseIf(there && there->sceneHash != hash.text() ? "another scene" : "", settings.folder, settings.there);
}

FilmFigures renderFilm(const Trajectory& run, const FilmSettings& settings, const FilmCallback& progress,
                       const std::stop_token& stop) {
  const double wallBegun = wallSeconds();
  const double coreBegun = coreSeconds();
  FilmPictures pictures(run, settings.besides);
  const PictureSettings picture = pictures.settings();
  FilmManifest asked = manifestOf(run, settings, pictures);
  pictures.first().checkCamera(asked.frames, picture.rate);
  FilmFolder folder(settings.folder);
  refuseAnotherFilm(folder, asked, settings.there);
  const std::vector<std::int64_t> missing =
      settings.there == FilmThere::kResume ? folder.missing(asked) : asked.frames;

  // Everything that may fail comes before the existing film is changed. Existing frames need no GL.
  if (!missing.empty()) {
    pictures.makeOverlays();
  }
  const int jobs = jobCount(settings, missing.size());
  const PictureRing ring(settings.video ? jobs + 2 : 0, bytesOf(picture));
  FilmWorkers workers(jobs, [&] { return openWorkshop(pictures, settings, asked.frames, jobs, ring); });
  asked.renderer = workers.renderer();
  refuseAnotherFilm(folder, asked, settings.there);
  const std::unique_ptr<VideoPipe> video =
      startVideo(settings, picture);  // after forking the workers, so they do not inherit its pipe
  folder.begin(asked, settings.there != FilmThere::kReplace);

  FrameFlow flow(folder, asked.frames, missing, workers, ring, video.get());
  FilmFigures figures;
  try {
    figures = flow.film(progress, stop);
  } catch (...) {
    keepHashes(folder, flow);
    throw;
  }
  folder.keep(flow.hashes());
  const double coreOfWorkers = workers.finish();
  if (video) {
    video->finish();
  }
  figures.jobs = jobs;
  figures.picture = picture;
  figures.renderer = asked.renderer;
  figures.wallSeconds = wallSeconds() - wallBegun;
  figures.coreSeconds = coreSeconds() - coreBegun + coreOfWorkers;
  return figures;
}

std::string filmAsMp4(const Trajectory& run, FilmSettings settings, const FilmCallback& progress,
                      const std::stop_token& stop) {
  const ScratchFolder scratch;
  settings.folder = scratch.path() / "frames";
  VideoSettings video = settings.video.value_or(VideoSettings());
  video.path = scratch.path() / "film.mp4";
  settings.video = std::move(video);
  renderFilm(run, settings, progress, stop);
  return readFile(settings.video->path);
}

}  // namespace careen
