// What a frame's PNG costs and how large it is, beside stb's own writer on the same pixels: a rendered frame
// (assets/pictures/careen.png, 1280x720), and one of the same size with grain in every seventh pixel. Compare
// within one run: --benchmark_enable_random_interleaving=true --benchmark_repetitions=5, minimum of each.
//
// Measured (g++ 12 -O3, AMD EPYC), ms and bytes, stb's: rendered 15.6, 150,082 (44.6, 181,884); grained 14.7,
// 329,537 (53.8, 427,854).
#include <benchmark/benchmark.h>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <cstdlib>
#include <string>

#include "image/pictures.h"
#include "image/png.h"

namespace careen {
namespace {

Picture rendered() { return readPng(CAREEN_SOURCE_DIR "/assets/pictures/careen.png"); }
Picture grained() { return shadedTiles(1280, 720); }

void writePng(benchmark::State& state, const Picture& picture) {
  std::string bytes;
  for (auto _ : state) {
    bytes = encodePng(picture);
    benchmark::DoNotOptimize(bytes.data());
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
}
BENCHMARK_CAPTURE(writePng, rendered, rendered())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(writePng, grained, grained())->Unit(benchmark::kMillisecond);

void writePngByStb(benchmark::State& state, const Picture& picture) {
  int size = 0;
  for (auto _ : state) {
    unsigned char* bytes =
        stbi_write_png_to_mem(picture.rgb.data(), 0, picture.width, picture.height, 3, &size);
    benchmark::DoNotOptimize(bytes);
    std::free(bytes);
  }
  state.counters["bytes"] = size;
}
BENCHMARK_CAPTURE(writePngByStb, rendered, rendered())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(writePngByStb, grained, grained())->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace careen
