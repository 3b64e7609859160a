#include "physics/solver/least_forces.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "core/math/linear_algebra.h"

namespace careen {
namespace {

using Vector = Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using Force = Eigen::Vector3d;

// Relative to a matrix and a right-hand side whose largest are 1.
constexpr double kFirstProximal = 0x1p-10;
constexpr double kLessProximal = 0x1p-4;
constexpr double kMuchLessProximal = 0x1p-10;
constexpr double kLastProximal = 0x1p-30;
constexpr double kOfLeft = 0x1p-10;   // [1] of what is left: so well it is known
constexpr double kHardlyLess = 0.75;  // [1] of what was left
constexpr double kSolved = 0x1p-46;
constexpr int kMostCentres = 24;
constexpr int kMostSteps = 64;
constexpr int kMostHalvings = 30;
constexpr double kDescends = 0x1p-10;  // [1] of the descent that the slope promises

/// The force of a contact's set that is nearest to a given one, and how it changes with that.
struct NearestForce {
  Force force = Force::Zero();
  Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
};

NearestForce onRay(const Force& ray, const Force& given) {
  const double share = careen::dot(ray, given) / ray.squaredNorm();
  return share < 0 ? NearestForce{}
                   : NearestForce{.force = share * ray, .change = ray * ray.transpose() / ray.squaredNorm()};
}

NearestForce inCone(double friction, const Force& given) {
  const double size = std::sqrt(given[1] * given[1] + given[2] * given[2]);
  if (size <= friction * given[0]) {
    return {.force = given, .change = Eigen::Matrix3d::Identity()};
  }
  if (friction * size <= -given[0]) {
    return {};
  }
  const Eigen::Vector2d along = given.tail<2>() / size;
  NearestForce nearest = onRay({1, friction * along[0], friction * along[1]}, given);
  const Force across(0, -along[1], along[0]);
  nearest.change += (friction * nearest.force[0] / size) * across * across.transpose();
  return nearest;
}

// `unit` [N]: of the given force; interval and force have it in common.
NearestForce nearestIn(const ContactProblem::Contact& contact, const Force& given, double unit) {
  using Set = ContactProblem::Admissible;
  switch (contact.admissible) {
    case Set::kSpace:
      return {.force = given, .change = Eigen::Matrix3d::Identity()};
    case Set::kLine:
      return onRay({1, -contact.friction * contact.slip[0], -contact.friction * contact.slip[1]}, given);
    case Set::kInterval: {
      NearestForce nearest;
      nearest.force[0] = std::clamp(given[0], contact.least / unit, contact.most / unit);
      nearest.change(0, 0) = nearest.force[0] == given[0] ? 1 : 0;
      return nearest;
    }
    case Set::kCone:
      break;
  }
  return given.isZero(0) ? NearestForce{.change = Eigen::Matrix3d::Identity()}
                         : inCone(contact.friction, given);
}

/// The problem in units in which the largest row and the right-hand side are 1: A λ = b, A = M^(−½) Jᵀ.
class DualOfForces {
 public:
  explicit DualOfForces(const ContactProblem& problem);

  LeastForces solve();

 private:
  struct At {
    double value = 0;
    Vector slope;
  };
  static Eigen::Index indexOf(std::size_t k) { return static_cast<Eigen::Index>(k); }
  void setRows();
  At at(const Vector& motion);
  bool step();

  const ContactProblem& problem_;
  Vector roots_;  // M^(−½)
  double row_ = 0;
  double size_ = 0;
  double unit_ = 1;  // [N]
  Sparse matrix_;
  Vector wanted_;
  Vector motion_;  // y
  Vector centre_;
  double proximal_ = kFirstProximal;
  Vector forces_;
  std::vector<Eigen::Matrix3d> changes_;
  At now_;
};

DualOfForces::DualOfForces(const ContactProblem& problem)
    : problem_(problem),
      roots_(Eigen::Map<const Vector>(problem.inverseMass.data(), indexOf(problem.inverseMass.size()))
                 .cwiseSqrt()),
      wanted_(
          -Eigen::Map<const Vector>(problem.free.data(), indexOf(problem.free.size())).cwiseQuotient(roots_)),
      motion_(Vector::Zero(wanted_.size())),
      centre_(motion_),
      forces_(Vector::Zero(indexOf(3 * problem.contacts.size()))),
      changes_(problem.contacts.size()) {
  size_ = wanted_.norm();
  setRows();
  if (size_ > 0 && row_ > 0) {
    matrix_ /= row_;
    wanted_ /= size_;
    unit_ = size_ / row_;
  }
}

void DualOfForces::setRows() {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < problem_.contacts.size(); ++c) {
    const ContactProblem::Contact& contact = problem_.contacts[c];
    for (std::size_t row = 0; row < 3; ++row) {
      double squares = 0;
      for (std::size_t k = 0; k < contact.rows[row].size(); ++k) {
        const int body = k < ContactProblem::kAxes ? contact.a : contact.b;
        if (body != ContactProblem::kNobody && contact.rows[row][k] != 0) {
          const Eigen::Index place =
              indexOf(ContactProblem::kAxes * static_cast<std::size_t>(body) + k % ContactProblem::kAxes);
          const double entry = roots_[place] * contact.rows[row][k];
          entries.emplace_back(place, indexOf(3 * c + row), entry);
          squares += entry * entry;
        }
      }
      row_ = std::max(row_, std::sqrt(squares));
    }
  }
  matrix_.resize(wanted_.size(), forces_.size());
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

// Sets forces and their changes.
DualOfForces::At DualOfForces::at(const Vector& motion) {
  const Vector given = matrix_.transpose() * motion;
  for (std::size_t c = 0; c < changes_.size(); ++c) {
    const NearestForce nearest = nearestIn(problem_.contacts[c], given.segment<3>(indexOf(3 * c)), unit_);
    forces_.segment<3>(indexOf(3 * c)) = nearest.force;
    changes_[c] = nearest.change;
  }
  const Vector way = motion - centre_;
  // Of a set that is no cone, ½|λ|² is not what is conjugate to its distance: λ·Jᵀy − ½|λ|².
  return {.value = careen::dot(forces_, given) - 0.5 * forces_.squaredNorm() - careen::dot(wanted_, motion) +
                   0.5 * proximal_ * way.squaredNorm(),
          .slope = matrix_ * forces_ - wanted_ + proximal_ * way};
}

// One of Newton's, shortened until it descends. Returns false if there is nothing but rounding left.
bool DualOfForces::step() {
  const double small =
      std::max(kSolved * (1 + forces_.norm()), kOfLeft * proximal_ * (motion_ - centre_).norm());
  const double before = now_.slope.norm();
  if (before <= small) {
    return false;
  }
  std::vector<Eigen::Triplet<double>> blocks;
  for (std::size_t c = 0; c < changes_.size(); ++c) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        blocks.emplace_back(indexOf(3 * c) + i, indexOf(3 * c) + j, changes_[c](i, j));
      }
    }
  }
  Sparse change(forces_.size(), forces_.size());
  change.setFromTriplets(blocks.begin(), blocks.end());
  Sparse bend = matrix_ * change * Sparse(matrix_.transpose());
  Sparse identity(wanted_.size(), wanted_.size());
  identity.setIdentity();
  bend += proximal_ * identity;
  const Eigen::SimplicialLDLT<Sparse> factors(bend);
  if (factors.info() != Eigen::Success) {
    return false;
  }
  const Vector way = factors.solve(Vector(-now_.slope));
  const double slope = careen::dot(now_.slope, way);
  double part = 1;
  for (int halving = 0; halving < kMostHalvings; ++halving, part /= 2) {
    const Vector there = motion_ + part * way;
    At next = at(there);
    if (next.value <= now_.value + kDescends * part * slope || next.slope.norm() <= before / 2) {
      motion_ = there;
      now_ = std::move(next);
      return true;
    }
  }
  now_ = at(motion_);
  return false;
}

LeastForces DualOfForces::solve() {
  LeastForces found;
  found.left = problem_.free;
  found.forces.resize(problem_.contacts.size());
  if (!(size_ > 0 && row_ > 0)) {
    return found;
  }
  now_ = at(motion_);
  double last = 2;
  for (int centres = 0; centres < kMostCentres; ++centres) {
    for (int steps = 0; steps < kMostSteps && step(); ++steps) {
    }
    const double left = (matrix_ * forces_ - wanted_).norm();
    const bool stalls = left > kHardlyLess * last;
    if (left <= kSolved || (stalls && proximal_ <= kLastProximal)) {
      break;
    }
    last = left;
    centre_ = motion_;
    proximal_ = std::max(kLastProximal, (stalls ? kMuchLessProximal : kLessProximal) * proximal_);
    now_ = at(motion_);
  }
  const Vector left = size_ * (matrix_ * forces_ - wanted_).cwiseProduct(roots_);
  found.left.assign(left.begin(), left.end());
  for (std::size_t c = 0; c < found.forces.size(); ++c) {
    const Force force = unit_ * forces_.segment<3>(indexOf(3 * c));
    found.forces[c] = {force[0], force[1], force[2]};
  }
  return found;
}

}  // namespace

LeastForces leastForces(const ContactProblem& problem) { return DualOfForces(problem).solve(); }

}  // namespace careen
