#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "physics/attitude/middle_axis_frame.h"

namespace careen {

namespace detail {

template <class Real>
void taylor8Step(MiddleAxisState<Real>& s, const Real& hAlphaX, const Real& hAlphaY) {
  using std::sqrt;
  constexpr std::size_t kOrder = 8;
  using Series = std::array<Real, kOrder + 1>;
  Series mx, my, mz, w, x, y, z;
  std::array<Real, kOrder> u, v;
  mx[0] = s.mx;
  my[0] = s.my;
  mz[0] = s.mz;
  w[0] = s.w;
  x[0] = s.x;
  y[0] = s.y;
  z[0] = s.z;
#pragma GCC unroll 8
  for (std::size_t n = 0; n < kOrder; ++n) {
    u[n] = hAlphaX * mx[n] / 2;
    v[n] = hAlphaY * my[n] / 2;
    Real myz = 0, mzx = 0, mxy = 0, dw = 0, dx = 0, dy = 0, dz = 0;
#pragma GCC unroll 8
    for (std::size_t j = 0; j <= n; ++j) {
      myz += my[j] * mz[n - j];
      mzx += mz[j] * mx[n - j];
      mxy += mx[j] * my[n - j];
      dw -= x[n - j] * u[j] + y[n - j] * v[j];
      dx += w[n - j] * u[j] - z[n - j] * v[j];
      dy += z[n - j] * u[j] + w[n - j] * v[j];
      dz += x[n - j] * v[j] - y[n - j] * u[j];
    }
    const Real perNext = Real(1) / static_cast<double>(n + 1);
    mx[n + 1] = -hAlphaY * myz * perNext;
    my[n + 1] = hAlphaX * mzx * perNext;
    mz[n + 1] = (hAlphaY - hAlphaX) * mxy * perNext;
    w[n + 1] = dw * perNext;
    x[n + 1] = dx * perNext;
    y[n + 1] = dy * perNext;
    z[n + 1] = dz * perNext;
  }
  const auto sum = [](const Series& series) {
    Real total = series[kOrder];
    for (std::size_t n = kOrder; n-- > 0;) {
      total += series[n];
    }
    return total;
  };
  s.mx = sum(mx);
  s.my = sum(my);
  s.mz = sum(mz);
  s.w = sum(w);
  s.x = sum(x);
  s.y = sum(y);
  s.z = sum(z);
  const Real inverseLength = 1 / sqrt(s.w * s.w + s.x * s.x + s.y * s.y + s.z * s.z);
  s.w *= inverseLength;
  s.x *= inverseLength;
  s.y *= inverseLength;
  s.z *= inverseLength;
}

}  // namespace detail

/// The Taylor series of q and m to order 8, with recursive coefficients by Cauchy products:
///
///     (n+1) m[n+1] = Σ m[j] × ω[n−j],   (n+1) q[n+1] = Σ ½ q[n−j] ω[j],
///
/// for the motion that middle_axis_frame.h leaves, which saves a third of the products in q and reduces
/// errors. The quaternion is normalised after each step.
///
/// Order 8 in attitude, energy and momentum. Conserves none of energy, |m| and the momentum in the world: the
/// leading term of their errors is odd in time and periodic with the polhode, the next grows with time. Not
/// symmetric. Exact for a sphere.
///
/// Source: the method is old; E. Hairer, S. P. Nørsett & G. Wanner, Solving Ordinary Differential Equations
/// I, I.8.
template <class Real>
void taylor8Steps(const Vector3<Real>& inertia, FreeState<Real>& state, const Real& dt, std::int64_t count) {
  const MiddleAxisFrame<Real> frame(inertia);
  MiddleAxisState<Real> s(frame, state);
  for (std::int64_t i = 0; i < count; ++i) {
    detail::taylor8Step<Real>(s, dt * frame.alphaX, dt * frame.alphaY);
  }
  state = s.restored(frame, Real(dt * static_cast<double>(count)));
}

}  // namespace careen
