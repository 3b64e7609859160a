#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/math/linear_algebra.h"
#include "core/math/wide.h"

namespace careen {

/// A quaternion as two complex numbers, the Cayley–Klein parameters: α = w + iz, β = x + iy. A rotation by θ
/// about z multiplies both by exp(iθ/2).
template <class Real>
struct CayleyKlein {
  Real alphaRe = 1;
  Real alphaIm = 0;
  Real betaRe = 0;
  Real betaIm = 0;
};

/// The rotation q followed by the rotation p.
template <class Real>
CayleyKlein<Real> product(const CayleyKlein<Real>& p, const CayleyKlein<Real>& q) {
  return {(p.alphaRe * q.alphaRe - p.alphaIm * q.alphaIm) - (p.betaRe * q.betaRe + p.betaIm * q.betaIm),
          (p.alphaRe * q.alphaIm + p.alphaIm * q.alphaRe) + (p.betaRe * q.betaIm - p.betaIm * q.betaRe),
          (p.alphaRe * q.betaRe - p.alphaIm * q.betaIm) + (p.betaRe * q.alphaRe + p.betaIm * q.alphaIm),
          (p.alphaRe * q.betaIm + p.alphaIm * q.betaRe) + (p.betaIm * q.alphaRe - p.betaRe * q.alphaIm)};
}

template <class Real>
Real squaredNorm(const CayleyKlein<Real>& q) {
  return (q.alphaRe * q.alphaRe + q.alphaIm * q.alphaIm) + (q.betaRe * q.betaRe + q.betaIm * q.betaIm);
}

/// R⁻¹ v for the rotation R of q, computed in `Number`; q need not have unit length.
template <class Number, class Real>
[[gnu::always_inline]] inline std::array<Number, 3> turnedBack(const Quaternion<Real>& q,
                                                               const Vector3<Real>& v) {
  // v + 2 (u × (u × v) − w u × v)/|q|², where 1/|q|² is 2 − |q|² if q has unit length to rounding.
  using std::abs;
  const Real& w = q.w();
  const std::array<Real, 3> u = {q.x(), q.y(), q.z()};
  const std::array<Real, 3> twice = {2 * u[0], 2 * u[1], 2 * u[2]};
  const auto crossed = [&](std::size_t i, std::size_t j) {
    return Number(wideProduct<Number>(u[i], v[static_cast<int>(j)]) -
                  wideProduct<Number>(u[j], v[static_cast<int>(i)]));
  };
  const Number lengthSquared = (wideProduct<Number>(w, w) + wideProduct<Number>(u[0], u[0])) +
                               (wideProduct<Number>(u[1], u[1]) + wideProduct<Number>(u[2], u[2]));
  const Real excess = static_cast<Real>(Number(lengthSquared - Number(1)));
  const bool isUnit = abs(excess) < 64 * std::numeric_limits<Real>::epsilon();
  const std::array<Number, 3> cross = {crossed(1, 2), crossed(2, 0), crossed(0, 1)};
  const auto component = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Number swing = (twice[j] * cross[k] - twice[k] * cross[j]) - 2 * w * cross[i];
    return Number(
        Number(v[static_cast<int>(i)]) +
        (isUnit ? withRest(swing, Real(-excess * static_cast<Real>(swing))) : Number(swing / lengthSquared)));
  };
  return {component(0, 1, 2), component(1, 2, 0), component(2, 0, 1)};
}

}  // namespace careen
