#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace careen::oracle {

/// A free rigid body integrated by its Taylor series in time, to check closed forms: shares no code and no
/// formula with the engine, and is accurate to the rounding of `Real`.
///
/// The equations are m' = m × ω (Euler, body-frame momentum) and q' = ½ q ω, with ωᵢ = mᵢ/Iᵢ. The
/// coefficients follow by Cauchy products: (n+1) x[n+1] = Σ y[j] z[n−j]. A step is as long as possible with
/// the last two terms below rounding.
template <class Real>
struct FreeBody {
  std::array<Real, 3> moments;   // [kg m²]
  std::array<Real, 3> momentum;  // [kg m²/s] in the body frame
  std::array<Real, 4> attitude;  // w x y z, world from body
};

template <class Real, std::size_t kOrder = 30>
void advance(FreeBody<Real>& body, Real duration) {
  using std::abs;
  using std::pow;
  using std::sqrt;
  std::array<std::array<Real, kOrder + 1>, 3> m;
  std::array<std::array<Real, kOrder + 1>, 3> omega;
  std::array<std::array<Real, kOrder + 1>, 4> q;
  const Real direction = duration < 0 ? -1 : 1;
  Real remaining = abs(duration);
  while (remaining > 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      m[i][0] = body.momentum[i];
      omega[i][0] = m[i][0] / body.moments[i];
    }
    for (std::size_t i = 0; i < 4; ++i) {
      q[i][0] = body.attitude[i];
    }
    for (std::size_t n = 0; n < kOrder; ++n) {
      std::array<Real, 3> torque{};
      std::array<Real, 4> spin{};
      for (std::size_t j = 0; j <= n; ++j) {
        const Real x = omega[0][n - j];
        const Real y = omega[1][n - j];
        const Real z = omega[2][n - j];
        torque[0] += m[1][j] * z - m[2][j] * y;
        torque[1] += m[2][j] * x - m[0][j] * z;
        torque[2] += m[0][j] * y - m[1][j] * x;
        spin[0] += -(q[1][j] * x + q[2][j] * y + q[3][j] * z);
        spin[1] += q[0][j] * x + q[2][j] * z - q[3][j] * y;
        spin[2] += q[0][j] * y + q[3][j] * x - q[1][j] * z;
        spin[3] += q[0][j] * z + q[1][j] * y - q[2][j] * x;
      }
      const Real next = static_cast<Real>(static_cast<int>(n) + 1);
      for (std::size_t i = 0; i < 3; ++i) {
        m[i][n + 1] = torque[i] / next;
        omega[i][n + 1] = m[i][n + 1] / body.moments[i];
      }
      for (std::size_t i = 0; i < 4; ++i) {
        q[i][n + 1] = spin[i] / (2 * next);
      }
    }
    // The longest step that keeps the last two terms below a rounding of the state.
    Real size = 0;
    Real last = 0;
    Real lastButOne = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      size += abs(m[i][0]);
      last += abs(m[i][kOrder]);
      lastButOne += abs(m[i][kOrder - 1]);
    }
    Real lastTurn = 0;
    Real lastTurnButOne = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      lastTurn += abs(q[i][kOrder]);
      lastTurnButOne += abs(q[i][kOrder - 1]);
    }
    const double small = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 64;
    const auto reach = [&](const Real& term, const Real& whole, std::size_t order) {
      return term > 0 ? std::pow(small * static_cast<double>(whole / term), 1.0 / static_cast<double>(order))
                      : 1e300;
    };
    double longest = reach(last, size, kOrder);
    longest = std::fmin(longest, reach(lastButOne, size, kOrder - 1));
    longest = std::fmin(longest, reach(lastTurn, Real(1), kOrder));
    longest = std::fmin(longest, reach(lastTurnButOne, Real(1), kOrder - 1));
    const Real step = remaining < Real(longest) ? remaining : Real(longest);
    const Real h = direction * step;
    for (std::size_t i = 0; i < 3; ++i) {
      Real sum = m[i][kOrder];
      for (std::size_t n = kOrder; n-- > 0;) {
        sum = sum * h + m[i][n];
      }
      body.momentum[i] = sum;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      Real sum = q[i][kOrder];
      for (std::size_t n = kOrder; n-- > 0;) {
        sum = sum * h + q[i][n];
      }
      body.attitude[i] = sum;
    }
    remaining -= step;
  }
}

}  // namespace careen::oracle
