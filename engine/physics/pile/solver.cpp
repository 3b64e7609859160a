#include "physics/pile/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/solver/residual_sum.h"

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
  const Mat3 axes = body.principalAxes();
  const Mat3 scaled = axes * body.inverseInertiaBody.asDiagonal();
  const auto entry = [&](int i, int j) { return scaled.row(i).dot(axes.row(j)); };
  inertia.xx = entry(0, 0);
  inertia.yy = entry(1, 1);
  inertia.zz = entry(2, 2);
  inertia.xy = entry(0, 1);
  inertia.xz = entry(0, 2);
  inertia.yz = entry(1, 2);
}

void PileSolver::beginManifold(int a, Partner b, double friction) {
  blocks_.push_back({.a = a, .b = indexOf(b), .first = static_cast<int>(rows_.size()), .friction = friction});
}

void PileSolver::add(const Row& row) {
  Block& block = blocks_.back();
  const PairInertia inertia(inertia_[at(block.a)], inertia_[at(block.b)]);
  const double inverseMass = inertia.inverseMass[0] + inertia.inverseMass[1];
  SolvedRow& solved = rows_.emplace_back();
  solved.arms = pairOf(row.armA, row.armB);
  solved.normal = row.frame.normal;
  solved.tangent1 = row.frame.tangent1;
  solved.tangent2 = row.frame.tangent2;
  solved.bound = row.bound;
  solved.normalImpulse = row.normalImpulse;
  solved.tangential1 = row.tangential1;
  solved.tangential2 = row.tangential2;
  // Entries of the point's 3×3 inverse effective mass matrix: dᵢ·dⱼ/m + Σ (r × dᵢ)·I⁻¹ (r × dⱼ) over both
  // bodies.
  const auto lever = [&](const Vec3& direction) { return cross(solved.arms, pairOf(direction, direction)); };
  const auto product = [](const PairVec& a, const PairVec& b) {
    const Pair sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum[0] + sum[1];
  };
  const PairVec leverN = lever(solved.normal);
  const PairVec turnedN = inertia.times(leverN);
  solved.massNormal = 1 / (inverseMass + product(turnedN, leverN));
  if (block.friction > 0) {
    const PairVec lever1 = lever(solved.tangent1);
    const PairVec lever2 = lever(solved.tangent2);
    const PairVec turned2 = inertia.times(lever2);
    solved.normalToTangent1 = product(turnedN, lever1);
    solved.normalToTangent2 = product(turnedN, lever2);
    const double k11 = inverseMass + product(inertia.times(lever1), lever1);
    const double k22 = inverseMass + product(turned2, lever2);
    const double k12 = product(turned2, lever1);
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
      a.omega += inertiaA.times(firstOf(row.arms).cross(impulse));
      b.velocity -= inertiaB.inverseMass * impulse;
      b.omega -= inertiaB.times(secondOf(row.arms).cross(impulse));
      a.pushed = b.pushed = true;
    }
  }
}

// Lists the manifolds of each body, by counting sort.
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

PileSolver::RowView PileSolver::row(int row) const {
  const SolvedRow& at = rows_[PileSolver::at(row)];
  const Block& block = blocks_[PileSolver::at(blockOfRow_[PileSolver::at(row)])];
  return {.a = block.a,
          .b = block.b,
          .armA = firstOf(at.arms),
          .armB = secondOf(at.arms),
          .directions = {at.normal, at.tangent1, at.tangent2},
          .friction = block.friction,
          .bound = at.bound,
          .impulse = {at.normalImpulse, at.tangential1, at.tangential2}};
}

void PileSolver::setImpulse(int row, const std::array<double, 3>& impulse) {
  SolvedRow& at = rows_[PileSolver::at(row)];
  const Block& block = blocks_[PileSolver::at(blockOfRow_[PileSolver::at(row)])];
  const bool changed = impulse[0] != at.normalImpulse || impulse[0] > 0;
  at.normalImpulse = impulse[0];
  at.tangential1 = impulse[1];
  at.tangential2 = impulse[2];
  for (const int body : {block.a, block.b}) {
    Moving& moving = moving_[PileSolver::at(body)];
    moving.pushed = moving.pushed || (changed && inertia_[PileSolver::at(body)].inverseMass > 0);
  }
}

void PileSolver::queueBlocksOf(int body) {
  for (int k = firstBlock_[at(body)]; k < firstBlock_[at(body) + 1]; ++k) {
    put(at(blocksOfBody_[at(k)]));
  }
}

std::int64_t PileSolver::solve(int sweeps, bool withFriction) {
  return sweep(sweeps, [&](const Block& block) {
    if (withFriction && block.friction > 0) {
      solveBlock<Kind::kFriction>(block);
    } else {
      solveBlock<Kind::kFrictionless>(block);
    }
  });
}

double PileSolver::normalSpeed(int row) const {
  const SolvedRow& solved = rows_[at(row)];
  const Block& block = blocks_[at(blockOfRow_[at(row)])];
  const Moving& a = moving_[at(block.a)];
  const Moving& b = moving_[at(block.b)];
  return solved.normal.dot(a.velocity + a.omega.cross(firstOf(solved.arms)) - b.velocity -
                           b.omega.cross(secondOf(solved.arms)));
}

ContactResiduals PileSolver::residuals(double speed) const {
  double largest = 0;
  for (const SolvedRow& row : rows_) {
    largest = std::max(largest, row.normalImpulse * row.normalImpulse +
                                    (row.tangential1 * row.tangential1 + row.tangential2 * row.tangential2));
  }
  ResidualSum sum(speed, std::sqrt(largest));
  for (const Block& block : blocks_) {
    const Moving& a = moving_[at(block.a)];
    const Moving& b = moving_[at(block.b)];
    const ContactCone cone{.friction = block.friction, .onLine = !(block.friction > 0)};
    const PairVec v = pairOf(a.velocity, b.velocity);
    const PairVec w = pairOf(a.omega, b.omega);
    for (int k = block.first; k < block.first + block.count; ++k) {
      const SolvedRow& row = rows_[at(k)];
      const PairVec turning = cross(w, row.arms);
      const Pair x = v.x + turning.x;
      const Pair y = v.y + turning.y;
      const Pair z = v.z + turning.z;
      const Vec3 u(x[0] - x[1], y[0] - y[1], z[0] - z[1]);
      sum.add(cone, {row.normalImpulse, row.tangential1, row.tangential2},
              {row.normal.dot(u) - row.bound, row.tangent1.dot(u), row.tangent2.dot(u)});
    }
  }
  return sum.residuals();
}

std::int64_t PileSolver::shift(int sweeps, double change) {
  shiftChange_ = change;
  return sweep(sweeps, [&](const Block& block) { solveBlock<Kind::kShift>(block); });
}

// Blocks put on the list ahead of the present position are solved in this sweep, those behind in the next.
// The word is read again each time; only bits past the last one solved count.
template <class Solve>
std::int64_t PileSolver::sweep(int sweeps, const Solve& solve) {
  std::int64_t solved = 0;
  bool any = true;
  for (int sweep = 0; sweep < sweeps && any; ++sweep) {
    any = false;
    for (std::size_t word = 0; word < waiting_.size(); ++word) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while ((waiting_[word] & ahead) != 0) {
        const int bit = std::countr_zero(waiting_[word] & ahead);
        ahead = (~std::uint64_t{0} << bit) << 1;
        waiting_[word] &= ~(std::uint64_t{1} << bit);
        solve(blocks_[word * 64 + static_cast<std::size_t>(bit)]);
        ++solved;
        any = true;
      }
    }
  }
  return solved;
}

template <PileSolver::Kind kKind>
void PileSolver::solveBlock(const Block& block) {
  constexpr Pair kOpposite = {1, -1};
  std::vector<Moving>& moving = kKind == Kind::kShift ? shifts_ : moving_;
  const Moving& movingA = moving[at(block.a)];
  const Moving& movingB = moving[at(block.b)];
  const PairInertia inertia(inertia_[at(block.a)], inertia_[at(block.b)]);
  PairVec v = pairOf(movingA.velocity, movingB.velocity);
  PairVec w = pairOf(movingA.omega, movingB.omega);
  bool changed = false;
  for (int k = block.first; k < block.first + block.count; ++k) {
    SolvedRow& row = rows_[at(k)];
    const PairVec turning = cross(w, row.arms);
    const Pair x = v.x + turning.x;
    const Pair y = v.y + turning.y;
    const Pair z = v.z + turning.z;
    const double ux = x[0] - x[1];
    const double uy = y[0] - y[1];
    const double uz = z[0] - z[1];
    const auto along = [&](const Vec3& d) { return d.x() * ux + d.y() * uy + d.z() * uz; };
    double& sum = kKind == Kind::kShift ? row.shiftImpulse : row.normalImpulse;
    const double bound = kKind == Kind::kShift ? row.shiftBound : row.bound;
    const double before = sum;
    const double normal = std::max(0.0, before - row.massNormal * (along(row.normal) - bound));
    const double change = normal - before;
    if (normal == 0 && change == 0) {
      continue;
    }
    sum = normal;
    Vec3 impulse = change * row.normal;
    if constexpr (kKind == Kind::kFriction) {
      const double u1 = along(row.tangent1) + row.normalToTangent1 * change;
      const double u2 = along(row.tangent2) + row.normalToTangent2 * change;
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
    const PairVec push = {impulse.x() * kOpposite, impulse.y() * kOpposite, impulse.z() * kOpposite};
    const PairVec spin = inertia.times(cross(row.arms, push));
    v = {v.x + inertia.inverseMass * push.x, v.y + inertia.inverseMass * push.y,
         v.z + inertia.inverseMass * push.z};
    w = {w.x + spin.x, w.y + spin.y, w.z + spin.z};
    changed = true;
  }
  if (changed) {
    store<kKind>(block.a, firstOf(v), firstOf(w));
    store<kKind>(block.b, secondOf(v), secondOf(w));
  }
}

template <PileSolver::Kind kKind>
void PileSolver::store(int body, const Vec3& velocity, const Vec3& omega) {
  const Inertia& inertia = inertia_[at(body)];
  if (inertia.inverseMass == 0) {
    return;
  }
  Moving& moving = (kKind == Kind::kShift ? shifts_ : moving_)[at(body)];
  moving.unqueuedChange += (velocity - moving.velocity).cwiseAbs().sum() +
                           inertia.radius * (omega - moving.omega).cwiseAbs().sum();
  moving.velocity = velocity;
  moving.omega = omega;
  moving.pushed = true;
  if (moving.unqueuedChange > (kKind == Kind::kShift ? shiftChange_ : inertia.change)) {
    moving.unqueuedChange = 0;
    queueBlocksOf(body);
  }
}

}  // namespace careen
