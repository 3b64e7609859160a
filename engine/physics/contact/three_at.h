#pragma once

#include <cstddef>
#include <span>

#include "core/math/linear_algebra.h"
#include "physics/solver/contact_problem.h"

namespace careen {

// Vectors and quaternions within the long ones of equations: three numbers from `at` on, or four, w first.

inline constexpr std::size_t kSix = ContactProblem::kAxes;

inline Vec3 threeAt(std::span<const double> y, std::size_t at) { return {y[at], y[at + 1], y[at + 2]}; }

inline void setThree(std::span<double> y, std::size_t at, const Vec3& v) {
  y[at] = v[0];
  y[at + 1] = v[1];
  y[at + 2] = v[2];
}

inline Quat quatAt(std::span<const double> y, std::size_t at) {
  return {y[at], y[at + 1], y[at + 2], y[at + 3]};
}

inline void setQuat(std::span<double> y, std::size_t at, const Quat& q) {
  y[at] = q.w();
  y[at + 1] = q.x();
  y[at + 2] = q.y();
  y[at + 3] = q.z();
}

}  // namespace careen
