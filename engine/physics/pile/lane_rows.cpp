#include "physics/pile/lane_rows.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

namespace careen {
namespace {

constexpr double kRelaxation = 1.4;  // [1] of normal impulses; 1 to 2. Halves the sweeps that a heap needs.

void fillSide(LaneSide& side, int lane, const SolverBody& body) {
  side.inverseMass[lane] = body.inverseMass;
  side.inertia.xx[lane] = body.xx;
  side.inertia.yy[lane] = body.yy;
  side.inertia.zz[lane] = body.zz;
  side.inertia.xy[lane] = body.xy;
  side.inertia.xz[lane] = body.xz;
  side.inertia.yz[lane] = body.yz;
  side.radius[lane] = body.radius;
  side.change[lane] = body.change;
}

}  // namespace

// By those who will solve them.
void LaneRows::fill(const RowList& list, std::span<const SolverBody> bodies) {
  groups_.find(list.blocks(), bodies);
  blocks_.resize(groups_.groups().size());
  rows_.resize(at(groups_.rowCount()));
  places_.resize(list.rows().size());
  groups_.forParts([&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      fillGroup(k, list, bodies);
    }
    const auto find = [&]() __attribute__((always_inline)) {
      for (std::size_t k = first; k < last; ++k) {
        findMasses(k);
      }
    };
    runInLanes(find, registers_);
  });
  groups_.order();
}

void LaneRows::fillGroup(std::size_t index, const RowList& list, std::span<const SolverBody> bodies) {
  const BlockGroups::Group& group = groups_.groups()[index];
  LaneBlock& lanes = blocks_[index];
  if (group.used < kLanes) {
    lanes = {};
    std::fill_n(rows_.begin() + group.first, group.count, LaneRow{});
  }
  for (int lane = 0; lane < group.used; ++lane) {
    const RowBlock& block = list.blocks()[at(group.blocks[at(lane)])];
    lanes.friction[lane] = block.friction;
    const auto put = [&](LanesVec& to, const Vec3& v) { setLane(to, lane, v.x(), v.y(), v.z()); };
    put(lanes.normal, block.frame.normal);
    put(lanes.tangent1, block.frame.tangent1);
    put(lanes.tangent2, block.frame.tangent2);
    put(lanes.apart, block.apart);
    fillSide(lanes.a, lane, bodies[at(block.a)]);
    fillSide(lanes.b, lane, bodies[at(block.b)]);
    for (int k = 0; k < block.count; ++k) {
      const PileRow& from = list.rows()[at(block.first + k)];
      LaneRow& row = rows_[at(group.first + k)];
      put(row.arm, from.arm);
      row.bound[lane] = from.bound;
      row.normalImpulse[lane] = from.normalImpulse;
      row.tangential1[lane] = from.tangential1;
      row.tangential2[lane] = from.tangential2;
      places_[at(block.first + k)] = at(group.first + k) * kLanes + at(lane);
    }
  }
}

// Entries of each point's 3×3 inverse effective mass matrix: dᵢ·dⱼ/m + Σ (r × dᵢ)·I⁻¹ (r × dⱼ) over both
// bodies.
CAREEN_LANES void LaneRows::findMasses(std::size_t index) {
  const BlockGroups::Group& group = groups_.groups()[index];
  const LaneBlock& lanes = blocks_[index];
  const Lanes one = allOf(1);
  const Lanes inverseMass = lanes.a.inverseMass + lanes.b.inverseMass;
  for (int k = 0; k < group.count; ++k) {
    LaneRow& row = rows_[at(group.first + k)];
    const LaneMask there = LaneMask{group.counts[0], group.counts[1], group.counts[2], group.counts[3]} > k;
    const LanesVec armB = row.arm + lanes.apart;
    const LanesVec nA = cross(row.arm, lanes.normal);
    const LanesVec nB = cross(armB, lanes.normal);
    const LanesVec turnedA = lanes.a.inertia * nA;
    const LanesVec turnedB = lanes.b.inertia * nB;
    const Lanes mass = inverseMass + dot(turnedA, nA) + dot(turnedB, nB);
    row.relaxedMass = there ? kRelaxation / (there ? mass : one) : Lanes{};
    const LanesVec a1 = cross(row.arm, lanes.tangent1);
    const LanesVec b1 = cross(armB, lanes.tangent1);
    const LanesVec a2 = cross(row.arm, lanes.tangent2);
    const LanesVec b2 = cross(armB, lanes.tangent2);
    const LanesVec turnedA2 = lanes.a.inertia * a2;
    const LanesVec turnedB2 = lanes.b.inertia * b2;
    row.normalToTangent1 = dot(turnedA, a1) + dot(turnedB, b1);
    row.normalToTangent2 = dot(turnedA, a2) + dot(turnedB, b2);
    const Lanes k11 = inverseMass + dot(lanes.a.inertia * a1, a1) + dot(lanes.b.inertia * b1, b1);
    const Lanes k22 = inverseMass + dot(turnedA2, a2) + dot(turnedB2, b2);
    const Lanes k12 = dot(turnedA2, a1) + dot(turnedB2, b1);
    const Lanes determinant = k11 * k22 - k12 * k12;
    const Lanes perDeterminant = there ? one / (there ? determinant : one) : Lanes{};
    row.stop11 = k22 * perDeterminant;
    row.stop22 = k11 * perDeterminant;
    row.stop12 = -k12 * perDeterminant;
    const Lanes half = 0.5 * (k11 - k22);
    const Lanes largest = 0.5 * (k11 + k22) + rootOf(half * half + k12 * k12);
    row.slide = there ? one / (there ? largest : one) : Lanes{};
  }
}

// work(block, index of the row, velocity), the last being that of a as seen from b, at the row's point.
template <class Work>
CAREEN_LANES void LaneRows::forRows(std::span<const Moving> moving, std::size_t first, std::size_t last,
                                    const Work& work) const {
  for (std::size_t index = first; index < last; ++index) {
    const BlockGroups::Group& group = groups_.groups()[index];
    const LaneBlock& block = blocks_[index];
    const MovingLanes a = movingOf(moving, group.a);
    const MovingLanes b = movingOf(moving, group.b);
    for (std::size_t k = at(group.first); k < at(group.first + group.count); ++k) {
      const LanesVec& arm = rows_[k].arm;
      work(block, k, (a.v + cross(a.w, arm)) - (b.v + cross(b.w, arm + block.apart)));
    }
  }
}

double LaneRows::workOfImpulses(std::span<const Moving> moving) {
  std::vector<double> works(groups_.partCount());
  groups_.forParts([&](std::size_t part, std::size_t first, std::size_t last) {
    const auto find = [&]() __attribute__((always_inline)) {
      Lanes sum{};
      forRows(
          moving, first,
          last, [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
            const LaneRow& row = rows_[k];
            sum = sum + row.normalImpulse * (dot(block.normal, u) - row.bound) +
                  row.tangential1 * dot(block.tangent1, u) + row.tangential2 * dot(block.tangent2, u);
          });
      works[part] = sumOf(sum);
    };
    runInLanes(find, registers_);
  });
  return std::accumulate(works.begin(), works.end(), 0.0);
}

void LaneRows::clearImpulses() {
  for (LaneRow& row : rows_) {
    row.normalImpulse = row.tangential1 = row.tangential2 = Lanes{};
  }
}

void LaneRows::push(std::span<Moving> moving) {
  groups_.forParts([&](std::size_t, std::size_t first, std::size_t last) {
    const auto push = [&]() __attribute__((always_inline)) {
      for (std::size_t index = first; index < last; ++index) {
        pushGroup(index, moving);
      }
    };
    runInLanes(push, registers_);
  });
}

CAREEN_LANES void LaneRows::pushGroup(std::size_t index, std::span<Moving> moving) const {
  const BlockGroups::Group& group = groups_.groups()[index];
  const LaneBlock& block = blocks_[index];
  MovingLanes a = movingOf(moving, group.a);
  MovingLanes b = movingOf(moving, group.b);
  LaneMask pushed{};
  for (int k = group.first; k < group.first + group.count; ++k) {
    const LaneRow& row = rows_[at(k)];
    const LanesVec impulse = row.normalImpulse * block.normal + row.tangential1 * block.tangent1 +
                             row.tangential2 * block.tangent2;
    pushed |= row.normalImpulse != 0;
    a.v = a.v + block.a.inverseMass * impulse;
    b.v = b.v - block.b.inverseMass * impulse;
    a.w = a.w + block.a.inertia * cross(row.arm, impulse);
    b.w = b.w - block.b.inertia * cross(row.arm + block.apart, impulse);
  }
  if (any(pushed)) {
    a.pushed = pushed & (block.a.inverseMass > 0) ? allOf(1) : a.pushed;
    b.pushed = pushed & (block.b.inverseMass > 0) ? allOf(1) : b.pushed;
    setMoving(moving, group.a, a);
    setMoving(moving, group.b, b);
  }
}

void LaneRows::beginShifts(double h, std::span<const Moving> moving) {
  shifts_.resize(rows_.size());
  team_->share(blocks_.size(), [&](std::size_t first, std::size_t last) {
    const auto begin = [&]() __attribute__((always_inline)) {
      forRows(
          moving, first,
          last, [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
            shifts_[k] = {.bound = -h * dot(block.normal, u)};
          });
    };
    runInLanes(begin, registers_);
  });
}

double LaneRows::mostLacking(std::span<const Moving> shifted) const {
  return team_->largest(blocks_.size(), [&](std::size_t first, std::size_t last) {
    Lanes most{};
    const auto find = [&]() __attribute__((always_inline)) {
      forRows(
          shifted, first,
          last, [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
            most = largerOf(most, shifts_[k].bound - dot(block.normal, u));
          });
    };
    runInLanes(find, registers_);
    return largestOf(most);
  });
}

ContactResiduals LaneRows::residuals(double speed, std::span<const Moving> moving) const {
  const double largest = team_->largest(rows_.size(), [&](std::size_t first, std::size_t last) {
    double squares = 0;
    for (std::size_t k = first; k < last; ++k) {
      const LaneRow& row = rows_[k];
      const Lanes squared = row.normalImpulse * row.normalImpulse +
                            (row.tangential1 * row.tangential1 + row.tangential2 * row.tangential2);
      squares = std::max(squares, largestOf(squared));
    }
    return squares;
  });
  ResidualSum sum(speed, std::sqrt(largest));
  std::mutex mutex;
  team_->share(blocks_.size(), [&](std::size_t first, std::size_t last) {
    ResidualSum part(speed, std::sqrt(largest));
    runInLanes(
        [&]() __attribute__((always_inline)) { addResiduals(moving, first, last, part); }, registers_);
    const std::lock_guard lock(mutex);
    sum.include(part);
  });
  return sum.residuals();
}

// Of groups, as ResidualSum does it contact by contact; lanes without a row add none.
CAREEN_LANES void LaneRows::addResiduals(std::span<const Moving> moving, std::size_t first, std::size_t last,
                                         ResidualSum& sum) const {
  const Lanes most = allOf(sum.impulse());
  Lanes primal{}, dual{}, power{};
  forRows(
      moving, first,
      last, [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
        const LaneRow& row = rows_[k];
        const Lanes above = dot(block.normal, u) - row.bound;
        const Lanes u1 = dot(block.tangent1, u);
        const Lanes u2 = dot(block.tangent2, u);
        const Lanes limit = block.friction * row.normalImpulse;
        const Lanes tangential =
            rootOf(row.tangential1 * row.tangential1 + row.tangential2 * row.tangential2);
        primal = largerOf(primal, -above);
        dual = largerOf(dual, largerOf(-row.normalImpulse, tangential - limit));
        power = largerOf(power, absOf(row.normalImpulse * above +
                                      ((limit < most ? limit : most) * rootOf(u1 * u1 + u2 * u2) +
                                       (row.tangential1 * u1 + row.tangential2 * u2))));
      });
  sum.include(largestOf(primal), largestOf(dual), largestOf(power));
}

}  // namespace careen
