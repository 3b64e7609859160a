#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "physics/solver/block_lu.h"
#include "physics/solver/contact_problem.h"
#include "physics/solver/impulse_set.h"

namespace careen {

/// A ContactProblem in the order in which it is eliminated, and the linear algebra that all its methods
/// share.
///
/// Bodies are eliminated by minimum degree (A. George, J. W. H. Liu, SIAM Review 31, 1989); which of several
/// comes first follows from masses, velocities, contacts and those of neighbours, and only then from the
/// listing. The order and the pattern of the factors are kept while the graph stays the same.
class CoupledContacts {
 public:
  static constexpr std::size_t kAxes = ContactProblem::kAxes;
  static constexpr int kNobody = ContactProblem::kNobody;
  using Row = ContactProblem::Row;
  using Triple = ContactProblem::Triple;

  struct Contact : ImpulseSet {
    int a = kNobody;  // position in the order of elimination
    int b = kNobody;
    std::array<Row, 3> rows{};
    Triple target{};
    std::array<std::size_t, 4> blocks{};  // of (a, a), (a, b), (b, a), (b, b)
  };

  void set(const ContactProblem& problem);

  std::size_t bodies() const { return order_.size(); }
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Index in the problem of contact `c`.
  std::size_t listed(std::size_t c) const { return keys_[c].listed; }
  /// [m/s] V, see ContactSolution.
  double scale() const { return scale_; }
  /// [m/s] S, see ContactResiduals: V, or the largest |J_ij q₀_j| or |target_i| if that is larger.
  double speed() const { return std::max(scale_, noise_ / kNoise); }
  /// [m/s] What rounding errors in u may amount to.
  double noise() const { return noise_; }

  /// [1] The largest ratio of the masses of two bodies in contact.
  double heaviest() const;
  /// [1] The largest mass of a body over the least effective mass of a contact.
  double spread() const;
  /// [m/s] λ/mass, of normal impulses and of all in space.
  double largest(std::span<const Triple> impulses) const;

  // Velocities q below are in the order of elimination, impulses in that of contacts().
  void velocities(std::span<const Triple> impulses, std::span<double> q) const;
  void relativeVelocities(std::span<const double> q, std::span<Triple> u) const;
  Triple relativeVelocity(const Contact& contact, std::span<const double> q) const;
  /// J dq of one contact.
  Triple change(const Contact& contact, std::span<const double> dq) const;

  /// M + Σ Jᵀ stiffness J. Returns false if it could not be factorised.
  bool factorise(std::span<const ContactAnswer> answers);
  /// Whether the determinant of what was factorised is negative.
  bool isNegative() const { return matrix_.isNegative(); }
  /// dq of the velocities q + dq at which q + dq = q₀ + M⁻¹Jᵀ(given − stiffness J dq).
  void step(std::span<const ContactAnswer> answers, std::span<const double> q, std::span<double> dq) const;

  /// λ of contact `c` after the step dq.
  Triple answerTo(std::size_t c, const ContactAnswer& answer, std::span<const double> dq) const;

  void importImpulses(std::span<const Triple> listed, std::span<Triple> impulses) const;
  void exportImpulses(std::span<const Triple> impulses, std::vector<Triple>& listed) const;
  void exportVelocities(std::span<const double> q, std::vector<double>& listed) const;

 private:
  static constexpr double kNoise = 0x1p-50;  // [1] of the largest term of a relative velocity
  bool hasGraphOf(const ContactProblem& problem) const;
  void order(const ContactProblem& problem);
  struct Key {
    std::pair<int, int> bodies;
    std::array<double, 4> numbers{};
    std::size_t listed = 0;
    bool operator<(const Key& other) const {
      return std::tie(bodies, numbers, listed) < std::tie(other.bodies, other.numbers, other.listed);
    }
  };

  void copyContacts(const ContactProblem& problem);
  int placeOf(int listed) const;
  Key keyOf(const ContactProblem::Contact& from, std::size_t listed) const;
  void weigh(Contact& contact);
  using Six = std::array<double, kAxes>;
  struct Touch {  // one side of a contact
    std::size_t contact;
    std::size_t side;
  };
  struct Part {  // what a contact adds to a block
    std::size_t block;
    std::size_t contact;
    std::size_t from;
    std::size_t to;
  };
  void findTies();
  void addWithoutOrder(std::span<const ContactAnswer> answers);
  template <class ImpulseOf>
  void pushAll(const ImpulseOf& impulseOf, std::span<double> onto) const;
  void push(const Contact& contact, const Triple& impulse, std::span<double> onto) const;
  void add(const Contact& contact, const std::array<double, 9>& stiffness);

  std::vector<std::array<int, 2>> graph_;           // of the listing
  std::vector<std::size_t> order_;                  // listed index of the body eliminated as k-th
  std::vector<std::size_t> place_;                  // its inverse
  std::vector<std::array<std::size_t, 4>> blocks_;  // of each contact as listed
  std::vector<Key> keys_;                           // of contacts_
  std::vector<Contact> contacts_;
  std::vector<double> mass_;
  std::vector<double> inverseMass_;
  std::vector<double> free_;
  BlockLu matrix_;
  double scale_ = 0;
  double noise_ = 0;
  bool hasTies_ = false;                     // then sums are formed without order, from these
  std::vector<std::vector<Touch>> touches_;  // by body
  std::vector<Part> parts_;                  // by block
};

}  // namespace careen
