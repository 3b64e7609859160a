#include "physics/pile/displacement_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {
namespace {

/// [1] of the first gradient: more steps gain little.
constexpr double kLittle = 0.03;
/// [1] of 1/(largest eigenvalue): length of steps along the gradient; less than 2.
constexpr double kGradientStep = 1.6;
constexpr int kPowerSteps = 12;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum += a[k] * b[k];
  }
  return sum;
}

}  // namespace

void DisplacementSolver::begin(std::span<const PileBody> bodies) {
  bodies_ = bodies;
  members_.assign(bodies.size(), kNobody);
  own_.clear();
  rows_.clear();
}

int DisplacementSolver::memberOf(int body) {
  if (body == kNobody || bodies_[at(body)].still()) {
    return kNobody;
  }
  if (members_[at(body)] == kNobody) {
    members_[at(body)] = static_cast<int>(own_.size());
    const Mat3 axes = bodies_[at(body)].principalAxes();
    own_.push_back(
        {.inverseMass = bodies_[at(body)].inverseMass,
         .inverseInertia = axes * bodies_[at(body)].inverseInertiaBody.asDiagonal() * axes.transpose()});
  }
  return members_[at(body)];
}

void DisplacementSolver::add(const Row& row) {
  ScaledRow scaled = {.a = memberOf(row.a), .b = memberOf(row.b)};
  scaled.onA = {.shift = row.normal, .turn = row.armA.cross(row.normal)};
  scaled.onB = {.shift = -row.normal, .turn = -row.armB.cross(row.normal)};
  double perMass = 0;
  const auto include = [&](int member, const Move& on) {
    if (member != kNobody) {
      perMass += own_[at(member)].inverseMass + on.turn.dot(own_[at(member)].inverseInertia * on.turn);
    }
  };
  include(scaled.a, scaled.onA);
  include(scaled.b, scaled.onB);
  if (perMass == 0) {
    return;
  }
  scaled.scale = 1 / std::sqrt(perMass);
  for (Move* on : {&scaled.onA, &scaled.onB}) {
    on->shift *= scaled.scale;
    on->turn *= scaled.scale;
  }
  scaled.bound = scaled.scale * row.bound;
  rows_.push_back(scaled);
}

// (J M⁻¹ Jᵀ + c) λ; moves_ are M⁻¹ Jᵀ λ then.
void DisplacementSolver::apply(const Values& impulses, Values& result) {
  moves_.assign(own_.size(), {});
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const auto push = [&](int member, const Move& on) {
      if (member != kNobody) {
        moves_[at(member)].shift += impulses[k] * on.shift;
        moves_[at(member)].turn += impulses[k] * on.turn;
      }
    };
    if (impulses[k] != 0) {
      push(rows_[k].a, rows_[k].onA);
      push(rows_[k].b, rows_[k].onB);
    }
  }
  for (std::size_t i = 0; i < own_.size(); ++i) {
    moves_[i].shift *= own_[i].inverseMass;
    moves_[i].turn = Vec3(own_[i].inverseInertia * moves_[i].turn);
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    double opened = kCompliance * impulses[k];
    const auto add = [&](int member, const Move& on) {
      if (member != kNobody) {
        opened += on.shift.dot(moves_[at(member)].shift) + on.turn.dot(moves_[at(member)].turn);
      }
    };
    add(rows_[k].a, rows_[k].onA);
    add(rows_[k].b, rows_[k].onB);
    result[k] = opened;
  }
}

// By powers: a little too small.
double DisplacementSolver::largestEigenvalue() {
  direction_.assign(rows_.size(), 1);
  double largest = 1;
  for (int step = 0; step < kPowerSteps; ++step) {
    const double before = dot(direction_, direction_);
    apply(direction_, applied_);
    const double after = dot(applied_, applied_);
    largest = std::sqrt(after / before);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      direction_[k] = applied_[k] / std::sqrt(after);
    }
  }
  return largest;
}

void DisplacementSolver::findGradient() {
  apply(impulses_, gradient_);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    gradient_[k] -= rows_[k].bound;
  }
}

// The direction of steepest descent, up to its sign, among those that push.
void DisplacementSolver::pointAlongGradient() {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    direction_[k] = impulses_[k] > 0 ? gradient_[k] : 0;
  }
}

// So far along the direction that the first of them ends to push; then along the gradient, where more may.
void DisplacementSolver::leaveFace(double step, double length) {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (impulses_[k] > 0) {
      const double ahead = impulses_[k] - step * direction_[k];
      const double gradient = gradient_[k] - step * applied_[k];
      impulses_[k] = ahead > 0 ? std::max(0.0, ahead - length * gradient) : 0;
    }
  }
  findGradient();
  pointAlongGradient();
}

int DisplacementSolver::solve(double enough, int most) {
  const std::size_t count = rows_.size();
  impulses_.assign(count, 0);
  gradient_.resize(count);
  applied_.resize(count);
  const double length = count == 0 ? 0 : kGradientStep / largestEigenvalue();
  findGradient();
  pointAlongGradient();
  double first = 0;
  int taken = 0;
  for (; taken < most; ++taken) {
    double blocked = 0;  // squares of the parts of the gradient: of rows that lack something but do not push,
    double free = 0;     // and of those that push
    double lacking = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (impulses_[k] > 0) {
        free += gradient_[k] * std::min(gradient_[k], impulses_[k] / length);
      } else {
        blocked += std::min(gradient_[k], 0.0) * gradient_[k];
      }
      lacking = std::max(lacking, -gradient_[k] / rows_[k].scale);
    }
    const double left = std::sqrt(blocked + std::max(free, 0.0));
    first = taken == 0 ? left : first;
    if (lacking <= enough || left < kLittle * first) {
      break;
    }
    const bool enters = blocked > free;
    for (std::size_t k = 0; enters && k < count; ++k) {
      direction_[k] = impulses_[k] > 0 ? 0 : std::min(gradient_[k], 0.0);
    }
    apply(direction_, applied_);
    const double curvature = dot(direction_, applied_);
    const double step = dot(gradient_, direction_) / curvature;
    double farthest = std::numeric_limits<double>::max();
    for (std::size_t k = 0; !enters && k < count; ++k) {
      if (direction_[k] > 0) {
        farthest = std::min(farthest, impulses_[k] / direction_[k]);
      }
    }
    if (step > farthest) {
      leaveFace(farthest, length);
      continue;
    }
    for (std::size_t k = 0; k < count; ++k) {
      impulses_[k] = std::max(0.0, impulses_[k] - step * direction_[k]);
      gradient_[k] -= step * applied_[k];
    }
    if (enters) {
      pointAlongGradient();
      continue;
    }
    double along = 0;
    for (std::size_t k = 0; k < count; ++k) {
      along += impulses_[k] > 0 ? gradient_[k] * applied_[k] : 0;
    }
    for (std::size_t k = 0; k < count; ++k) {
      direction_[k] = (impulses_[k] > 0 ? gradient_[k] : 0) - along / curvature * direction_[k];
    }
  }
  apply(impulses_, applied_);
  return taken;
}

}  // namespace careen
