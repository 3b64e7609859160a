#include "audit/cone.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace careen {
namespace {

constexpr int kSides = 12;
constexpr double kDual = 1e-12;  // [1] of the impulse: directions that gain no more are of no use
constexpr int kMostPasses = 100;

std::vector<Vec3> edgesOf(const std::vector<WallForce>& walls) {
  std::vector<Vec3> edges;
  for (const WallForce& wall : walls) {
    if (wall.friction == 0) {
      edges.push_back(wall.normal);
      continue;
    }
    const Vec3 x = wall.normal.unitOrthogonal();
    const Vec3 y = wall.normal.cross(x);
    const double slope = wall.friction / std::cos(std::numbers::pi / kSides);
    for (int side = 0; side < kSides; ++side) {
      const double angle = 2 * std::numbers::pi * side / kSides;
      edges.push_back((wall.normal + slope * (std::cos(angle) * x + std::sin(angle) * y)).normalized());
    }
  }
  return edges;
}

/// Non-negative least squares by active sets (Lawson and Hanson 1974, chapter 23), in three dimensions: at
/// most three edges carry.
class NearestInCone {
 public:
  NearestInCone(Vec3 target, const std::vector<Vec3>& edges)
      : target_(std::move(target)), edges_(edges), shares_(edges.size(), 0) {}

  Vec3 residual() {
    for (int pass = 0; pass < kMostPasses && enter(); ++pass) {
      fit();
    }
    return rest();
  }

 private:
  Vec3 rest() const {
    Vec3 rest = target_;
    for (const std::size_t k : carrying_) {
      rest -= shares_[k] * edges_[k];
    }
    return rest;
  }

  // Takes in the edge that helps most.
  bool enter() {
    const Vec3 left = rest();
    double best = kDual * target_.norm();
    std::size_t chosen = edges_.size();
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      if (shares_[k] == 0 && edges_[k].dot(left) > best) {
        best = edges_[k].dot(left);
        chosen = k;
      }
    }
    if (chosen == edges_.size() || carrying_.size() == 3) {
      return false;
    }
    carrying_.push_back(chosen);
    return true;
  }

  // Least squares over the carrying edges; those that would pull leave.
  void fit() {
    while (!carrying_.empty()) {
      Eigen::MatrixXd matrix(3, static_cast<Eigen::Index>(carrying_.size()));
      for (std::size_t i = 0; i < carrying_.size(); ++i) {
        matrix.col(static_cast<Eigen::Index>(i)) = edges_[carrying_[i]];
      }
      const Eigen::VectorXd wanted = matrix.colPivHouseholderQr().solve(target_);
      if (approach(wanted)) {
        return;
      }
    }
  }

  // Goes towards the wanted shares until one of them vanishes; whether none does.
  bool approach(const Eigen::VectorXd& wanted) {
    double part = 1;
    for (std::size_t i = 0; i < carrying_.size(); ++i) {
      const double goal = wanted[static_cast<Eigen::Index>(i)];
      const double now = shares_[carrying_[i]];
      if (goal <= 0) {
        part = std::min(part, now / std::max(now - goal, std::numeric_limits<double>::min()));
      }
    }
    std::vector<std::size_t> left;
    bool whole = true;
    for (std::size_t i = 0; i < carrying_.size(); ++i) {
      const double goal = wanted[static_cast<Eigen::Index>(i)];
      double& share = shares_[carrying_[i]];
      share += part * (goal - share);
      if (goal <= 0 && share <= kDual * target_.norm()) {
        share = 0;
        whole = false;
      } else {
        left.push_back(carrying_[i]);
      }
    }
    carrying_ = std::move(left);
    return whole;
  }

  Vec3 target_;
  const std::vector<Vec3>& edges_;
  std::vector<double> shares_;
  std::vector<std::size_t> carrying_;
};

}  // namespace

Vec3 beyondWalls(const Vec3& impulse, const std::vector<WallForce>& walls) {
  if (walls.empty() || impulse.isZero(0) || !impulse.allFinite()) {
    return impulse;
  }
  const std::vector<Vec3> edges = edgesOf(walls);
  return NearestInCone(impulse, edges).residual();
}

}  // namespace careen
