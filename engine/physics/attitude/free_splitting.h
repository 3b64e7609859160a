#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/math/elementary.h"
#include "physics/attitude/middle_axis_frame.h"

namespace careen {

namespace detail {

/// Skips range reduction for small angles: a step should not rotate a body far.
template <class Real>
elementary::SinCos<Real> sinCosOfStep(const Real& angle) {
  using std::abs;
  return abs(angle) < 0.75 ? elementary::sinCosQuarterTurns(Real(0), angle) : elementary::sinCos(angle);
}

/// The exact flow of ½ α m₁², a steady rotation of the body about axis 1: m rotates the other way in the
/// plane of axes 2 and 3, and (w, v₁), (v₂, v₃) of the quaternion rotate by half the angle. Axes 1, 2, 3 are
/// in right-handed order; halfTime is α t/2.
template <class Real>
void turn(const Real& halfTime, const Real& m1, Real& m2, Real& m3, Real& w, Real& v1, Real& v2, Real& v3) {
  const auto [sin, cos] = sinCosOfStep(Real(halfTime * m1));
  const Real twiceSin = 2 * sin;
  const Real cosWhole = 1 - twiceSin * sin;
  const Real sinWhole = twiceSin * cos;
  const Real m2Before = m2;
  m2 = m2Before * cosWhole + m3 * sinWhole;
  m3 = m3 * cosWhole - m2Before * sinWhole;
  const Real wBefore = w;
  w = wBefore * cos - v1 * sin;
  v1 = v1 * cos + wBefore * sin;
  const Real v2Before = v2;
  v2 = v2Before * cos + v3 * sin;
  v3 = v3 * cos - v2Before * sin;
}

/// Steps of rotations by the fractions aboutX[0], aboutY[0], aboutX[1], … aboutY[last], aboutX[0] of dt; the
/// last rotation of a step and the first of the next are merged.
template <class Real, std::size_t kTurns>
void compose(typename MiddleAxisFrame<Real>::X which, const std::array<double, kTurns>& aboutX,
             const std::array<double, kTurns>& aboutY, const Vector3<Real>& inertia, FreeState<Real>& state,
             const Real& dt, std::int64_t count) {
  const MiddleAxisFrame<Real> frame(inertia, which);
  MiddleAxisState<Real> s(frame, state);
  const Real halfX = dt * frame.alphaX / 2;
  const Real halfY = dt * frame.alphaY / 2;
  const auto turnX = [&](const Real& part) {
    turn<Real>(part * halfX, s.mx, s.my, s.mz, s.w, s.x, s.y, s.z);
  };
  const auto turnY = [&](const Real& part) {
    turn<Real>(part * halfY, s.my, s.mz, s.mx, s.w, s.y, s.z, s.x);
  };
  if (count > 0) {
    turnX(aboutX[0]);
  }
  for (std::int64_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k + 1 < kTurns; ++k) {
      turnY(aboutY[k]);
      turnX(aboutX[k + 1]);
    }
    turnY(aboutY[kTurns - 1]);
    turnX(i + 1 < count ? 2 * aboutX[0] : aboutX[0]);
  }
  state = s.restored(frame, Real(dt * static_cast<double>(count)));
}

}  // namespace detail

/// Strang splitting into rotations about two body axes: half a step about a, one about c, half about a.
///
/// The split Hamiltonian is not the whole energy but what middle_axis_frame.h leaves of it, two squares
/// instead of three, the larger rate in the half steps (the other way round: errors 1 to 3 times as large).
/// Not used: splitting ½ Σ m²/I into its three rotations, which takes four rotations and sines per step
/// instead of two and has 0.6 to 90 times the error, depending on the order of the three (measured at 1/60
/// s).
///
/// Order 2 in attitude and energy. Conserved to rounding: |m| and the momentum in the world. The energy is
/// not conserved but its error stays O(h²) for all time. Symmetric: steps of −dt lead back.
///
/// Sources: G. Strang, SIAM J. Numer. Anal. 5, 1968; R. I. McLachlan, Phys. Rev. Lett. 71, 1993, and S.
/// Reich, Physica D 76, 1994 (three rotations); J. Touma & J. Wisdom, Astron. J. 107, 1994, and F. Fassò, J.
/// Comput. Phys. 189, 2003 (a symmetric top and one rotation).
template <class Real>
void strangSteps(const Vector3<Real>& inertia, FreeState<Real>& state, const Real& dt, std::int64_t count) {
  detail::compose<Real, 1>(MiddleAxisFrame<Real>::X::kLargerRate, {0.5}, {1}, inertia, state, dt, count);
}

/// The same two rotations, 10 times each per step, to order 6.
///
/// Blanes and Moan's coefficients, with the smaller rate in the rotations that begin and end the step (the
/// other way round: errors 2 to 10 times as large). At equal cost errors are 25 to 200 times smaller than
/// with Kahan and Li's nine Strang steps (1997), 50 to 400 times than with Yoshida's seven (1990, solution
/// A), measured between 1e-6 and 1e-9 rad: those have larger backward substeps, Yoshida's of 1.18 dt.
///
/// Order 6 in attitude and energy. Conserved to rounding: |m| and the momentum in the world; the energy error
/// stays O(h⁶) for all time. Symmetric. Exact for spheres and symmetric tops.
///
/// Source: S. Blanes & P. C. Moan, J. Comput. Appl. Math. 142, 2002, their S₁₀ of order 6.
template <class Real>
void splitting6Steps(const Vector3<Real>& inertia, FreeState<Real>& state, const Real& dt,
                     std::int64_t count) {
  constexpr std::array<double, 5> a = {0.0502627644003922, 0.413514300428344, 0.0450798897943977,
                                       -0.188054853819569, 0.541960678450780};
  constexpr std::array<double, 4> b = {0.148816447901042, -0.132385865767784, 0.067307604692185,
                                       0.432666402578175};
  constexpr double kMiddleA = 1 - 2 * (a[0] + a[1] + a[2] + a[3] + a[4]);
  constexpr double kMiddleB = 0.5 - (b[0] + b[1] + b[2] + b[3]);
  detail::compose<Real, 10>(MiddleAxisFrame<Real>::X::kSmallerRate,
                            {a[0], a[1], a[2], a[3], a[4], kMiddleA, a[4], a[3], a[2], a[1]},
                            {b[0], b[1], b[2], b[3], kMiddleB, kMiddleB, b[3], b[2], b[1], b[0]}, inertia,
                            state, dt, count);
}

}  // namespace careen
