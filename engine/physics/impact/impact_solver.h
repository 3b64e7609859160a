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

/// The convex problem inside every impact of several contacts at once.
///
/// Velocities q are six numbers per body, the centre's velocity in the world and ω in the body's frame, so
/// that the kinetic energy ½ qᵀMq has a diagonal M. Contact c has a normal row n_c and two tangential rows
/// t_c, orthonormal in the world: n_c q is the speed at which its two sides part, t_c q how they slip.
///
///   minimise ½ (q − q₀)ᵀ M (q − q₀) + Σ R_c |t_c q − b_c|   over q with n_c q ≥ û_c
///
/// Its multipliers are impulses, q = q₀ + M⁻¹ Jᵀλ: normal λ ≥ 0 with λ (n q − û) = 0, tangential |λ_t| ≤ R,
/// equal to R and against t q − b where that does not vanish. With R = 0 and û = 0 it is the projection onto
/// the cone of motions that do not penetrate.
///
/// Method: augmented Lagrangian (multipliers of Hestenes and Powell; Rockafellar, Math. Programming 5, 1973),
/// each of its smooth convex subproblems by semismooth Newton, in which a contact is switched on or off as
/// its multiplier says. Not an LCP by pivoting, and no factorisation of J M⁻¹ Jᵀ: both single out a contact
/// among equals (four corners are redundant, and which three are kept decides the rounding). Here every
/// contact is treated alike, the factorised matrix is M plus something positive, in the bodies' coordinates,
/// which no redundancy makes singular, and every sum over contacts is an orderFreeSum. So the order of the
/// contacts changes no bit, a mirrored problem gives the mirrored bits, and redundant contacts share their
/// load evenly. The order of the bodies does enter the rounding.
class ImpactSolver {
 public:
  static constexpr int kAxes = 6;  ///< numbers per body
  static constexpr int kNobody = -1;
  using Row = std::array<double, static_cast<std::size_t>(2 * kAxes)>;  ///< a's six, then b's

  struct Contact {
    int a = kNobody;  ///< index of a movable body, kNobody: the row's part for it is zero
    int b = kNobody;
    std::array<Row, 3> rows{};  ///< normal, tangent, tangent
    double normalMass = 0;      ///< [kg] 1/(n M⁻¹ nᵀ)
    double tangentialMass = 0;  ///< [kg] 2/(trace of t M⁻¹ tᵀ)
  };

  /// Impulses at one contact [N s]: normal, tangent, tangent.
  using Impulse = std::array<double, 3>;

  /// What is asked of one contact.
  struct Demand {
    bool included = true;          ///< left out: no impulse, no condition
    double partingSpeed = 0;       ///< [m/s] û
    double frictionLimit = 0;      ///< [N s] R
    std::array<double, 2> slip{};  ///< [m/s] b
  };

  /// Takes 1/M (six per body, 0: immovable along it) and the contacts, and all memory from where theirs is.
  ImpactSolver(ImpactVector<double> inverseMass, ImpactVector<Contact> contacts);

  const ImpactVector<Contact>& contacts() const { return contacts_; }
  std::span<const double> inverseMass() const { return inverseMass_; }

  /// n q, t₁ q or t₂ q of a contact [m/s].
  double speed(std::size_t contact, int row, std::span<const double> q) const;
  /// Largest Σ|n_k q_k| over the contacts [m/s]: what the rounding of their speeds is measured against.
  double speedScale(std::span<const double> q) const;
  /// q = q₀ + M⁻¹ Jᵀλ.
  void after(std::span<const double> q0, std::span<const Impulse> impulses, ImpactVector<double>& q);
  /// ½ qᵀ M q [J]; what immovable axes hold is left out.
  double energy(std::span<const double> q) const;

  /// Solves the problem; `impulses` is the first guess on entry, the solution on return. True when the
  /// conditions hold to rounding error; otherwise they are as good as was reached, or as `accuracy` asks,
  /// which is relative to the scale of speeds.
  bool solve(std::span<const double> q0, std::span<const Demand> demands, ImpactVector<Impulse>& impulses,
             double accuracy = kFullAccuracy);
  static constexpr double kFullAccuracy = 0x1p-53;

 private:
  struct Touch {  // one contact seen by one body, or by a pair
    std::size_t contact;
    std::size_t first;   // where the first body's six stand in the row
    std::size_t second;  // where the second's do
  };
  struct Block {  // bodies p ≥ q and the contacts both take part in
    int p;
    int q;
    ImpactVector<Touch> touches;
  };
  enum class State : unsigned char { kOff, kOn, kStick, kSlip };
  struct Response {  // what the smooth subproblem says of a contact at a trial velocity
    Impulse impulse{};
    State normal = State::kOff;
    State tangent = State::kOff;
    std::array<double, 3> stiffness{};  // of the tangents, as multiple of the penalty: 11, 12, 22

    /// The subproblem has the same second derivative, or nearly so: the penalty makes much of little.
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

  // Workspace of solve: nothing is allocated there after the first time.
  ImpactVector<Impulse> excess_;       // n q − û, t q − b at the outer iterate
  ImpactVector<Impulse> best_;         // the best outer iterate so far
  ImpactVector<double> q_;             // velocities at the outer iterate
  ImpactVector<Response> responses_;   // at the inner iterate
  ImpactVector<Response> previous_;    // at the one before
  ImpactVector<Response> factorised_;  // those that matrix_ was made of
  ImpactVector<double> z_;             // inner iterate, measured from the outer one
  ImpactVector<double> from_;          // the one before
  ImpactVector<double> gradient_;
  ImpactVector<double> step_;
  ImpactVector<double> matrix_;  // lower triangle by rows, then its L D Lᵀ
  ImpactVector<Six> terms_;
};

}  // namespace careen
