#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/math/elementary.h"
#include "core/math/linear_algebra.h"
#include "core/math/wide.h"
#include "physics/attitude/cayley_klein.h"
#include "physics/attitude/landen_ladder.h"
#include "physics/attitude/linear_phase.h"
#include "physics/attitude/polhode.h"
#include "physics/attitude/principal_moments.h"
#include "physics/attitude/tilt_series.h"

namespace careen {

/// The attitude of a torque-free rigid body at any time, in closed form: set up once, evaluated at any time,
/// never stepped.
///
/// **The problem.** L [kg m²/s], the angular momentum in the world, is constant. Seen from the body it is m =
/// Aᵀ L and obeys Euler's m' = m × I⁻¹ m; A obeys A' = ω̃ A with ω = A I⁻¹ Aᵀ L.
///
/// **The momentum in the body** circles one axis. Let b be the axis of the middle moment, a and c the outer
/// two, a the one that m circles: that of the smallest moment if D = ma² (1/Ia − 1/Ib) − mc² (1/Ib − 1/Ic) is
/// positive for that choice, else that of the largest. With AB = 1/Ia − 1/Ib, BC = 1/Ib − 1/Ic, AC = 1/Ia −
/// 1/Ic (all of one sign),
///
///     m = (mb, mc, ma) = (B sn u, C cn u, A dn u),   u = λt + u₀,   λ = sgn(AC) A √(AC·AB),
///     A² = ma² + mb² BC/AC,   C² = mc² + mb² AB/AC,   B² = C² AC/AB,   G² = |L|² = A² + C²,
///     k² = (BC/AC) B²/A²,     kc² = 1 − k² = D/(A² AB).
///
/// kc is computed from D, never from k, which is close to 1 near the separatrix D = 0. sn, cn, dn are
/// Jacobi's functions of modulus k, K and K' their quarter periods, v = πu/2K the phase of the polhode.
///
/// **The attitude.** In the right-handed frame x = ±b, y = ±c, z = ±a (signs such that ma ≥ 0) and for L
/// along the world's z, the Cayley–Klein parameters w + iz and x + iy of A are, up to a common factor, entire
/// functions of u (Klein & Sommerfeld): theta functions of nome q² = exp(−2πK'/K),
///
///     w + iz = e^{iκt} θ₄(v + iσ | q²)/N,   x + iy = −i e^{iκt} θ₁(v + iσ | q²)/N,   N: normalisation.
///
/// σ = πs/2K measures the tilt of m from a: w = K' − s is the argument with sn(w, k') = A/G. κ is half the
/// mean angular speed about L, and follows from the mean precession of a body axis: a's is the mean of G
/// (mb²/Ib + mc²/Ic)/(mb² + mc²), c's the mean of G (ma²/Ia + mb²/Ib)/(ma² + mb²), and they differ by dv/dt =
/// πλ/2K because c revolves about a once per period of the polhode while a, on average, stays:
///
///     2κ = ⟨precession of a⟩ + dv/dt = ⟨precession of c⟩.
///
/// Both are complete integrals of the third kind with positive integrands,
///
///     G ⟨(α cn² + β p sn²)/(cn² + p sn²)⟩,   of a: α = 1/Ic, β = 1/Ib, p = AC/AB;
///                                            of c: α = 1/Ia, β = 1/Ib + D/G², p = G²/A²
///
/// (β of c is twice the energy, Σ m²/I = G²/Ib + D, over G²); the one with p in (1, 2] is used. In general L
/// is not along z: a constant quaternion on the left, determined by A(0), accounts for that.
///
/// **Numerically.** landen_ladder.h computes the integrals, tilt_series.h the theta functions, polhode.h the
/// choice of axes and the sign of D, principal_moments.h what is the same for all flights of a body. Factors
/// of time (dv/dt and κ) are computed in double the precision and kept in quarter turns (linear_phase.h).
/// Special cases: two equal moments give k = 0, circular functions and one term of each series; for a spin
/// about a body axis A is a steady rotation; on the separatrix (D = 0) K = ∞ and the functions are
/// hyperbolic. No tolerance has a unit: multiplying moments, L and t by powers of two gives the same bits,
/// and so does mirroring.
///
/// Not used: Whittaker's Euler angles (they lose digits where m passes the axis they are measured from); a
/// rotation matrix built on L and m (Van Zon & Schofield), which needs the incomplete integral of the third
/// kind at every evaluation or the same theta functions; the form of Celledoni et al., whose case (iii) has
/// sign errors.
///
/// Sources: F. Klein & A. Sommerfeld, Theorie des Kreisels, ch. VI; E. T. Whittaker, Analytical Dynamics,
/// §69; R. van Zon & J. Schofield, J. Comput. Phys. 225, 2007; E. Celledoni, F. Fassò, N. Säfström & A.
/// Zanna, SIAM J. Sci. Comput. 30, 2008; R. Bulirsch, Numer. Math. 13, 1969, for the third kind (cel).
///
/// Measured for double: error [rad] at most 1.3e-15 (1 + ωt) for 204,000 bodies and spins of all kinds,
/// against a Taylor series of order 30; 7.1e-16 after 10⁴ s and 4·10⁴ radians. Cost in steps of the classical
/// Runge–Kutta method with normalisation: one attitude 0.9, one set-up 9; in steps without it 1.2 and 12
/// (torque_free_rotation_benchmark.cpp).
///
/// Moments must be positive and finite, L finite; the quaternion may have any non-zero length. Squares of all
/// of them, and products of two such squares, must neither overflow nor underflow; only the momentum off an
/// axis may be arbitrarily small. |ωt| < 2⁵⁰.
template <class Real>
class TorqueFreeRotation {
 public:
  /// Principal moments of inertia, along the body's axes if given as a vector [kg m²], attitude at t = 0,
  /// angular momentum [kg m²/s]. Keeps no reference to the moments.
  TorqueFreeRotation(const PrincipalMoments<Real>& moments, const Quaternion<Real>& worldFromBodyAtStart,
                     const Vector3<Real>& angularMomentumWorld);
  TorqueFreeRotation(const Vector3<Real>& momentsBody, const Quaternion<Real>& worldFromBodyAtStart,
                     const Vector3<Real>& angularMomentumWorld)
      : TorqueFreeRotation(PrincipalMoments<Real>(momentsBody), worldFromBodyAtStart, angularMomentumWorld) {}

  /// The attitude at time t [s] after (or before) the start, a unit quaternion to rounding.
  Quaternion<Real> worldFromBody(const Real& t) const;

  /// ω = A I⁻¹ Aᵀ L [rad/s] for the attitude A.
  Vector3<Real> angularVelocityWorld(const Quaternion<Real>& worldFromBody) const;

  /// L [kg m²/s], constant.
  Vector3<Real> angularMomentumWorld() const {
    return {angularMomentumWorld_[0], angularMomentumWorld_[1], angularMomentumWorld_[2]};
  }

  /// Upper bounds of |ω| and |dω/dt| in the world for all times: the largest values on the whole polhode,
  /// from the conservation of energy and |L|, with a margin for rounding.
  struct Bounds {
    Real angularSpeed;         // [rad/s]
    Real angularAcceleration;  // [rad/s²]
  };
  const Bounds& bounds() const { return bounds_; }

 private:
  using Frame = typename Polhode<Real>::Frame;

  static constexpr double kLeastDirectModulus = 0.185;  // kc where the nome is 0.2

  void setStart(const Quaternion<Real>& worldFromBody, const Frame& frame);
  void setBounds(const Polhode<Real>& polhode);
  void setUpFixedAxis(const Polhode<Real>& polhode);
  void setUpSymmetric(const Polhode<Real>& polhode);
  void setUpSeparatrix(const Polhode<Real>& polhode);
  void setUpGeneral(const Polhode<Real>& polhode);
  CayleyKlein<Real> spinor(const Real& t) const;

  // Plain arrays: Eigen's are not trivially copyable.
  std::array<Real, 3> angularMomentumWorld_;  // L [kg m²/s]
  std::array<Real, 3> inverseMoments_;        // [1/(kg m²)]
  Bounds bounds_;
  std::array<std::array<Real, 4>, 4> fromSpinor_;  // its columns; rows x y z w
  LinearPhase<Real> polhodePhase_;                 // v
  LinearPhase<Real> precession_;                   // κt
  TiltSeries<Real> tilt_;
};

template <class Real>
TorqueFreeRotation<Real>::TorqueFreeRotation(const PrincipalMoments<Real>& moments,
                                             const Quaternion<Real>& worldFromBodyAtStart,
                                             const Vector3<Real>& angularMomentumWorld)
    : angularMomentumWorld_{angularMomentumWorld[0], angularMomentumWorld[1], angularMomentumWorld[2]},
      inverseMoments_(moments.inverseAlongBody) {
  const Polhode<Real> polhode(moments, turnedBack<Wide<Real>>(worldFromBodyAtStart, angularMomentumWorld));
  switch (polhode.kind) {
    case Polhode<Real>::Kind::kFixedAxis:
      setUpFixedAxis(polhode);
      break;
    case Polhode<Real>::Kind::kSymmetric:
      setUpSymmetric(polhode);
      break;
    case Polhode<Real>::Kind::kSeparatrix:
      setUpSeparatrix(polhode);
      setBounds(polhode);
      break;
    case Polhode<Real>::Kind::kGeneral:
      setUpGeneral(polhode);
      setBounds(polhode);
      break;
  }
  setStart(worldFromBodyAtStart, polhode.frame);
}

template <class Real>
void TorqueFreeRotation<Real>::setStart(const Quaternion<Real>& worldFromBody, const Frame& frame) {
  using std::sqrt;
  // In the frame's axes q(t) = start · spinor(t), with start = q(0) · spinor(0)⁻¹; the product with start is
  // written as a matrix on (Re α, Im α, Re β, Im β) whose rows stand in the order of the body's axes.
  const CayleyKlein<Real> moving = spinor(0);
  const Vector3<Real> axis = frame.fromBody(worldFromBody.vec());
  const Real inverseNorm = 1 / sqrt(squaredNorm(moving) * worldFromBody.squaredNorm());
  const CayleyKlein<Real> start = product<Real>({worldFromBody.w(), axis[2], axis[0], axis[1]},
                                                {moving.alphaRe * inverseNorm, -moving.alphaIm * inverseNorm,
                                                 -moving.betaRe * inverseNorm, -moving.betaIm * inverseNorm});
  const auto& [w, z, x, y] = start;
  const std::array<std::size_t, 3> row = {static_cast<std::size_t>(frame.bodyAxis[0]),
                                          static_cast<std::size_t>(frame.bodyAxis[1]),
                                          static_cast<std::size_t>(frame.bodyAxis[2])};
  const std::array<Real, 3>& sign = frame.sign;
  const auto setColumn = [&](std::array<Real, 4>& column, const Real& alongX, const Real& alongY,
                             const Real& alongZ, const Real& scalar) {
    column[row[0]] = sign[0] * alongX;
    column[row[1]] = sign[1] * alongY;
    column[row[2]] = sign[2] * alongZ;
    column[3] = scalar;
  };
  setColumn(fromSpinor_[0], x, y, z, w);
  setColumn(fromSpinor_[1], y, -x, w, -z);
  setColumn(fromSpinor_[2], w, z, -y, -x);
  setColumn(fromSpinor_[3], -z, w, x, -y);
}

template <class Real>
void TorqueFreeRotation<Real>::setUpFixedAxis(const Polhode<Real>& polhode) {
  const auto axis = static_cast<std::size_t>(polhode.frame.bodyAxis[2]);
  precession_ = {half(Wide<Real>(polhode.alongZ / Wide<Real>(polhode.body.alongBody[axis]))), 0, 0};
  bounds_ = {static_cast<Real>(polhode.momentum) * inverseMoments_[axis] *
                 (1 + 8 * std::numeric_limits<Real>::epsilon()),
             0};
}

template <class Real>
void TorqueFreeRotation<Real>::setUpSymmetric(const Polhode<Real>& polhode) {
  using std::sqrt;
  const Wide<Real> bodyRate = polhode.direction * (polhode.alongZ * polhode.nAC() * polhode.body.perVolume);
  polhodePhase_ = {bodyRate, 0, elementary::atan2(polhode.mb, polhode.mc)};
  precession_ = {half(Wide<Real>(polhode.momentum * polhode.perIb() + bodyRate)), 0, 0};
  const Real transverse = sqrt(square(polhode.mb) + square(polhode.mc));
  tilt_ = TiltSeries<Real>::fromNome(0, transverse / (static_cast<Real>(polhode.momentum) + polhode.ma));
  const Real perIb = static_cast<Real>(polhode.perIb());
  const Real perIa = static_cast<Real>(polhode.perIa());
  const Real margin = 1 + 64 * std::numeric_limits<Real>::epsilon();
  bounds_ = {sqrt(square(Real(polhode.ma * perIa)) + square(Real(transverse * perIb))) * margin,
             static_cast<Real>(polhode.nAC()) * static_cast<Real>(polhode.body.perVolume) * perIb *
                 polhode.ma * transverse * margin};
}

template <class Real>
void TorqueFreeRotation<Real>::setUpSeparatrix(const Polhode<Real>& polhode) {
  using std::abs;
  using std::sqrt;
  const auto real = [](const Wide<Real>& x) { return static_cast<Real>(x); };
  // λ = A √(AC·AB), and e^u = (1 + sn u)/cn u from sn u = tanh u = mb/B, cn u = mc/C, C² = B² nAB/nAC.
  const Wide<Real> lambda =
      polhode.direction * sqrt(Wide<Real>(polhode.p * polhode.nAB())) * polhode.body.perVolume;
  const Real b = sqrt(polhode.s / real(polhode.nAB()));
  const Real c = sqrt(polhode.cSquared);
  const Real u = elementary::log(Real((1 + abs(polhode.mb) / b) * (c / polhode.mc)));
  polhodePhase_ = {half(lambda), 0, (polhode.mb < 0 ? Real(-u) : u) / 2};
  precession_ = {half(Wide<Real>(polhode.momentum * polhode.perIb())), 0, 0};
  // w = F(φ, k' = 1) with cot φ = C/A; x = π/4 − φ/2 as k' = 1 makes K' the quarter turn of a circle.
  const Real phi = elementary::atan2(Real(sqrt(real(polhode.p))), Real(sqrt(polhode.s)));
  tilt_ = TiltSeries<Real>::onSeparatrix(elementary::pi<Real>() / 4 - phi / 2);
}

template <class Real>
void TorqueFreeRotation<Real>::setUpGeneral(const Polhode<Real>& polhode) {
  using std::abs;
  using std::sqrt;
  using Extended = Wide<Real>;
  const auto real = [](const Extended& x) { return static_cast<Real>(x); };
  const PrincipalMoments<Real>& body = polhode.body;

  // Both ladders start from a₀ = A √(nAC nAB), the direct one with b₀ = kc a₀, the complementary one with k
  // a₀.
  const Extended lowerSquared = polhode.d * polhode.nAC();
  const Extended upper = sqrt(Extended(polhode.p * polhode.nAB()));
  Extended lower = sqrt(lowerSquared);
  if (polhode.magnification > 1) {
    lower = (1 / polhode.magnification) * lower;
  }
  const Real a0 = real(upper);
  const Real kUpperSquared = real(polhode.nBC()) * polhode.s;
  const Real a = sqrt(polhode.aSquared);
  const Real cSquared = polhode.cSquared;
  const Real g = real(polhode.momentum);

  LandenLadder<Real> ladder(upper, lower, kUpperSquared / (a0 + real(lower)));
  // The mean precession about L of the axis a or c, whichever has the better conditioned integral. On the
  // polhode Σ m²/I is G²/Ib + D.
  const bool ofAxisA = body.isLarger(polhode.circled);
  const Extended& factor = body.precessionRoot[polhode.circled];
  const Extended beta = ofAxisA
                            ? polhode.perIb()
                            : polhode.perIb() + polhode.excess() * body.perVolume / polhode.momentumSquared;
  ThirdKindMean<Real> precession(factor * (ofAxisA ? upper : polhode.momentum),
                                 ofAxisA ? polhode.perIc() : polhode.perIa(), beta, ladder.product());
  EllipticPhase<Real> phase(polhode.mb == 0 ? a0 : abs(polhode.mc) * a * real(polhode.nAC()) / polhode.mb);
  EllipticDecay<Real> decay(a / (g * a0), cSquared / (g * (g + a)));
  for (bool more = true, isFirst = true; more; isFirst = false) {
    more = ladder.descend();
    phase.step(ladder.level());
    decay.step(ladder.level());
    if (more && !isFirst) {
      precession.step(ladder.product());
    }
  }

  if (real(lower) > a0 * Real(kLeastDirectModulus)) {
    tilt_ = TiltSeries<Real>::fromNome(ladder.nome(), decay.value(ladder));
  } else {
    const Real kUpper = sqrt(kUpperSquared);
    LandenLadder<Real, Real> complementary(a0, kUpper, real(lowerSquared) / (a0 + kUpper));
    EllipticPhase<Real> complementaryPhase(a0 * sqrt(cSquared) / a);  // πw/2K', from cs(w, k') = C/A
    for (bool more = true; more;) {
      more = complementary.descend();
      complementaryPhase.step(complementary.level());
    }
    const Real x = elementary::pi<Real>() / 4 - complementaryPhase.value(complementary.mean()) / 2;
    tilt_ = TiltSeries<Real>::fromComplementaryNome(sqrt(complementary.nome()) / polhode.magnification, x,
                                                    complementary.mean() / (2 * real(ladder.mean())));
  }

  const Extended rateSize = ladder.mean() * body.perVolume;
  const Extended rate = polhode.direction < 0 ? Extended(-rateSize) : rateSize;  // dv/dt
  const Extended mean = polhode.momentum * precession.value(ladder);
  precession_ = {half(ofAxisA ? Extended(mean + rate) : mean), 0, 0};
  // Measured from the nearer of 0 and π: when K is large, u depends on all digits of v there.
  const bool beyond = polhode.mc < 0;
  const Real start = polhode.mb == 0 ? Real(0) : phase.value(real(ladder.mean()));
  polhodePhase_ = {rate, Real(beyond ? 2 : 0), beyond ? Real(-start) : start};
}

template <class Real>
CayleyKlein<Real> TorqueFreeRotation<Real>::spinor(const Real& t) const {
  CayleyKlein<Real> q;
  elementary::SinCos<Real> turn;
  if (tilt_.isDirect()) {
    const auto [v, precession] = sinCosOfBoth(polhodePhase_, precession_, t);
    q = tilt_.direct(v);
    turn = precession;
  } else {
    const typename TiltSeries<Real>::Lean lean = tilt_.transformed(polhodePhase_.preciselyAt(t));
    const TurnedAngle<Real> angle = precession_.at(t, lean.phase);
    q = lean.spinor;
    turn = elementary::sinCosQuarterTurns(angle.quarterTurns, angle.rest);
  }
  return {q.alphaRe * turn.cos - q.alphaIm * turn.sin, q.alphaRe * turn.sin + q.alphaIm * turn.cos,
          q.betaRe * turn.cos - q.betaIm * turn.sin, q.betaRe * turn.sin + q.betaIm * turn.cos};
}

template <class Real>
Quaternion<Real> TorqueFreeRotation<Real>::worldFromBody(const Real& t) const {
  using std::sqrt;
  const CayleyKlein<Real> moving = spinor(t);
  const Real inverseNorm = 1 / sqrt(squaredNorm(moving));
  const Real alphaRe = moving.alphaRe * inverseNorm;
  const Real alphaIm = moving.alphaIm * inverseNorm;
  const Real betaRe = moving.betaRe * inverseNorm;
  const Real betaIm = moving.betaIm * inverseNorm;
  const auto component = [&](std::size_t i) {
    return (fromSpinor_[0][i] * alphaRe + fromSpinor_[1][i] * alphaIm) +
           (fromSpinor_[2][i] * betaRe + fromSpinor_[3][i] * betaIm);
  };
  return {component(3), component(0), component(1), component(2)};
}

template <class Real>
Vector3<Real> TorqueFreeRotation<Real>::angularVelocityWorld(const Quaternion<Real>& worldFromBody) const {
  const std::array<Real, 3> m = turnedBack<Real>(worldFromBody, angularMomentumWorld());
  const Vector3<Real> omegaBody(inverseMoments_[0] * m[0], inverseMoments_[1] * m[1],
                                inverseMoments_[2] * m[2]);
  const std::array<Real, 3> omega = turnedBack<Real>(worldFromBody.conjugate(), omegaBody);
  return {omega[0], omega[1], omega[2]};
}

template <class Real>
void TorqueFreeRotation<Real>::setBounds(const Polhode<Real>& polhode) {
  using std::sqrt;
  const auto real = [](const Wide<Real>& x) { return static_cast<Real>(x); };
  const Real nAC = real(polhode.nAC());
  const Real nAB = real(polhode.nAB());
  const Real aSquared = polhode.aSquared;
  const Real cSquared = polhode.cSquared;
  const Real nBC = real(polhode.nBC());
  const Real perIa = real(polhode.perIa());
  const Real perIb = real(polhode.perIb());
  const Real perIc = real(polhode.perIc());
  const Real perAB = polhode.body.perN[polhode.circled];
  const Real bSquared = polhode.s * perAB;
  const Real aLowestSquared = real(polhode.d) * perAB;  // (A kc)²

  // |ω|² = Σ (mᵢ/Iᵢ)² is linear in s = sn², so that it is largest at s = 0 or s = 1.
  const Real atMiddle = cSquared * square(perIc) + aSquared * square(perIa);
  const Real atEnd = bSquared * square(perIb) + aLowestSquared * square(perIa);

  // dω/dt in the world is I⁻¹ dm/dt in the body (ω × ω = 0), and Euler's equations make its square
  //   first (1−s)(1−k²s) + second s (1−k²s) + third s (1−s).
  const Real perVolume = real(polhode.body.perVolume);
  const Real first = square(nAC * perVolume * perIb) * cSquared * aSquared;
  const Real second = square(nAB * perVolume * perIc) * aSquared * bSquared;
  const Real third = square(nBC * perVolume * perIa) * bSquared * cSquared;
  const Real kcSquared = aLowestSquared / aSquared;
  const Real kSquared = 1 - kcSquared;
  Real largest = std::max(first, Real(second * kcSquared));
  const Real slope = second + third - first * (1 + kSquared);
  const Real bend = third + kSquared * (second - first);  // minus the coefficient of s²
  if (slope > 0 && slope < 2 * bend) {
    const Real s = slope / (2 * bend);
    const Real dnSquared = kcSquared + kSquared * (1 - s);
    largest =
        std::max(largest, Real(first * (1 - s) * dnSquared + second * s * dnSquared + third * s * (1 - s)));
  }
  const Real margin = 1 + 64 * std::numeric_limits<Real>::epsilon();
  bounds_ = {sqrt(std::max(atMiddle, atEnd)) * margin, sqrt(largest) * margin};
}

extern template class TorqueFreeRotation<double>;

}  // namespace careen
