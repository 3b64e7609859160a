#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

namespace careen {

/// Four doubles at once. All operations are those of IEEE 754, each rounded by itself, so that a machine with
/// wide registers, one with narrow ones and scalar code give the same bits.
using Lanes = double __attribute__((vector_size(32), aligned(16)));
/// All bits of a lane set: chosen.
using LaneMask = std::int64_t __attribute__((vector_size(32), aligned(16)));
inline constexpr int kLanes = 4;
/// Four counts.
using LaneCounts = std::uint32_t __attribute__((vector_size(16)));

// All that takes or returns lanes is inlined, so that no calling convention matters.
#pragma GCC diagnostic ignored "-Wpsabi"

#define CAREEN_LANES [[gnu::always_inline]] inline

struct LanesVec {
  Lanes x, y, z;
};
struct LanesSymmetric {
  Lanes xx, yy, zz, xy, xz, yz;
};

/// Four doubles from there on.
CAREEN_LANES Lanes lanesFrom(const void* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
CAREEN_LANES void lanesTo(const Lanes& lanes, void* to) { std::memcpy(to, &lanes, sizeof lanes); }
CAREEN_LANES Lanes allOf(double value) { return Lanes{value, value, value, value}; }
/// Rows become columns.
CAREEN_LANES void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
}

CAREEN_LANES void setLane(LanesVec& v, int lane, double x, double y, double z) {
  v.x[lane] = x;
  v.y[lane] = y;
  v.z[lane] = z;
}
CAREEN_LANES LanesVec operator+(const LanesVec& a, const LanesVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
CAREEN_LANES LanesVec operator-(const LanesVec& a, const LanesVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
CAREEN_LANES LanesVec operator*(const Lanes& s, const LanesVec& v) { return {s * v.x, s * v.y, s * v.z}; }
CAREEN_LANES LanesVec operator*(const LanesSymmetric& m, const LanesVec& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
CAREEN_LANES LanesVec cross(const LanesVec& a, const LanesVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
CAREEN_LANES Lanes dot(const LanesVec& a, const LanesVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
CAREEN_LANES Lanes largerOf(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
CAREEN_LANES double largestOf(const Lanes& v) {
  const double first = v[0] > v[1] ? v[0] : v[1];
  const double last = v[2] > v[3] ? v[2] : v[3];
  return first > last ? first : last;
}
CAREEN_LANES double sumOf(const Lanes& v) { return (v[0] + v[1]) + (v[2] + v[3]); }
CAREEN_LANES Lanes absOf(const Lanes& v) { return v < 0 ? -v : v; }
/// |x| + |y| + |z|
CAREEN_LANES Lanes sumOfSizes(const LanesVec& v) { return absOf(v.x) + absOf(v.y) + absOf(v.z); }
CAREEN_LANES bool any(const LaneMask& mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }
CAREEN_LANES Lanes rootOf(const Lanes& v) {
  return Lanes{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}
CAREEN_LANES LaneCounts countsFrom(const std::uint32_t* from) {
  LaneCounts counts;
  std::memcpy(&counts, from, sizeof counts);
  return counts;
}
CAREEN_LANES void countsTo(const LaneCounts& counts, std::uint32_t* to) {
  std::memcpy(to, &counts, sizeof counts);
}
/// Of a comparison of counts.
CAREEN_LANES LaneMask maskOf(const std::int32_t __attribute__((vector_size(16))) & chosen) {
  return __builtin_convertvector(chosen, LaneMask);
}
CAREEN_LANES std::int64_t sumOf(const LaneMask& mask) { return mask[0] + mask[1] + mask[2] + mask[3]; }

/// Runs it with registers four lanes wide; `work` is a lambda that is inlined.
template <class Work>
#if defined(__x86_64__)
__attribute__((target("avx2")))
#endif
void runWide(const Work& work) {
  work();
}
/// How many numbers registers hold; the bits are the same.
enum class Registers : std::uint8_t { kNarrow, kWide };
inline Registers widestRegisters() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0 ? Registers::kWide : Registers::kNarrow;
#else
  return Registers::kNarrow;
#endif
}
/// The same in those registers, which the machine must have.
template <class Work>
void runInLanes(const Work& work, Registers registers = widestRegisters()) {
  if (registers == Registers::kWide) {
    runWide(work);
  } else {
    work();
  }
}

}  // namespace careen
