// Frames of a film by renderFilm, compared with the same frames drawn sequentially and written by stb: ten
// boxes, 1280x720, 60 frames. Compare within one run: --benchmark_filter=Film --benchmark_repetitions=5,
// minimum of each.
//
// GL is opened in forked processes only, because a film's jobs must be forked from a process without GL.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/system/file.h"
#include "core/system/worker.h"
#include "image/png.h"
#include "render/film/film.h"
#include "render/stage.h"
#include "support/process.h"

namespace careen {
namespace {

constexpr int kBoxes = 10;

Scene scene() {
  Scene scene = crateInRoom();
  scene.settings.duration = 2;
  for (int i = 1; i < kBoxes; ++i) {
    scene.boxes.push_back(boxAt(Vec3(-2.5 + 0.5 * i, -0.5 + 0.25 * (i % 5), 0.4 + 0.15 * i),
                                Vec3(0.2, 0.15, 0.1), Color{60, 90, 200}));
  }
  return scene;
}

Trajectory driftingAll(const Scene& scene) {
  Trajectory run = drifting(scene, Vec3(0.3, 0.1, 0.2));
  for (std::size_t i = 1; i < scene.boxes.size(); ++i) {
    run.tracks.push_back(run.tracks[0]);
    std::get<EulerStep>(run.tracks[i].segments.open()[0].motion).start.pose = scene.boxes[i].pose;
  }
  return run;
}

FilmSettings settingsIn(const TemporaryFolder& folder, std::int64_t jobs) {
  FilmSettings settings;
  settings.folder = folder / "film";
  if (jobs > 0) {
    settings.jobs = static_cast<int>(jobs);
  }
  return settings;
}

// [s] CPU time, forked processes included.
double coreSeconds() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
  }
  return seconds;
}

// Argument: jobs, 0 for one per core.
void Film(benchmark::State& state) {
  const Scene drawn = scene();
  const Trajectory run = driftingAll(drawn);
  double frames = 0;
  const double begun = coreSeconds();
  for (auto _ : state) {
    const TemporaryFolder folder;
    frames += static_cast<double>(renderFilm(run, settingsIn(folder, state.range(0))).drawn);
  }
  state.counters["frames/s"] = benchmark::Counter(frames, benchmark::Counter::kIsRate);
  state.counters["core ms/frame"] = 1e3 * (coreSeconds() - begun) / frames;
}
BENCHMARK(Film)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

void writeByStb(const std::filesystem::path& path, const Picture& picture) {
  if (stbi_write_png(path.c_str(), picture.width, picture.height, 3, picture.rgb.data(), 0) == 0) {
    throw std::runtime_error("no picture");
  }
}

struct Took {
  double frames = 0;
  double coreSeconds = 0;  // drawing and writing alone
};

// Arguments: threads of Mesa, −1 for its default; whether stb writes.
void FilmInTurn(benchmark::State& state) {
  const Scene drawn = scene();
  const Trajectory run = driftingAll(drawn);
  Took all;
  for (auto _ : state) {
    const TemporaryFolder folder;
    const Worker worker([&](const Channel& channel) {
      RenderOptions options;
      if (state.range(0) >= 0) {
        options.context.threads = static_cast<int>(state.range(0));
      }
      Renderer renderer(setupOf(drawn, 1280, 720), options);
      const FrameRate rate;
      Took took;
      renderer.draw(run.poses(0));  // the first frame compiles its code
      const double begun = coreSeconds();
      for (; took.frames < static_cast<double>(rate.frameCount(drawn.settings.duration)); ++took.frames) {
        const auto frame = static_cast<std::int64_t>(took.frames);
        const Picture picture = renderer.draw(run.poses(rate.frameTime(frame)));
        const std::filesystem::path path = folder / (std::to_string(frame) + ".png");
        if (state.range(1) != 0) {
          writeByStb(path, picture);
        } else {
          writePng(path, picture);
        }
      }
      took.coreSeconds = coreSeconds() - begun;
      channel.send(took);
    });
    Took took;
    worker.channel().receive(took);
    all.frames += took.frames;
    all.coreSeconds += took.coreSeconds;
  }
  state.counters["frames/s"] = benchmark::Counter(all.frames, benchmark::Counter::kIsRate);
  state.counters["core ms/frame"] = 1e3 * all.coreSeconds / all.frames;
}
BENCHMARK(FilmInTurn)
    ->ArgNames({"threads", "stb"})
    ->Args({0, 0})
    ->Args({0, 1})
    ->Args({-1, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace careen
