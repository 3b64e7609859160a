#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/linear_algebra.h"
#include "core/wide.h"

namespace careen {

/// The curve on which the tip of the angular momentum moves in the body, and the names its parts have in
/// torque_free_rotation.h: which body axes play a, b and c, and the quantities every elliptic integral is
/// made of.
///
/// The momentum is taken in the extended type: near the separatrix, or in a needle, the last digit of a
/// component decides where the motion goes.
///
/// Denominators are cleared: with V = Ia Ib Ic, nAB = |Ib − Ia| Ic stands for V |1/Ia − 1/Ib|, and so on.
/// Differences of moments are thus taken of the moments themselves, where they are exact when it matters.
template <class Real>
struct Polhode {
  using Extended = Wide<Real>;

  /// Right-handed frame x = ±b, y = ±c, z = ±a: body axis and sign for each of x, y, z.
  struct Frame {
    std::array<int, 3> bodyAxis;
    std::array<Real, 3> sign;

    Vector3<Real> fromBody(const Vector3<Real>& v) const {
      return {sign[0] * v[bodyAxis[0]], sign[1] * v[bodyAxis[1]], sign[2] * v[bodyAxis[2]]};
    }
  };

  enum class Kind {
    kFixedAxis,   // the spin is about a principal axis z (or there is none)
    kSymmetric,   // Ib = Ic: circles about a
    kGeneral,     // ovals about a
    kSeparatrix,  // from −b to b
  };

  Kind kind;
  Frame frame;
  Real direction;          // +1 if Ia is the smallest moment, −1 if it is the largest
  Real mb, mc, ma;         // [kg m²/s] the momentum along x, y, z
  Real ia, ib, ic;         // [kg m²]
  Extended volume;         // V [kg³ m⁶]
  Extended nAB, nBC, nAC;  // [kg² m⁴], nAB + nBC = nAC
  Extended momentum;       // G = |m|
  Extended p, s, d;        // A² nAC, C² nAC and A² kc² nAB · magnification²
  Real magnification = 1;  // [1] by which m along a and c was enlarged for d, a power of two

  /// moments [kg m²] along the body axes, momentumBody [kg m²/s] along them.
  Polhode(const Vector3<Real>& moments, std::array<Extended, 3> momentumBody) {
    using std::abs;
    using std::sqrt;
    const Vector3<Real> m(static_cast<Real>(momentumBody[0]), static_cast<Real>(momentumBody[1]),
                          static_cast<Real>(momentumBody[2]));
    // Ranks instead of swaps: a sort of three mispredicts every other branch.
    std::array<std::size_t, 3> order{};
    const int before01 = moments[1] < moments[0] ? 1 : 0;
    const int before02 = moments[2] < moments[0] ? 1 : 0;
    const int before12 = moments[2] < moments[1] ? 1 : 0;
    order[static_cast<std::size_t>(before01 + before02)] = 0;
    order[static_cast<std::size_t>(1 - before01 + before12)] = 1;
    order[static_cast<std::size_t>(2 - before02 - before12)] = 2;

    const Real i1 = moments[static_cast<int>(order[0])];
    const Real i2 = moments[static_cast<int>(order[1])];
    const Real i3 = moments[static_cast<int>(order[2])];
    const std::array<Extended, 2> n = {wideDifference<Extended>(i2, i1) * i3,
                                       wideDifference<Extended>(i3, i2) * i1};
    // Hardly off the middle axis, nothing but kc depends on the two outer components: they are taken larger,
    // so that their squares do not underflow.
    const Real outer =
        std::max(Real(abs(m[static_cast<int>(order[0])])), Real(abs(m[static_cast<int>(order[2])])));
    if (outer > 0) {
      while (outer * magnification < abs(m[static_cast<int>(order[1])]) * Real(0x1p-300)) {
        magnification *= Real(0x1p200);
      }
    }
    if (magnification > 1) {
      momentumBody[order[0]] = magnification * momentumBody[order[0]];
      momentumBody[order[2]] = magnification * momentumBody[order[2]];
    }
    const std::array<Extended, 2> squares = {square(momentumBody[order[0]]), square(momentumBody[order[2]])};
    const Extended mbSquared = square(momentumBody[order[1]]);
    const Extended excess = normalized(Extended(squares[0] * n[0] - squares[1] * n[1]));
    const Real sign = static_cast<Real>(excess);
    // On the separatrix either would do, but a symmetric body's axis must be a.
    const std::size_t largest = sign < 0 || (sign == 0 && static_cast<Real>(n[0]) == 0) ? 1 : 0;

    direction = largest == 1 ? Real(-1) : Real(1);
    const int a = static_cast<int>(order[2 * largest]);
    const int b = static_cast<int>(order[1]);
    const int c = static_cast<int>(order[2 - 2 * largest]);
    ia = moments[a];
    ib = moments[b];
    ic = moments[c];
    volume = wideProduct<Extended>(ia, ib) * ic;
    nAB = n[largest];
    nBC = n[1 - largest];
    nAC = wideDifference<Extended>(i3, i1) * i2;
    d = largest == 1 ? Extended(-excess) : excess;
    const Extended& maSquared = squares[largest];
    const Extended& mcSquared = squares[1 - largest];
    momentum = sqrt(Extended(maSquared + mbSquared + mcSquared));
    p = maSquared * nAC + mbSquared * nBC;
    s = mcSquared * nAC + mbSquared * nAB;

    const bool noA = static_cast<Real>(maSquared) == 0;
    const bool noB = static_cast<Real>(mbSquared) == 0;
    const bool noC = static_cast<Real>(mcSquared) == 0;
    if ((noA ? 1 : 0) + (noB ? 1 : 0) + (noC ? 1 : 0) >= 2) {
      kind = Kind::kFixedAxis;
      const int axis = !noA ? a : !noB ? b : c;
      frame = {{(axis + 1) % 3, (axis + 2) % 3, axis}, {Real(1), signOf(m[axis]), signOf(m[axis])}};
    } else {
      kind = static_cast<Real>(nBC) == 0 ? Kind::kSymmetric : sign == 0 ? Kind::kSeparatrix : Kind::kGeneral;
      // m is made positive along as many axes as a right-handed frame allows: a half turn of body and world
      // about a coordinate axis, which is what mirroring amounts to, then leads to the same frame and the
      // same bits.
      const Real parity = (b + 1) % 3 == c ? Real(1) : Real(-1);
      Real alongA = signOf(m[a]);
      Real alongB = signOf(m[b]);
      Real alongC = parity * alongA * alongB;
      if (noB || kind == Kind::kSeparatrix) {
        alongC = signOf(m[c]);
        alongB = parity * alongA * alongC;
      } else if (noA) {
        alongC = signOf(m[c]);
        alongA = parity * alongB * alongC;
      }
      frame = {{b, c, a}, {alongB, alongC, alongA}};
    }
    const Vector3<Real> inFrame = frame.fromBody(m);
    mb = inFrame[0];
    mc = inFrame[1];
    ma = inFrame[2];
  }

 private:
  static Real signOf(const Real& x) { return static_cast<Real>(1 - 2 * (x < 0 ? 1 : 0)); }
};

}  // namespace careen
