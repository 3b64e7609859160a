// Cost and size of a frame's PNG, compared with stb's writer on the same pixels: a rendered frame
// (assets/pictures/careen.png, 1280x720), and one of that size with grain in a sixth of the pixels. Compare
// within one run: --benchmark_enable_random_interleaving=true --benchmark_repetitions=5, minimum of each.
//
// Measured (g++ 12 -O3, AMD EPYC), minimum of 3, in ms and bytes (stb's in parentheses): rendered 1.45,
// 213,930 (46.9, 271,842); with grain 3.58, 412,248 (51.6, 427,854). Another rendered frame: ours 1.17,
// 151,812; stb's filters and libdeflate 15.6, 150,082. Of the 1.17: 0.21 filters (0.46 without AVX2), 0.45
// finding runs, 0.11 counting, 0.06 codes, 0.18 output.
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
