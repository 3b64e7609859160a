#include "physics/solver/displacement_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace careen {
namespace {

/// [1] of the first step: more steps gain little.
constexpr double kLittle = 0.003;
/// [1] of 1/(largest eigenvalue): length of steps along the gradient.
constexpr double kGradientStep = 0.9;
// Rows contradict each other if so many steps for each body do not bring what is off below [1] of what it
// was.
constexpr double kStalls = 0.999;
constexpr int kPatienceOfGradients = 100;
constexpr int kPowerSteps = 12;
constexpr std::size_t kBlocksPerRange = 32;

}  // namespace

void DisplacementSolver::begin(std::size_t bodies, double compliance) {
  compliance_ = compliance;
  members_.assign(bodies, kNothing);
  own_.assign(1, {});
  blocks_.clear();
}

void DisplacementSolver::setBody(int index, const Body& body) {
  members_[at(index)] = static_cast<int>(own_.size());
  own_.push_back(body);
}

void DisplacementSolver::add(const Row& row) {
  const int a = memberOf(row.a);
  const int b = memberOf(row.b);
  const auto perMassOf = [&](int member, const Vec3& arm) {
    const Vec3 turning = arm.cross(row.normal);
    return own_[at(member)].inverseMass + dot(turning, own_[at(member)].inverseInertia * turning);
  };
  const double perMass = perMassOf(a, row.armA) + perMassOf(b, row.armB);
  if (perMass == 0) {
    return;
  }
  if (blocks_.empty() || blocks_.back().rows == kLanes || blocks_.back().a != a || blocks_.back().b != b ||
      blocks_.back().normal != row.normal) {
    blocks_.push_back({.normal = row.normal, .a = a, .b = b});
  }
  Block& block = blocks_.back();
  const int lane = block.rows++;
  setLane(block.armA, lane, row.armA.x(), row.armA.y(), row.armA.z());
  setLane(block.armB, lane, row.armB.x(), row.armB.y(), row.armB.z());
  block.scale[lane] = 1 / std::sqrt(perMass);
  block.perScale[lane] = 1 / block.scale[lane];
  block.bound[lane] = block.scale[lane] * row.bound;
}

void DisplacementSolver::listBlocksOfMembers() {
  firstOf_.assign(own_.size() + 1, 0);
  for (const Block& block : blocks_) {
    ++firstOf_[at(block.a) + 1];
    ++firstOf_[at(block.b) + 1];
  }
  for (std::size_t i = 0; i < own_.size(); ++i) {
    firstOf_[i + 1] += firstOf_[i];
  }
  blocksOf_.resize(firstOf_.back());
  std::vector<std::size_t> next = firstOf_;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    blocksOf_[next[at(blocks_[k].a)]++] = 2 * k;
    blocksOf_[next[at(blocks_[k].b)]++] = 2 * k + 1;
  }
}

// work(block, range)
template <class Work>
void DisplacementSolver::forBlocks(const Work& work) {
  const std::size_t ranges = std::clamp<std::size_t>(blocks_.size() / kBlocksPerRange, 1, kMostRanges);
  team_->run(static_cast<int>(ranges), [&](int range) {
    runInLanes([&]() __attribute__((always_inline)) {
      const std::size_t last = blocks_.size() * (at(range) + 1) / ranges;
      for (std::size_t k = blocks_.size() * at(range) / ranges; k < last; ++k) {
        work(blocks_[k], at(range));
      }
    });
  });
}

// Rows of a block share the normal n: with turns θ, that of a point is n·(θ × r) = r·(n × θ).
CAREEN_LANES void DisplacementSolver::findPush(Block& block) const {
  const Lanes impulse = block.scale * block.ahead;
  const auto weighted = [&](const LanesVec& arm) __attribute__((always_inline)) {
    return Vec3(sumOf(impulse * arm.x), sumOf(impulse * arm.y), sumOf(impulse * arm.z));
  };
  block.push.shift = sumOf(impulse) * block.normal;
  block.push.turnA = weighted(block.armA).cross(block.normal);
  block.push.turnB = weighted(block.armB).cross(block.normal);
}

DisplacementSolver::Move DisplacementSolver::moved(std::size_t member) const {
  Move move;
  for (std::size_t k = firstOf_[member]; k < firstOf_[member + 1]; ++k) {
    const Push& push = blocks_[blocksOf_[k] / 2].push;
    if (blocksOf_[k] % 2 == 0) {
      move.shift += push.shift;
      move.turn += push.turnA;
    } else {
      move.shift -= push.shift;
      move.turn -= push.turnB;
    }
  }
  move.shift *= own_[member].inverseMass;
  move.turn = Vec3(own_[member].inverseInertia * move.turn);
  return move;
}

// M⁻¹ Jᵀ λ, λ being what ahead(block) gives.
template <class Ahead>
CAREEN_LANES void DisplacementSolver::move(const Ahead& ahead) {
  forBlocks([&](Block & block, std::size_t) __attribute__((always_inline)) {
    block.ahead = ahead(block);
    findPush(block);
  });
  team_->share(own_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = std::max<std::size_t>(first, 1); i < last; ++i) {
      moves_[i] = moved(i);
    }
  });
}

// (J M⁻¹ Jᵀ + c) λ
CAREEN_LANES Lanes DisplacementSolver::resultOf(const Block& block) const {
  const Move& a = moves_[at(block.a)];
  const Move& b = moves_[at(block.b)];
  const auto allOfVec = [](const Vec3& v) __attribute__((always_inline)) {
    return LanesVec{allOf(v.x()), allOf(v.y()), allOf(v.z())};
  };
  const LanesVec byTurnA = allOfVec(block.normal.cross(a.turn));
  const LanesVec byTurnB = allOfVec(block.normal.cross(b.turn));
  const Lanes opened = allOf(dot(block.normal, a.shift - b.shift));
  return block.scale * (opened + (dot(block.armA, byTurnA) - dot(block.armB, byTurnB))) +
         compliance_ * block.ahead;
}

// take(block, its result, sums)
template <class Take>
CAREEN_LANES DisplacementSolver::Sums DisplacementSolver::findResults(const Take& take) {
  sums_.assign(kMostRanges, {});
  forBlocks([&](Block & block, std::size_t range)
                __attribute__((always_inline)) { take(block, resultOf(block), sums_[range]); });
  Sums all;
  for (const Sums& sums : sums_) {
    all.lacking = largerOf(all.lacking, sums.lacking);
    all.off = largerOf(all.off, sums.off);
    all.back += sums.back;
    all.squares += sums.squares;
  }
  return all;
}

// By powers: a little too small. The numbers it begins with differ in size, as signs alone may be at right
// angles to what grows fastest among a few rows.
double DisplacementSolver::largestEigenvalue() {
  std::minstd_rand random;
  double size = 0;
  for (Block& block : blocks_) {
    for (int lane = 0; lane < block.rows; ++lane) {
      block.next[lane] = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
      size += block.next[lane] * block.next[lane];
    }
  }
  for (int step = 0; step < kPowerSteps; ++step) {
    const double scale = 1 / std::sqrt(size);
    move([&](const Block& block) __attribute__((always_inline)) { return scale * block.next; });
    const Sums sums =
        findResults([&](Block & block, const Lanes& result, Sums& sum) __attribute__((always_inline)) {
          block.next = result;
          sum.squares += result * result;
        });
    size = sumOf(sums.squares);
  }
  return std::sqrt(size);
}

template <class Done>
int DisplacementSolver::descend(int most, const Done& done) {
  moves_.assign(own_.size(), {});
  if (blocks_.empty()) {
    return 0;
  }
  listBlocksOfMembers();
  const double length = kGradientStep / largestEigenvalue();
  for (Block& block : blocks_) {
    block.next = block.impulse = Lanes{};
  }
  double inertia = 1;
  double onward = 0;
  int taken = 0;
  for (; taken < most; ++taken) {
    move([&](Block & block) __attribute__((always_inline)) {
      const Lanes before = std::exchange(block.impulse, block.next);
      return largerOf(Lanes{}, block.next + onward * (block.next - before));
    });
    const Sums sums =
        findResults([&](Block & block, const Lanes& result, Sums& sum) __attribute__((always_inline)) {
          const Lanes gradient = result - block.bound;
          block.next = largerOf(Lanes{}, block.ahead - length * gradient);
          const Lanes step = block.next - block.ahead;
          sum.lacking = largerOf(sum.lacking, -gradient * block.perScale);
          sum.off = largerOf(sum.off, absOf(step) * block.perScale / length);
          sum.back += gradient * (block.next - block.impulse);
          sum.squares += step * step;
        });
    if (done(sums)) {
      break;
    }
    const double before = inertia;
    inertia = sumOf(sums.back) > 0 ? 1 : 0.5 * (1 + std::sqrt(1 + 4 * before * before));
    onward = inertia > 1 ? (before - 1) / inertia : 0;
  }
  return taken;
}

int DisplacementSolver::solve(double enough, int most) {
  double first = 0;
  return descend(most, [&](const Sums& sums) {
    const double far = std::sqrt(sumOf(sums.squares));
    first = first == 0 ? far : first;
    return largestOf(sums.lacking) <= enough || far < kLittle * first;
  });
}

int DisplacementSolver::solveExactly(double enough, int most) {
  const int patience = kPatienceOfGradients * static_cast<int>(own_.size());
  double before = std::numeric_limits<double>::max();
  double least = before;
  int taken = 0;
  return descend(most, [&](const Sums& sums) {
    least = std::min(least, largestOf(sums.off));
    const bool stalls = ++taken % patience == 0 && least > kStalls * std::exchange(before, least);
    return stalls || least <= enough;
  });
}

}  // namespace careen
