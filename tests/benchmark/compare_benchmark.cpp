// Cost of comparing a pair of frames, 1280x720, from the bytes of their PNGs to all metrics but FLIP, and
// parts of it: frames that differ by grain (another processor), also by edges (another renderer), and
// completely.
//
// Measured (g++ 12 -O3, AMD EPYC), ms of one core, with malloc set as in app/main.cpp (GLIBC_TUNABLES=
// glibc.malloc.mmap_threshold=67108864:glibc.malloc.trim_threshold=67108864): comparing a pair: with
// grain 31.8, shifted 27.6, completely different 233, with a reader that took half of libpng's time; FLIP
// 314. On a busy machine: reading with libpng 13.1 and 13.4, libspng 15.0 and 15.8; folders of 31 frames,
// seconds of CPU: the same pixels .62 (idiff 23.6), shifted 1.48 (idiff 22.9).
#include <benchmark/benchmark.h>

#include <string>
#include <utility>

#include "compare/flip.h"
#include "compare/picture_difference.h"
#include "image/pictures.h"
#include "image/png.h"

namespace careen {
namespace {

using Pair = std::pair<std::string, std::string>;

std::string rendered() { return encodePng(readPng(CAREEN_SOURCE_DIR "/assets/pictures/careen.png")); }

Pair grainedPair() { return {encodePng(shadedTiles(1280, 720, 1)), encodePng(shadedTiles(1280, 720, 2))}; }
Pair shiftedPair() {
  Picture picture = readPng(CAREEN_SOURCE_DIR "/assets/pictures/careen.png");
  picture.rgb.insert(picture.rgb.begin(), 3, 0);
  picture.rgb.resize(picture.rgb.size() - 3);
  return {rendered(), encodePng(picture)};
}
Pair otherPair() { return {rendered(), encodePng(shadedTiles(1280, 720))}; }

void readDeepPng(benchmark::State& state, const std::string& bytes) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(decodeDeepPng(bytes, "frame.png"));
  }
}
BENCHMARK_CAPTURE(readDeepPng, rendered, rendered())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(readDeepPng, grained, grainedPair().first)->Unit(benchmark::kMillisecond);

void comparePair(benchmark::State& state, const Pair& pair) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        differenceOf(decodeDeepPng(pair.first, "one.png"), decodeDeepPng(pair.second, "other.png")));
  }
}
BENCHMARK_CAPTURE(comparePair, equal, Pair{rendered(), rendered()})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(comparePair, grained, grainedPair())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(comparePair, shifted, shiftedPair())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(comparePair, other, otherPair())->Unit(benchmark::kMillisecond);

void flipOfPair(benchmark::State& state, const Pair& pair) {
  const DeepPicture one = decodeDeepPng(pair.first, "one.png");
  const DeepPicture other = decodeDeepPng(pair.second, "other.png");
  for (auto _ : state) {
    benchmark::DoNotOptimize(flipOf(one, other));
  }
}
BENCHMARK_CAPTURE(flipOfPair, shifted, shiftedPair())->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace careen
