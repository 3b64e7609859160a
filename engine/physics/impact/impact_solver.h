#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

namespace careen {

/// Memory of one impact, see resolveImpact.
template <class Value>
using ImpactVector = std::pmr::vector<Value>;

/// The convex problem inside every impact with several simultaneous contacts.
///
/// Velocities q are six numbers per body, the velocity of the centre of mass in the world frame and ω in the
/// body's frame, so that M in the kinetic energy ½ qᵀMq is diagonal. Contact c has a normal Jacobian row n_c
/// and two tangential rows t_c, orthonormal in the world: n_c q is the separation speed of its two sides, t_c
/// q their slip velocity.
///
///   minimise ½ (q − q₀)ᵀ M (q − q₀) + Σ R_c |t_c q − b_c|   over q with n_c q ≥ û_c
///
/// Its multipliers are impulses, q = q₀ + M⁻¹ Jᵀλ: normal λ ≥ 0 with λ (n q − û) = 0, tangential |λ_t| ≤ R,
/// equal to R and opposite to t q − b where that is not zero. With R = 0 and û = 0 it is the projection onto
/// the cone of motions that do not penetrate.
///
/// Method: augmented Lagrangian (multipliers of Hestenes and Powell; Rockafellar, Math. Programming 5, 1973),
/// each of its smooth convex subproblems solved by semismooth Newton, in which the sign of its multiplier
/// makes a contact active or not. No LCP by pivoting, and no factorisation of J M⁻¹ Jᵀ: both single out one
/// of several equivalent contacts (four corners are redundant, and which three are kept decides the
/// rounding). Here all contacts are treated alike, the factorised matrix is M plus a positive semidefinite
/// term, in the bodies' coordinates, which no redundancy makes singular, and every sum over contacts is an
/// orderFreeSum. So the order of the contacts changes no bit, a mirrored problem gives the mirrored bits, and
/// redundant contacts share their load evenly. The order of the bodies does affect the rounding.
class ImpactSolver {
 public:
  static constexpr int kAxes = 6;  ///< numbers per body
  static constexpr int kNobody = -1;
  using Row = std::array<double, static_cast<std::size_t>(2 * kAxes)>;  ///< a's six, then b's

  struct Contact {
    int a = kNobody;  ///< index of a movable body, or kNobody: its part of the rows is zero
    int b = kNobody;
    std::array<Row, 3> rows{};  ///< normal, tangent, tangent
    double normalMass = 0;      ///< [kg] effective mass 1/(n M⁻¹ nᵀ)
    double tangentialMass = 0;  ///< [kg] 2/(trace of t M⁻¹ tᵀ)
  };

  /// Impulses at one contact [N s]: normal, tangent, tangent.
  using Impulse = std::array<double, 3>;

  /// Conditions at one contact.
  struct Demand {
    bool included = true;          ///< otherwise no impulse, no condition
    double partingSpeed = 0;       ///< [m/s] û
    double frictionLimit = 0;      ///< [N s] R
    std::array<double, 2> slip{};  ///< [m/s] b
  };

  /// Takes 1/M (six per body, 0: immovable along that axis) and the contacts; uses their memory resource.
  ImpactSolver(ImpactVector<double> inverseMass, ImpactVector<Contact> contacts);

  const ImpactVector<Contact>& contacts() const { return contacts_; }
  std::span<const double> inverseMass() const { return inverseMass_; }

  /// n q, t₁ q or t₂ q of a contact [m/s].
  double speed(std::size_t contact, int row, std::span<const double> q) const;
  /// Largest Σ|n_k q_k| over the contacts [m/s]: the scale for the rounding error of their speeds.
  double speedScale(std::span<const double> q) const;
  /// q = q₀ + M⁻¹ Jᵀλ.
  void after(std::span<const double> q0, std::span<const Impulse> impulses, ImpactVector<double>& q);
  /// ½ qᵀ M q [J]; without immovable axes.
  double energy(std::span<const double> q) const;

  /// Solves the problem; `impulses` is the initial guess (warm start) on entry, the solution on return.
  /// Returns true if the conditions hold to rounding error; otherwise they hold as well as was reached, or to
  /// `accuracy`, which is relative to the scale of speeds.
  bool solve(std::span<const double> q0, std::span<const Demand> demands, ImpactVector<Impulse>& impulses,
             double accuracy = kFullAccuracy);
  static constexpr double kFullAccuracy = 0x1p-53;

 private:
  struct Touch {  // one contact seen by one body, or by a pair
    std::size_t contact;
    std::size_t first;   // offset of the first body's six in the row
    std::size_t second;  // offset of the second's
  };
  struct Block {  // bodies p ≥ q and the contacts that involve both
    int p;
    int q;
    ImpactVector<Touch> touches;
  };
  enum class State : unsigned char { kOff, kOn, kStick, kSlip };
  struct Response {  // of the smooth subproblem at one contact, at a trial velocity
    Impulse impulse{};
    State normal = State::kOff;
    State tangent = State::kOff;
    std::array<double, 3> stiffness{};  // tangential, as multiple of the penalty: 11, 12, 22

    /// Whether the second derivative is the same up to a tolerance: the penalty amplifies small differences.
    bool feelsLike(const Response& other) const {
      bool same = normal == other.normal && tangent == other.tangent;
      for (std::size_t k = 0; k < stiffness.size(); ++k) {
        same = same && std::fabs(stiffness[k] - other.stiffness[k]) <= 0x1p-26;
      }
      return same;
    }
  };
  using Six = std::array<double, static_cast<std::size_t>(kAxes)>;

  std::pmr::memory_resource* memory() const { return inverseMass_.get_allocator().resource(); }
  Response respond(const Contact& contact, const Demand& demand, const Impulse& guess,
                   const Impulse& excess) const;
  void respondAll(std::span<const Demand> demands, std::span<const Impulse> impulses);
  void gradient(std::span<const Impulse> impulses);
  void newtonStep();
  double along() const;
  void minimise(std::span<const double> q, std::span<const Demand> demands, std::span<const Impulse> impulses,
                double accuracy);
  double lineSearch(std::span<const Demand> demands, std::span<const Impulse> impulses, bool trusted);
  double violation(std::span<const double> q, std::span<const Demand> demands,
                   std::span<const Impulse> impulses);
  void assemble();
  void assembleBlock(const Block& block);

  ImpactVector<double> inverseMass_;
  ImpactVector<double> mass_;
  ImpactVector<Contact> contacts_;
  ImpactVector<ImpactVector<Touch>> touchesOf_;
  ImpactVector<Block> blocks_;

  // Workspace of solve: allocated by its first call only.
  ImpactVector<Impulse> excess_;       // n q − û, t q − b at the outer iterate
  ImpactVector<Impulse> best_;         // the best outer iterate so far
  ImpactVector<double> q_;             // velocities at the outer iterate
  ImpactVector<Response> responses_;   // at the inner iterate
  ImpactVector<Response> previous_;    // at the previous one
  ImpactVector<Response> factorised_;  // those that matrix_ was assembled from
  ImpactVector<double> z_;             // inner iterate, measured from the outer one
  ImpactVector<double> from_;          // the previous one
  ImpactVector<double> gradient_;
  ImpactVector<double> step_;
  ImpactVector<double> matrix_;  // lower triangle, row-major, then its L D Lᵀ
  ImpactVector<Six> terms_;
};

}  // namespace careen
