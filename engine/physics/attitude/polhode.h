#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "core/math/wide.h"
#include "physics/attitude/principal_moments.h"

namespace careen {

/// The polhode, the curve of the tip of the angular momentum in the body, in the notation of
/// torque_free_rotation.h: which body axes are a, b and c, and the quantities that enter every elliptic
/// integral.
///
/// The momentum is in the extended type: near the separatrix, or in a needle, the last digit of a component
/// decides the direction of the motion.
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

  const PrincipalMoments<Real>& body;
  std::size_t circled;  // 0 if Ia is the smallest moment, 1 if it is the largest
  Kind kind;
  Frame frame;
  Real direction;     // +1 if Ia is the smallest moment, −1 if it is the largest
  Real mb, mc, ma;    // [kg m²/s] the momentum along x, y, z
  Extended momentum;  // G = |m|
  Extended momentumSquared;
  Extended alongZ;          // ma
  Extended p, d;            // A² nAC and A² kc² nAB · magnification²
  Real s;                   // C² nAC
  Real aSquared, cSquared;  // A² and C²; 0 for a body with three equal moments
  Real magnification = 1;   // [1] scale factor of m along a and c in d, a power of two

  // nAB = V |1/Ia − 1/Ib| and so on [kg² m⁴].
  const Extended& nAB() const { return body.n[circled]; }
  const Extended& nBC() const { return body.n[1 - circled]; }
  const Extended& nAC() const { return body.n13; }
  Extended excess() const { return direction < 0 ? Extended(-d) : d; }  // V D
  // [1/(kg m²)]
  const Extended& perIa() const { return body.inverse[2 * circled]; }
  const Extended& perIb() const { return body.inverse[1]; }
  const Extended& perIc() const { return body.inverse[2 - 2 * circled]; }

  /// momentumBody [kg m²/s] along the body axes. Keeps a reference to the moments. Inlined with turnedBack():
  /// the momentum then stays in registers.
  [[gnu::always_inline]] Polhode(const PrincipalMoments<Real>& moments, std::array<Extended, 3> momentumBody)
      : body(moments) {
    using std::abs;
    using std::sqrt;
    // For a spin about one axis to within rounding, the other components are results of cancellation: their
    // high and low parts may overlap, and a square without the smaller part's would come out negative.
    for (Extended& component : momentumBody) {
      component = normalized(component);
    }
    const Vector3<Real> m(static_cast<Real>(momentumBody[0]), static_cast<Real>(momentumBody[1]),
                          static_cast<Real>(momentumBody[2]));
    const std::array<std::size_t, 3>& order = body.order;
    // Very close to the middle axis, only kc depends on the two outer components: they are scaled up, so that
    // their squares do not underflow.
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
    const Extended excess = normalized(Extended(squares[0] * body.n[0] - squares[1] * body.n[1]));
    const Real sign = static_cast<Real>(excess);
    // On the separatrix either works, but a symmetric body's axis must be a.
    circled = sign < 0 || (sign == 0 && static_cast<Real>(body.n[0]) == 0) ? 1 : 0;

    direction = circled == 1 ? Real(-1) : Real(1);
    const int a = static_cast<int>(order[2 * circled]);
    const int b = static_cast<int>(order[1]);
    const int c = static_cast<int>(order[2 - 2 * circled]);
    d = circled == 1 ? Extended(-excess) : excess;
    const Extended& maSquared = squares[circled];
    const Extended& mcSquared = squares[1 - circled];
    momentumSquared = maSquared + mcSquared + mbSquared;
    momentum = sqrt(momentumSquared);
    p = d + momentumSquared * nBC();
    s = static_cast<Real>(mcSquared) * static_cast<Real>(nAC()) +
        static_cast<Real>(mbSquared) * static_cast<Real>(nAB());
    aSquared = static_cast<Real>(p) * body.perN13;
    cSquared = s * body.perN13;

    const bool noA = static_cast<Real>(maSquared) == 0;
    const bool noB = static_cast<Real>(mbSquared) == 0;
    const bool noC = static_cast<Real>(mcSquared) == 0;
    if ((noA ? 1 : 0) + (noB ? 1 : 0) + (noC ? 1 : 0) >= 2) {
      kind = Kind::kFixedAxis;
      const int axis = !noA ? a : !noB ? b : c;
      frame = {{(axis + 1) % 3, (axis + 2) % 3, axis}, {Real(1), signOf(m[axis]), signOf(m[axis])}};
    } else {
      kind = static_cast<Real>(nBC()) == 0 ? Kind::kSymmetric
             : sign == 0                   ? Kind::kSeparatrix
                                           : Kind::kGeneral;
      // m is made positive along as many axes as a right-handed frame allows: a half turn of body and world
      // about a coordinate axis, equivalent to mirroring, then leads to the same frame and the same bits.
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
    const auto axis = static_cast<std::size_t>(frame.bodyAxis[2]);
    alongZ = frame.sign[2] < 0 ? Extended(-momentumBody[axis]) : momentumBody[axis];
    if (magnification > 1 && axis != order[1]) {
      alongZ = (1 / magnification) * alongZ;
    }
    mb = inFrame[0];
    mc = inFrame[1];
    ma = inFrame[2];
  }

 private:
  static Real signOf(const Real& x) { return static_cast<Real>(1 - 2 * (x < 0 ? 1 : 0)); }
};

}  // namespace careen
