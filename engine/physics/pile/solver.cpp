#include "physics/pile/solver.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

namespace careen {
namespace {

constexpr std::uint32_t kNeverSeen = 0xffffffff;

}  // namespace

void PileSolver::begin(std::size_t bodies, Rows rows) {
  bodies_ = bodies;
  moving_.assign(bodies + 1, {});
  inertia_.assign(bodies + 1, {});
  places_.resize(bodies);
  if (rows == Rows::kAdded) {  // else all are overwritten
    staged_.clear();
    blocks_.clear();
  }
}

void PileSolver::setBody(int index, const PileBody& body, double change) {
  Inertia& inertia = inertia_[at(index)];
  if (body.still()) {
    return;
  }
  places_[at(index)] = body.position;
  inertia.radius = body.radius;
  inertia.change = change;
  inertia.inverseMass = body.inverseMass;
  const Mat3 axes = body.principalAxes();
  const Mat3 scaled = axes * body.inverseInertiaBody.asDiagonal();
  const auto entry = [&](int i, int j) { return dot(scaled.row(i), axes.row(j)); };
  inertia.xx = entry(0, 0);
  inertia.yy = entry(1, 1);
  inertia.zz = entry(2, 2);
  inertia.xy = entry(0, 1);
  inertia.xz = entry(0, 2);
  inertia.yz = entry(1, 2);
}

void PileSolver::beginBlock(int a, Partner b, double friction, const ContactFrame& frame, const Vec3& apart) {
  blocks_.emplace_back();
  setBlock({.blocks = static_cast<int>(blocks_.size()) - 1, .rows = static_cast<int>(staged_.size())}, 0, a,
           b, friction, frame, apart);
}

void PileSolver::reserve(Extent all) {
  blocks_.resize(at(all.blocks));
  staged_.resize(at(all.rows));
}

void PileSolver::setBlock(Extent index, int count, int a, Partner b, double friction,
                          const ContactFrame& frame, const Vec3& apart) {
  blocks_[at(index.blocks)] = {.a = a,
                               .b = indexOf(b),
                               .first = index.rows,
                               .count = count,
                               .friction = friction,
                               .frame = frame,
                               .apart = apart};
}

void PileSolver::wakeRow(int row) {
  const int place = blocks_[at(blockOfRow_[at(row)])].place;
  std::atomic_ref(seen_[at(place)]).store(kNeverSeen, std::memory_order_relaxed);
}

void PileSolver::wakeAll() {
  for (const Block& block : blocks_) {
    seen_[at(block.place)] = kNeverSeen;
  }
}

PileSolver::RowView PileSolver::row(int row) const {
  const Row& staged = staged_[at(row)];
  const Block& block = blocks_[at(blockOfRow_[at(row)])];
  return {.a = block.a,
          .b = block.b,
          .armA = staged.arm,
          .armB = staged.arm + block.apart,
          .axes = block.frame.axes(),
          .friction = block.friction,
          .bound = rows_[rowAt(row)].bound[laneOf(row)],
          .impulse = {normalImpulse(row), tangential1(row), tangential2(row)}};
}

void PileSolver::setImpulse(int row, const std::array<double, 3>& impulse) {
  LaneRow& to = rows_[rowAt(row)];
  const int lane = laneOf(row);
  const Block& block = blocks_[at(blockOfRow_[at(row)])];
  const bool changed = impulse[0] != to.normalImpulse[lane] || impulse[0] > 0;
  to.normalImpulse[lane] = impulse[0];
  to.tangential1[lane] = impulse[1];
  to.tangential2[lane] = impulse[2];
  for (const int body : {block.a, block.b}) {
    Moving& moving = moving_[at(body)];
    moving.pushed = changed && movable(body) ? 1 : moving.pushed;
  }
}

// ---- Solving.

std::int64_t PileSolver::solve(int sweeps, bool withFriction) {
  return withFriction ? sweep<Kind::kFriction>(sweeps) : sweep<Kind::kFrictionless>(sweeps);
}

std::int64_t PileSolver::shift(int sweeps, double change) {
  shiftChange_ = change;
  return sweep<Kind::kShift>(sweeps);
}

template <PileSolver::Kind kKind>
std::int64_t PileSolver::sweep(int sweeps) {
  return rounds_.run(*team_, sweeps, [&](std::size_t part) {
    std::int64_t solved = 0;
    run([&]() __attribute__((always_inline)) { solved = sweepPart<kKind>(parts_[part]); });
    return solved;
  });
}

// The last is that of a as seen from b, at the row's point.
template <class Work>
CAREEN_LANES void PileSolver::forRows(const std::vector<Moving>& moving, std::size_t first, std::size_t last,
                                      const Work& work) const {
  for (std::size_t index = first; index < last; ++index) {
    const Group& group = groups_[index];
    const LaneBlock& block = lanes_[index];
    const Velocities a = velocitiesOf(moving, group.a);
    const Velocities b = velocitiesOf(moving, group.b);
    for (std::size_t k = at(group.first); k < at(group.first + group.count); ++k) {
      const LanesVec& arm = rows_[k].arm;
      work(block, k, (a.v + cross(a.w, arm)) - (b.v + cross(b.w, arm + block.apart)));
    }
  }
}

CAREEN_LANES LaneCounts PileSolver::changesOf(const std::array<int, kLanes>& bodies) const {
  return LaneCounts{changes_[at(bodies[0])], changes_[at(bodies[1])], changes_[at(bodies[2])],
                    changes_[at(bodies[3])]};
}

// Blocks put on the list ahead of the present group are solved in this sweep, the others in the next.
template <PileSolver::Kind kKind>
CAREEN_LANES std::int64_t PileSolver::sweepPart(const Part& part) {
  std::int64_t solved = 0;
  for (std::size_t index = part.first; index < part.last; ++index) {
    const Group& group = groups_[index];
    const LaneCounts changes = changesOf(group.a) + changesOf(group.b);
    std::uint32_t* const seen = &seen_[index * kLanes];
    const LaneMask asked = maskOf(changes != countsFrom(seen));
    if (any(asked)) {
      countsTo(changes, seen);
      solved -= sumOf(asked);
      solveGroup<kKind>(index, asked);
    }
  }
  return solved;
}

CAREEN_LANES PileSolver::Velocities PileSolver::velocitiesOf(const std::vector<Moving>& moving,
                                                             const std::array<int, kLanes>& bodies) {
  const auto row = [&](std::size_t lane, std::size_t k) __attribute__((always_inline)) {
    return lanesFrom(moving[at(bodies[lane])].row(k));
  };
  Velocities all{.v = {row(0, 0), row(1, 0), row(2, 0)},
                 .w = {row(0, 1), row(1, 1), row(2, 1)},
                 .unqueuedChange = row(3, 0),
                 .pushed = row(3, 1)};
  transpose(all.v.x, all.v.y, all.v.z, all.unqueuedChange);
  transpose(all.w.x, all.w.y, all.w.z, all.pushed);
  return all;
}

CAREEN_LANES void PileSolver::put(std::vector<Moving>& moving, const std::array<int, kLanes>& bodies,
                                  Velocities velocities) {
  transpose(velocities.v.x, velocities.v.y, velocities.v.z, velocities.unqueuedChange);
  transpose(velocities.w.x, velocities.w.y, velocities.w.z, velocities.pushed);
  const auto putOne = [&](std::size_t lane, const Lanes& velocity, const Lanes& omega)
      __attribute__((always_inline)) {
    Moving& body = moving[at(bodies[lane])];
    lanesTo(velocity, body.row(0));
    lanesTo(omega, body.row(1));
  };
  putOne(0, velocities.v.x, velocities.w.x);
  putOne(1, velocities.v.y, velocities.w.y);
  putOne(2, velocities.v.z, velocities.w.z);
  putOne(3, velocities.unqueuedChange, velocities.pushed);
}

void PileSolver::warmStart() {
  if (workOfImpulses() > 0) {
    for (LaneRow& row : rows_) {
      row.normalImpulse = row.tangential1 = row.tangential2 = Lanes{};
    }
    return;
  }
  forParts([&](const Part& part) {
    run([&]() __attribute__((always_inline)) {
      for (std::size_t index = part.first; index < part.last; ++index) {
        push(groups_[index], lanes_[index]);
      }
    });
  });
}

// [J] Of the impulses that the rows begin with, on the motion without them, beyond what bounds allow.
double PileSolver::workOfImpulses() {
  forParts([&](Part& part) {
    run([&]() __attribute__((always_inline)) {
      Lanes sum{};
      forRows(
          moving_, part.first, part.last,
          [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
            const LaneRow& row = rows_[k];
            sum = sum + row.normalImpulse * (dot(block.normal, u) - row.bound) +
                  row.tangential1 * dot(block.tangent1, u) + row.tangential2 * dot(block.tangent2, u);
          });
      part.work = sumOf(sum);
    });
  });
  return std::accumulate(parts_.begin(), parts_.end(), 0.0,
                         [](double sum, const Part& part) { return sum + part.work; });
}

// By the impulses of its rows.
CAREEN_LANES void PileSolver::push(const Group& group, const LaneBlock& block) {
  Velocities a = velocitiesOf(moving_, group.a);
  Velocities b = velocitiesOf(moving_, group.b);
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
    const Lanes one = {1, 1, 1, 1};
    a.pushed = pushed & (block.a.inverseMass > 0) ? one : a.pushed;
    b.pushed = pushed & (block.b.inverseMass > 0) ? one : b.pushed;
    put(moving_, group.a, a);
    put(moving_, group.b, b);
  }
}

template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::solveGroup(std::size_t index, const LaneMask& asked) {
  const Group& group = groups_[index];
  const LaneBlock& block = lanes_[index];
  const std::vector<Moving>& moving = kKind == Kind::kShift ? shifts_ : moving_;
  const Velocities fromA = velocitiesOf(moving, group.a);
  const Velocities fromB = velocitiesOf(moving, group.b);
  Velocities a = fromA;
  Velocities b = fromB;
  LaneMask changed{};
  for (int k = group.first; k < group.first + group.count; ++k) {
    LaneRow& row = rows_[at(k)];
    const LanesVec armB = row.arm + block.apart;
    const LanesVec u = (a.v + cross(a.w, row.arm)) - (b.v + cross(b.w, armB));
    Lanes& sum = kKind == Kind::kShift ? shiftRows_[at(k)].impulse : row.normalImpulse;
    const Lanes& bound = kKind == Kind::kShift ? shiftRows_[at(k)].bound : row.bound;
    const Lanes before = sum;
    const Lanes wanted = before - row.relaxedMass * (dot(block.normal, u) - bound);
    const Lanes normal = asked ? (wanted > 0 ? wanted : Lanes{}) : before;
    const Lanes change = normal - before;
    const LaneMask acts = (normal != 0) | (before != 0);
    if (!any(acts)) {
      continue;  // most rows are open
    }
    changed |= asked & acts;
    sum = normal;
    LanesVec impulse = change * block.normal;
    if constexpr (kKind == Kind::kFriction) {
      const Lanes u1 = dot(block.tangent1, u) + row.normalToTangent1 * change;
      const Lanes u2 = dot(block.tangent2, u) + row.normalToTangent2 * change;
      const Lanes limit = block.friction * normal;
      const Lanes square = limit * limit;
      Lanes p1 = row.tangential1 - (row.stop11 * u1 + row.stop12 * u2);
      Lanes p2 = row.tangential2 - (row.stop12 * u1 + row.stop22 * u2);
      const LaneMask slides = p1 * p1 + p2 * p2 > square;
      if (any(slides)) {
        const Lanes slid1 = row.tangential1 - row.slide * u1;
        const Lanes slid2 = row.tangential2 - row.slide * u2;
        const Lanes squared = slid1 * slid1 + slid2 * slid2;
        const LaneMask outside = squared > square;
        const Lanes one = {1, 1, 1, 1};
        const Lanes scale = outside ? limit / rootOf(outside ? squared : one) : one;
        p1 = slides ? scale * slid1 : p1;
        p2 = slides ? scale * slid2 : p2;
      }
      p1 = asked ? p1 : row.tangential1;
      p2 = asked ? p2 : row.tangential2;
      impulse = impulse + (p1 - row.tangential1) * block.tangent1 + (p2 - row.tangential2) * block.tangent2;
      row.tangential1 = p1;
      row.tangential2 = p2;
    }
    a.v = a.v + block.a.inverseMass * impulse;
    b.v = b.v - block.b.inverseMass * impulse;
    a.w = a.w + block.a.inertia * cross(row.arm, impulse);
    b.w = b.w - block.b.inertia * cross(armB, impulse);
  }
  if (any(changed)) {
    store<kKind>(group.a, block.a, fromA, a, changed);
    store<kKind>(group.b, block.b, fromB, b, changed);
  }
}

// Of bodies that cannot move, what was there.
template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::store(const std::array<int, kLanes>& bodies, const Side& side,
                                    const Velocities& from, Velocities to, const LaneMask& changed) {
  const Lanes one = {1, 1, 1, 1};
  const Lanes change = sumOfSizes(to.v - from.v) + side.radius * sumOfSizes(to.w - from.w);
  const Lanes sum = from.unqueuedChange + change;
  const LaneMask queued = sum > (kKind == Kind::kShift ? shiftChange_ * one : side.change);
  to.unqueuedChange = queued ? Lanes{} : sum;
  to.pushed = changed & (side.inverseMass > 0) ? one : from.pushed;
  put(kKind == Kind::kShift ? shifts_ : moving_, bodies, to);
  for (int lane = 0; lane < kLanes; ++lane) {
    changes_[at(bodies[at(lane)])] -= static_cast<std::uint32_t>(queued[lane]);
  }
}

// ---- What came of it.

double PileSolver::normalSpeed(int row) const {
  const RowView view = this->row(row);
  const Moving& a = moving_[at(view.a)];
  const Moving& b = moving_[at(view.b)];
  return dot(view.axes[0], a.velocity + a.omega.cross(view.armA) - b.velocity - b.omega.cross(view.armB));
}

void PileSolver::beginShifts(double h) {
  shifts_.assign(moving_.size(), {});
  shiftRows_.resize(rows_.size());
  team_->share(groups_.size(), [&](std::size_t first, std::size_t last) {
    run([&]() __attribute__((always_inline)) {
      forRows(
          moving_, first,
          last, [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
            shiftRows_[k] = {.bound = -h * dot(block.normal, u)};
          });
    });
  });
}

double PileSolver::mostLacking() const {
  return team_->largest(groups_.size(), [&](std::size_t first, std::size_t last) {
    Lanes most{};
    run([&]() __attribute__((always_inline)) {
      forRows(
          shifts_, first,
          last, [&](const LaneBlock& block, std::size_t k, const LanesVec& u) __attribute__((always_inline)) {
            most = largerOf(most, shiftRows_[k].bound - dot(block.normal, u));
          });
    });
    return largestOf(most);
  });
}

ContactResiduals PileSolver::residuals(double speed) const {
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
  team_->share(groups_.size(), [&](std::size_t first, std::size_t last) {
    ResidualSum part(speed, std::sqrt(largest));
    run([&]() __attribute__((always_inline)) { addResiduals(first, last, part); });
    const std::lock_guard lock(mutex);
    sum.include(part);
  });
  return sum.residuals();
}

// Of groups, as ResidualSum does it contact by contact; lanes without a row add none.
CAREEN_LANES void PileSolver::addResiduals(std::size_t first, std::size_t last, ResidualSum& sum) const {
  const double mostImpulse = sum.impulse();
  const Lanes most = {mostImpulse, mostImpulse, mostImpulse, mostImpulse};
  Lanes primal{}, dual{}, power{};
  forRows(
      moving_, first,
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
