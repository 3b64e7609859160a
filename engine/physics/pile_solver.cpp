#include "physics/pile_solver.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace careen {

void PileSolver::begin(std::size_t bodies) {
  moving_.assign(bodies + 1, {});
  inertia_.assign(bodies + 1, {});
  rows_.clear();
  blocks_.clear();
  blockOfRow_.clear();
}

void PileSolver::setBody(int index, const PileBody& body, double change) {
  Inertia& inertia = inertia_[at(index)];
  inertia.radius = body.radius;
  inertia.change = change;
  if (body.still()) {
    return;
  }
  inertia.inverseMass = body.inverseMass;
  const Mat3 scaled = body.axes * body.inverseInertiaBody.asDiagonal();
  const auto entry = [&](int i, int j) { return scaled.row(i).dot(body.axes.row(j)); };
  inertia.xx = entry(0, 0);
  inertia.yy = entry(1, 1);
  inertia.zz = entry(2, 2);
  inertia.xy = entry(0, 1);
  inertia.xz = entry(0, 2);
  inertia.yz = entry(1, 2);
}

void PileSolver::beginManifold(int a, int b, double friction) {
  blocks_.push_back({.a = a, .b = b, .first = static_cast<int>(rows_.size()), .friction = friction});
}

void PileSolver::add(const Row& row) {
  Block& block = blocks_.back();
  const Inertia& a = inertia_[at(block.a)];
  const Inertia& b = inertia_[at(block.b)];
  const double inverseMass = a.inverseMass + b.inverseMass;
  const Vec3& n = row.frame.normal;
  const Vec3& t1 = row.frame.tangent1;
  const Vec3& t2 = row.frame.tangent2;
  const Vec3 an = row.armA.cross(n);
  const Vec3 bn = row.armB.cross(n);
  const Vec3 turnedA = a.times(an);
  const Vec3 turnedB = b.times(bn);
  SolvedRow& solved = rows_.emplace_back();
  solved.armA = row.armA;
  solved.armB = row.armB;
  solved.normal = n;
  solved.tangent1 = t1;
  solved.tangent2 = t2;
  solved.bound = row.bound;
  solved.massNormal = 1 / (inverseMass + turnedA.dot(an) + turnedB.dot(bn));
  solved.normalImpulse = row.normalImpulse;
  solved.tangential1 = row.tangential1;
  solved.tangential2 = row.tangential2;
  if (block.friction > 0) {
    const Vec3 a1 = row.armA.cross(t1);
    const Vec3 b1 = row.armB.cross(t1);
    const Vec3 a2 = row.armA.cross(t2);
    const Vec3 b2 = row.armB.cross(t2);
    const Vec3 turnedA2 = a.times(a2);
    const Vec3 turnedB2 = b.times(b2);
    solved.normalToTangent1 = turnedA.dot(a1) + turnedB.dot(b1);
    solved.normalToTangent2 = turnedA.dot(a2) + turnedB.dot(b2);
    const double k11 = inverseMass + a.times(a1).dot(a1) + b.times(b1).dot(b1);
    const double k22 = inverseMass + turnedA2.dot(a2) + turnedB2.dot(b2);
    const double k12 = turnedA2.dot(a1) + turnedB2.dot(b1);
    const double perDeterminant = 1 / (k11 * k22 - k12 * k12);
    solved.stop11 = k22 * perDeterminant;
    solved.stop22 = k11 * perDeterminant;
    solved.stop12 = -k12 * perDeterminant;
    const double half = 0.5 * (k11 - k22);
    solved.slide = 1 / (0.5 * (k11 + k22) + std::sqrt(half * half + k12 * k12));
  }
  blockOfRow_.push_back(static_cast<int>(blocks_.size()) - 1);
  ++block.count;
}

void PileSolver::warmStart() {
  for (const Block& block : blocks_) {
    Moving& a = moving_[at(block.a)];
    Moving& b = moving_[at(block.b)];
    const Inertia& inertiaA = inertia_[at(block.a)];
    const Inertia& inertiaB = inertia_[at(block.b)];
    for (int k = block.first; k < block.first + block.count; ++k) {
      const SolvedRow& row = rows_[at(k)];
      if (row.normalImpulse == 0) {
        continue;
      }
      const Vec3 impulse =
          row.normalImpulse * row.normal + row.tangential1 * row.tangent1 + row.tangential2 * row.tangent2;
      a.velocity += inertiaA.inverseMass * impulse;
      a.omega += inertiaA.times(row.armA.cross(impulse));
      b.velocity -= inertiaB.inverseMass * impulse;
      b.omega -= inertiaB.times(row.armB.cross(impulse));
      a.pushed = b.pushed = true;
    }
  }
}

double PileSolver::normalVelocity(int index) const {
  const SolvedRow& row = rows_[at(index)];
  const Block& block = blocks_[at(blockOfRow_[at(index)])];
  const Moving& a = moving_[at(block.a)];
  const Moving& b = moving_[at(block.b)];
  return row.normal.dot(a.velocity + a.omega.cross(row.armA) - b.velocity - b.omega.cross(row.armB));
}

// Which manifolds each body has, in one list, by counting.
void PileSolver::link() {
  firstBlock_.assign(moving_.size() + 1, 0);
  for (const Block& block : blocks_) {
    ++firstBlock_[at(block.a) + 1];
    ++firstBlock_[at(block.b) + 1];
  }
  for (std::size_t i = 1; i < firstBlock_.size(); ++i) {
    firstBlock_[i] += firstBlock_[i - 1];
  }
  cursor_.assign(firstBlock_.begin(), firstBlock_.end());
  blocksOfBody_.resize(2 * blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    blocksOfBody_[at(cursor_[at(blocks_[k].a)]++)] = static_cast<int>(k);
    blocksOfBody_[at(cursor_[at(blocks_[k].b)]++)] = static_cast<int>(k);
  }
  waiting_.assign(blocks_.size() / 64 + 1, 0);
}

void PileSolver::wakeAll() {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    put(k);
  }
}

void PileSolver::wakeRow(int row) { put(at(blockOfRow_[at(row)])); }

void PileSolver::refine(double factor) {
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    inertia_[i].change *= factor;
    if (inertia_[i].inverseMass > 0 && moving_[i].untold > inertia_[i].change) {
      tell(static_cast<int>(i));
    }
  }
}

void PileSolver::tell(int body) {
  moving_[at(body)].untold = 0;
  for (int k = firstBlock_[at(body)]; k < firstBlock_[at(body) + 1]; ++k) {
    put(at(blocksOfBody_[at(k)]));
  }
}

std::int64_t PileSolver::solve(int sweeps, bool withFriction) {
  std::int64_t solved = 0;
  bool any = true;
  for (int sweep = 0; sweep < sweeps && any; ++sweep) {
    any = false;
    for (std::size_t word = 0; word < waiting_.size(); ++word) {
      // Those put ahead of this place are still met in this round, those behind in the next. The word is read
      // anew each time, and only bits past the last one solved count.
      std::uint64_t ahead = ~std::uint64_t{0};
      while ((waiting_[word] & ahead) != 0) {
        const int bit = std::countr_zero(waiting_[word] & ahead);
        ahead = bit == 63 ? 0 : ~std::uint64_t{0} << (bit + 1);
        waiting_[word] &= ~(std::uint64_t{1} << bit);
        const Block& block = blocks_[word * 64 + static_cast<std::size_t>(bit)];
        if (withFriction && block.friction > 0) {
          solveBlock<true>(block);
        } else {
          solveBlock<false>(block);
        }
        ++solved;
        any = true;
      }
    }
  }
  return solved;
}

template <bool kFriction>
void PileSolver::solveBlock(const Block& block) {
  Moving& movingA = moving_[at(block.a)];
  Moving& movingB = moving_[at(block.b)];
  const Inertia& inertiaA = inertia_[at(block.a)];
  const Inertia& inertiaB = inertia_[at(block.b)];
  Vec3 vA = movingA.velocity;
  Vec3 wA = movingA.omega;
  Vec3 vB = movingB.velocity;
  Vec3 wB = movingB.omega;
  bool changed = false;
  for (int k = block.first; k < block.first + block.count; ++k) {
    SolvedRow& row = rows_[at(k)];
    const Vec3 u = vA + wA.cross(row.armA) - vB - wB.cross(row.armB);
    const double before = row.normalImpulse;
    const double normal = std::max(0.0, before - row.massNormal * (row.normal.dot(u) - row.bound));
    const double change = normal - before;
    if (normal == 0 && change == 0) {
      continue;
    }
    row.normalImpulse = normal;
    Vec3 impulse = change * row.normal;
    if constexpr (kFriction) {
      const double u1 = row.tangent1.dot(u) + row.normalToTangent1 * change;
      const double u2 = row.tangent2.dot(u) + row.normalToTangent2 * change;
      const double limit = block.friction * normal;
      double p1 = row.tangential1 - (row.stop11 * u1 + row.stop12 * u2);
      double p2 = row.tangential2 - (row.stop12 * u1 + row.stop22 * u2);
      if (p1 * p1 + p2 * p2 > limit * limit) {
        p1 = row.tangential1 - row.slide * u1;
        p2 = row.tangential2 - row.slide * u2;
        const double squared = p1 * p1 + p2 * p2;
        if (squared > limit * limit) {
          const double scale = limit / std::sqrt(squared);
          p1 *= scale;
          p2 *= scale;
        }
      }
      impulse += (p1 - row.tangential1) * row.tangent1 + (p2 - row.tangential2) * row.tangent2;
      row.tangential1 = p1;
      row.tangential2 = p2;
    }
    vA += inertiaA.inverseMass * impulse;
    wA += inertiaA.times(row.armA.cross(impulse));
    vB -= inertiaB.inverseMass * impulse;
    wB -= inertiaB.times(row.armB.cross(impulse));
    changed = true;
  }
  if (!changed) {
    return;
  }
  const auto store = [&](Moving& moving, const Inertia& inertia, const Vec3& v, const Vec3& w, int body) {
    if (inertia.inverseMass == 0) {
      return;
    }
    moving.untold +=
        (v - moving.velocity).cwiseAbs().sum() + inertia.radius * (w - moving.omega).cwiseAbs().sum();
    moving.velocity = v;
    moving.omega = w;
    moving.pushed = true;
    if (moving.untold > inertia.change) {
      tell(body);
    }
  };
  store(movingA, inertiaA, vA, wA, block.a);
  store(movingB, inertiaB, vB, wB, block.b);
}

}  // namespace careen
