#include "sweep/random_stream.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/elementary.h"

namespace careen {
namespace {

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}
constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15U;

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t run, std::uint64_t attempt)
    : state_(mixed(mixed(mixed(seed + kGamma) ^ (run + 1) * kGamma) + (attempt + 1) * kGamma)) {}

std::uint64_t RandomStream::bits() {
  state_ += kGamma;
  return mixed(state_);
}

double RandomStream::unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

double RandomStream::uniform(double from, double to) {
  return std::clamp(from + unit() * (to - from), from, to);
}

std::int64_t RandomStream::integer(std::int64_t from, std::int64_t to) {
  // By rejection, so that no number is likelier. `to − from` is below 2³².
  const auto count = static_cast<std::uint64_t>(to - from) + 1;
  const std::uint64_t limit = ~std::uint64_t{0} / count * count;
  std::uint64_t drawn = bits();
  while (drawn >= limit) {
    drawn = bits();
  }
  return from + static_cast<std::int64_t>(drawn % count);
}

double RandomStream::normal() {
  const double radius = std::sqrt(-2 * elementary::log(1 - unit()));
  return radius * elementary::sinCos(2 * std::numbers::pi * unit()).cos;
}

Vec3 RandomStream::direction() {
  const double height = 2 * unit() - 1;
  const elementary::SinCos<double> turn = elementary::sinCos(2 * std::numbers::pi * unit());
  const double radius = std::sqrt(std::max(0.0, 1 - height * height));
  return {radius * turn.cos, radius * turn.sin, height};
}

Quat RandomStream::rotation() {
  // K. Shoemake, "Uniform random rotations", Graphics Gems III, 1992.
  const double part = unit();
  const elementary::SinCos<double> one = elementary::sinCos(2 * std::numbers::pi * unit());
  const elementary::SinCos<double> other = elementary::sinCos(2 * std::numbers::pi * unit());
  const double a = std::sqrt(1 - part);
  const double b = std::sqrt(part);
  return {b * other.cos, a * one.sin, a * one.cos, b * other.sin};
}

}  // namespace careen
