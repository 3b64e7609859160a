#pragma once

#include <cstdint>

#include "core/math/linear_algebra.h"

namespace careen {

/// Pseudorandom numbers that depend on three numbers alone: the same on every machine, in any order of the
/// runs. SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
/// 2014), started at a hash of the three.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t run, std::uint64_t attempt);

  std::uint64_t bits();
  double unit();  ///< uniform in [0, 1), a multiple of 2⁻⁵³
  double uniform(double from, double to);
  std::int64_t integer(std::int64_t from, std::int64_t to);  ///< both included
  double normal();   ///< of mean 0 and standard deviation 1, by Box and Muller
  Vec3 direction();  ///< of length 1, uniform on the sphere
  Quat rotation();   ///< uniform over all rotations

 private:
  std::uint64_t state_;
};

}  // namespace careen
