#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace careen {

/// Contact forces between bodies in persistent contact, and the resulting accelerations. Coulomb friction
/// with a circular friction cone.
///
/// Accelerations a are six numbers per body, that of the centre of mass in the world frame and ω̇ in the
/// body's frame, so that M is diagonal. Contact c has a normal Jacobian row n_c and two tangential rows t_c,
/// orthonormal in the world; targets are the accelerations that its geometry requires (centripetal terms,
/// with their sign changed):
///
///   M (a − a_free) = Jᵀλ,   0 ≤ λ_n ⊥ n a − target_n ≥ 0,   |λ_t| ≤ μ λ_n,
///   a contact that slips: λ_t = −μ λ_n · slip;   one that does not: λ_t holds t a at its target if
///   |λ_t| ≤ μ λ_n suffices, else |λ_t| = μ λ_n, opposite to the residual t a − target.
///
/// With velocities in place of accelerations, this gives the velocity after an impulse without restitution.
///
/// Method: augmented Lagrangian with semismooth Newton (P. Alart, A. Curnier, Comput. Methods Appl. Mech.
/// Eng. 92, 1991) in the coordinates of the bodies: the matrix M + Jᵀ D J stays nonsingular however redundant
/// the contacts are. Of all force distributions it finds that of least norm, weighted by effective mass,
/// because the multipliers start from 0 and only move along the rows. Friction makes the matrix unsymmetric.
/// Unlike ImpactSolver's problem, this one is not convex and may have no solution (P. Painlevé, C. R. Acad.
/// Sci. 121, 1895): solve() then returns false.
class ContactForces {
 public:
  static constexpr std::size_t kAxes = 6;
  static constexpr int kNobody = -1;
  using Row = std::array<double, 2 * kAxes>;  ///< a's six, then b's
  using Force = std::array<double, 3>;        ///< [N] normal, tangent, tangent

  enum class Mode : unsigned char {
    kOff,    ///< no force
    kOn,     ///< normal force, no friction
    kStick,  ///< normal force, sticks
    kSlip,   ///< normal force, slips or begins to
  };

  struct Contact {
    int a = kNobody;
    int b = kNobody;
    std::array<Row, 3> rows{};
    Force target{};  ///< [m/s²] of n a and t a
    double friction = 0;
    bool slips = false;            ///< has a slip velocity
    std::array<double, 2> slip{};  ///< [1] its unit direction; if it only begins to slip, solve() fills it in
  };

  /// Six 1/M per body [1/kg, 1/(kg m²)], all positive. Empties the contacts.
  void setBodies(std::span<const double> inverseMass);
  std::vector<Contact>& contacts() { return contacts_; }
  const std::vector<Contact>& contacts() const { return contacts_; }

  /// The modes of the contacts are to be found, or given: then no inequality is checked.
  enum class Modes { kFound, kGiven };
  /// Returns false if no solution was reached to rounding error; the best iterate is kept. Given modes may be
  /// slightly inconsistent, as two ends of an edge that both stick while the body rotates out of line: the
  /// residual is distributed by least squares. Redundant forces are those nearest to `guess`, one per
  /// contact, or to zero.
  bool solve(std::span<const double> free, std::span<Mode> modes, Modes how,
             std::span<const Force> guess = {});

  /// The same for velocities, which always has a solution; the friction limits agree with the normal impulses
  /// to a relative 2e-5, or as far as could be reached, and no energy is gained.
  void solveImpulses(std::span<const double> free, std::span<Mode> modes);

  std::span<const double> accelerations() const { return a_; }
  std::span<const Force> forces() const { return forces_; }
  /// Residual n a − target_n or a tangent's [m/s²], of the last solution.
  double excess(std::size_t contact, std::size_t row) const { return excess_[contact][row]; }
  /// [m/s²] Scale for the rounding error of the excess.
  double scale() const { return scale_; }
  /// [kg] Effective mass of the contact along its normal.
  double normalMass(std::size_t contact) const { return masses_[contact][0]; }

 private:
  static constexpr double kRounding = 0x1p-52;

  struct Response {
    Force force{};
    Mode mode = Mode::kOff;
    std::array<double, 9> stiffness{};  // −d force / d excess, by rows
  };

  bool solveByNewton(std::span<const double> free, std::span<Mode> modes, Modes how,
                     std::span<const Force> guess, std::span<const Mode> first, double enough);
  enum class Limits { kDisagree, kAgree, kSolved };
  Limits solveByLimits(std::span<const double> free, std::span<Mode> modes, double agreement, double enough);
  std::vector<Mode> modesNear(std::span<const Force> forces) const;
  bool stands(std::span<Mode> modes) const;
  bool decide(std::span<const double> free, std::span<Mode> modes);
  void weigh();
  double along(const Contact& contact, std::size_t row, std::span<const double> of) const;
  void push(const Contact& contact, const Force& force, std::span<double> onto) const;
  Response respond(std::size_t contact, const Force& excess, const Mode* as, Modes how) const;
  void accelerate(std::span<const double> free);
  Mode modeOf(std::size_t contact);
  double violation(std::span<const Mode> modes, Modes how) const;
  double newton(std::span<const Mode> modes, Modes how);
  void assemble();

  std::vector<double> inverseMass_;
  std::vector<double> mass_;
  std::vector<Contact> contacts_;
  std::vector<std::array<double, 2>> masses_;  // [kg] effective: normal, tangential
  std::vector<double> a_;
  std::vector<Force> forces_;
  std::vector<Force> best_;
  std::vector<Force> excess_;
  std::vector<Force> gained_;  // change of excess by z_
  std::vector<Response> responses_;
  std::vector<Response> factorised_;
  std::vector<double> z_;
  std::vector<double> gradient_;
  std::vector<double> matrix_;
  std::vector<std::size_t> pivots_;
  double scale_ = 0;
  double penalty_ = 0;   // [1]
  bool cycles_ = false;  // Newton's method did not converge to fixed modes
};

}  // namespace careen
