#include "physics/pile/displacement_solver.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace careen {
namespace {

/// [1] of the first step: more steps gain little.
constexpr double kLittle = 0.003;
/// [1] of 1/(largest eigenvalue): length of steps along the gradient.
constexpr double kGradientStep = 0.9;
constexpr int kPowerSteps = 12;
constexpr int kNothing = 0;  // in own_

CAREEN_LANES double dot(const std::vector<double>& a, const std::vector<double>& b) {
  Lanes sum{};
  for (std::size_t k = 0; k < a.size(); k += kLanes) {
    sum += lanesFrom(&a[k]) * lanesFrom(&b[k]);
  }
  return sumOf(sum);
}

}  // namespace

void DisplacementSolver::begin(std::span<const PileBody> bodies) {
  bodies_ = bodies;
  members_.assign(bodies.size(), kNothing);
  own_.assign(1, {});
  moves_.assign(1, {});
  blocks_.clear();
  rows_.clear();
  bounds_.clear();
  perScale_.clear();
}

int DisplacementSolver::memberOf(int body) {
  if (body == kNobody || bodies_[at(body)].still()) {
    return kNothing;
  }
  if (members_[at(body)] == kNothing) {
    members_[at(body)] = static_cast<int>(own_.size());
    const Mat3 axes = bodies_[at(body)].principalAxes();
    own_.push_back(
        {.inverseMass = bodies_[at(body)].inverseMass,
         .inverseInertia = axes * bodies_[at(body)].inverseInertiaBody.asDiagonal() * axes.transpose()});
  }
  return members_[at(body)];
}

void DisplacementSolver::add(const Row& row) {
  const int a = memberOf(row.a);
  const int b = memberOf(row.b);
  const auto perMassOf = [&](int member, const Vec3& arm) {
    const Vec3 turning = arm.cross(row.normal);
    return own_[at(member)].inverseMass + turning.dot(own_[at(member)].inverseInertia * turning);
  };
  const double perMass = perMassOf(a, row.armA) + perMassOf(b, row.armB);
  if (perMass == 0) {
    return;
  }
  if (blocks_.empty() || blocks_.back().a != a || blocks_.back().b != b ||
      blocks_.back().normal != row.normal) {
    blocks_.push_back({.a = a, .b = b, .normal = row.normal});
  }
  const double scale = 1 / std::sqrt(perMass);
  rows_.push_back({.armA = row.armA, .armB = row.armB, .scale = scale});
  blocks_.back().end = rows_.size();
  bounds_.push_back(scale * row.bound);
  perScale_.push_back(1 / scale);
}

// (J M⁻¹ Jᵀ + c) λ; moves_ are M⁻¹ Jᵀ λ then. Rows of a block share the normal n: with turns θ, that of a
// point is n·(θ × r) = r·(n × θ).
CAREEN_LANES void DisplacementSolver::apply(const Values& impulses, Values& result) {
  moves_.assign(own_.size(), {});
  std::size_t k = 0;
  for (const Block& block : blocks_) {
    bool acts = false;
    double sum = 0;
    Vec3 atA = Vec3::Zero();
    Vec3 atB = Vec3::Zero();
    for (; k < block.end; ++k) {
      const double impulse = rows_[k].scale * impulses[k];
      acts = acts || impulse != 0;
      sum += impulse;
      atA += impulse * rows_[k].armA;
      atB += impulse * rows_[k].armB;
    }
    if (acts) {
      Move& a = moves_[at(block.a)];
      Move& b = moves_[at(block.b)];
      a.shift += sum * block.normal;
      a.turn += atA.cross(block.normal);
      b.shift -= sum * block.normal;
      b.turn -= atB.cross(block.normal);
    }
  }
  for (std::size_t i = 0; i < own_.size(); ++i) {
    moves_[i].shift *= own_[i].inverseMass;
    moves_[i].turn = Vec3(own_[i].inverseInertia * moves_[i].turn);
  }
  k = 0;
  for (const Block& block : blocks_) {
    const Move& a = moves_[at(block.a)];
    const Move& b = moves_[at(block.b)];
    const double opened = block.normal.dot(a.shift - b.shift);
    const Vec3 byTurnA = block.normal.cross(a.turn);
    const Vec3 byTurnB = block.normal.cross(b.turn);
    for (; k < block.end; ++k) {
      const ScaledRow& row = rows_[k];
      result[k] =
          row.scale * (opened + (row.armA.dot(byTurnA) - row.armB.dot(byTurnB))) + kCompliance * impulses[k];
    }
  }
}

// By powers: a little too small.
CAREEN_LANES double DisplacementSolver::largestEigenvalue() {
  std::minstd_rand random;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    ahead_[k] = random() % 2 == 0 ? 1 : -1;
  }
  double largest = 1;
  for (int step = 0; step < kPowerSteps; ++step) {
    const double before = dot(ahead_, ahead_);
    apply(ahead_, next_);
    const double after = dot(next_, next_);
    largest = std::sqrt(after / before);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      ahead_[k] = next_[k] / std::sqrt(after);
    }
  }
  return largest;
}

CAREEN_LANES int DisplacementSolver::solveInLanes(double enough, int most) {
  const std::size_t padded = (rows_.size() + kLanes - 1) / kLanes * kLanes;
  for (Values* values : {&impulses_, &ahead_, &next_}) {
    values->assign(padded, 0);
  }
  bounds_.resize(padded);
  perScale_.resize(padded);
  const double length = rows_.empty() ? 0 : kGradientStep / largestEigenvalue();
  std::fill(ahead_.begin(), ahead_.end(), 0);
  double first = 0;
  double inertia = 1;
  int taken = 0;
  for (; taken < most; ++taken) {
    apply(ahead_, next_);
    Lanes lacking{};
    Lanes back{};
    Lanes step{};
    for (std::size_t k = 0; k < padded; k += kLanes) {
      const Lanes gradient = lanesFrom(&next_[k]) - lanesFrom(&bounds_[k]);
      const Lanes ahead = lanesFrom(&ahead_[k]);
      const Lanes next = largerOf(Lanes{}, ahead - length * gradient);
      lacking = largerOf(lacking, -gradient * lanesFrom(&perScale_[k]));
      back += gradient * (next - lanesFrom(&impulses_[k]));
      step += (next - ahead) * (next - ahead);
      lanesTo(next, &next_[k]);
    }
    const double far = std::sqrt(sumOf(step));
    first = taken == 0 ? far : first;
    if (largestOf(lacking) <= enough || far < kLittle * first) {
      break;
    }
    const double before = inertia;
    inertia = sumOf(back) > 0 ? 1 : 0.5 * (1 + std::sqrt(1 + 4 * before * before));
    const double onward = inertia > 1 ? (before - 1) / inertia : 0;
    for (std::size_t k = 0; k < padded; k += kLanes) {
      const Lanes next = lanesFrom(&next_[k]);
      lanesTo(largerOf(Lanes{}, next + onward * (next - lanesFrom(&impulses_[k]))), &ahead_[k]);
    }
    impulses_.swap(next_);
  }
  return taken;
}

int DisplacementSolver::solve(double enough, int most) {
  int taken = 0;
  const auto work = [&]() __attribute__((always_inline)) { taken = solveInLanes(enough, most); };
  if (hasWideLanes()) {
    runWide(work);
  } else {
    work();
  }
  return taken;
}

}  // namespace careen
