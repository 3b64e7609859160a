// What a frame's PNG costs and how large it is, beside stb's own writer on the same pixels: a rendered frame
// (assets/pictures/careen.png, 1280x720), and one as large with grain in a sixth of the pixels. Compare
// within one run: --benchmark_enable_random_interleaving=true --benchmark_repetitions=5, minimum of each.
//
// Measured (g++ 12 -O3, AMD EPYC), minimum of 3, ms and bytes, stb's: rendered 1.45, 213,930 (46.9, 271,842);
// grained 3.58, 412,248 (51.6, 427,854). With stb's filters and libdeflate, of another rendered frame that
// ours takes 1.17 and 151,812 for: 15.6, 150,082. Of the 1.17: 0.21 filter (0.46 without AVX2), 0.45 to find
// runs, 0.11 to count, 0.06 codes, 0.18 to send.
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
