#include "physics/pile/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/solver/residual_sum.h"

namespace careen {
namespace {

constexpr std::size_t kMostOpen = 16;  // groups that a block is tried with
constexpr double kRelaxation = 1.4;    // [1] of normal impulses; 1 to 2. Halves the sweeps that a heap needs.

}  // namespace

void PileSolver::begin(std::size_t bodies) {
  moving_.assign(bodies + 1, {});
  inertia_.assign(bodies + 1, {});
  staged_.clear();
  blocks_.clear();
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

void PileSolver::beginBlock(int a, Partner b, double friction, const PileFrame& frame, const Vec3& apart) {
  blocks_.push_back({.a = a,
                     .b = indexOf(b),
                     .first = static_cast<int>(staged_.size()),
                     .friction = friction,
                     .frame = frame,
                     .apart = apart});
}

// ---- Groups.

void PileSolver::link() {
  groups_.clear();
  for (std::vector<int>& open : open_) {
    open.clear();
  }
  for (Block& block : blocks_) {
    findGroup(block);
  }
  fillGroups();
  run([&]() __attribute__((always_inline)) {
    for (Group& group : groups_) {
      findMasses(group);
    }
  });
  listBlocks();
  waiting_.assign(groups_.size() * kLanes / 64 + 1, 0);
}

// The first group with as many rows and none of its bodies, of those that are not full; a new one, if there
// is none.
void PileSolver::findGroup(Block& block) {
  const std::size_t rows = at(block.count);
  if (rows >= open_.size()) {
    open_.resize(rows + 1);
  }
  std::vector<int>& open = open_[rows];
  auto found = std::find_if(open.begin(), open.end(),
                            [&](int group) { return !sharesBody(groups_[at(group)], block); });
  if (found == open.end()) {
    if (open.size() == kMostOpen) {
      open.erase(open.begin());
    }
    open.push_back(static_cast<int>(groups_.size()));
    Group& group = groups_.emplace_back();
    group.a.body.fill(static_cast<int>(moving_.size()) - 1);
    group.b.body = group.a.body;
    found = open.end() - 1;
  }
  Group& group = groups_[at(*found)];
  const int lane = group.used++;
  group.a.body[at(lane)] = block.a;
  group.b.body[at(lane)] = block.b;
  group.counts[at(lane)] = block.count;
  block.place = *found * kLanes + lane;
  if (group.used == kLanes) {
    open.erase(found);
  }
}

bool PileSolver::sharesBody(const Group& group, const Block& block) const {
  const int a = movable(block.a) ? block.a : -1;
  const int b = movable(block.b) ? block.b : -1;
  bool shares = false;
  for (std::size_t k = 0; k < kLanes; ++k) {
    shares |=
        (group.a.body[k] == a) | (group.a.body[k] == b) | (group.b.body[k] == a) | (group.b.body[k] == b);
  }
  return shares;
}

void PileSolver::fillGroups() {
  std::size_t rows = 0;
  for (Group& group : groups_) {
    group.first = static_cast<int>(rows);
    group.count = *std::max_element(group.counts.begin(), group.counts.end());
    rows += at(group.count);
  }
  rows_.clear();
  rows_.resize(rows);
  rowPlaces_.resize(staged_.size());
  blockOfRow_.resize(staged_.size());
  for (std::size_t index = 0; index < blocks_.size(); ++index) {
    const Block& block = blocks_[index];
    const int lane = block.place % kLanes;
    Group& group = groups_[at(block.place / kLanes)];
    group.friction[lane] = block.friction;
    const auto put = [&](LanesVec& to, const Vec3& v) { setLane(to, lane, v.x(), v.y(), v.z()); };
    put(group.normal, block.frame.normal);
    put(group.tangent1, block.frame.tangent1);
    put(group.tangent2, block.frame.tangent2);
    put(group.apart, block.apart);
    fillSide(group.a, lane, block.a);
    fillSide(group.b, lane, block.b);
    for (int k = 0; k < block.count; ++k) {
      const Row& from = staged_[at(block.first + k)];
      LaneRow& row = rows_[at(group.first + k)];
      put(row.arm, from.arm);
      row.bound[lane] = from.bound;
      row.normalImpulse[lane] = from.normalImpulse;
      row.tangential1[lane] = from.tangential1;
      row.tangential2[lane] = from.tangential2;
      rowPlaces_[at(block.first + k)] = at(group.first + k) * kLanes + at(lane);
      blockOfRow_[at(block.first + k)] = static_cast<int>(index);
    }
  }
}

void PileSolver::fillSide(Side& side, int lane, int body) {
  const Inertia& inertia = inertia_[at(body)];
  side.inverseMass[lane] = inertia.inverseMass;
  side.inertia.xx[lane] = inertia.xx;
  side.inertia.yy[lane] = inertia.yy;
  side.inertia.zz[lane] = inertia.zz;
  side.inertia.xy[lane] = inertia.xy;
  side.inertia.xz[lane] = inertia.xz;
  side.inertia.yz[lane] = inertia.yz;
  side.radius[lane] = inertia.radius;
  side.change[lane] = inertia.change;
}

// Entries of each point's 3×3 inverse effective mass matrix: dᵢ·dⱼ/m + Σ (r × dᵢ)·I⁻¹ (r × dⱼ) over both
// bodies. Lanes without a row keep a mass of 0.
CAREEN_LANES void PileSolver::findMasses(Group& group) {
  const Lanes one = {1, 1, 1, 1};
  const Lanes inverseMass = group.a.inverseMass + group.b.inverseMass;
  for (int k = 0; k < group.count; ++k) {
    LaneRow& row = rows_[at(group.first + k)];
    const LaneMask there = LaneMask{group.counts[0], group.counts[1], group.counts[2], group.counts[3]} > k;
    const LanesVec armB = row.arm + group.apart;
    const LanesVec nA = cross(row.arm, group.normal);
    const LanesVec nB = cross(armB, group.normal);
    const LanesVec turnedA = group.a.inertia * nA;
    const LanesVec turnedB = group.b.inertia * nB;
    const Lanes mass = inverseMass + dot(turnedA, nA) + dot(turnedB, nB);
    row.relaxedMass = there ? kRelaxation / (there ? mass : one) : Lanes{};
    const LanesVec a1 = cross(row.arm, group.tangent1);
    const LanesVec b1 = cross(armB, group.tangent1);
    const LanesVec a2 = cross(row.arm, group.tangent2);
    const LanesVec b2 = cross(armB, group.tangent2);
    const LanesVec turnedA2 = group.a.inertia * a2;
    const LanesVec turnedB2 = group.b.inertia * b2;
    row.normalToTangent1 = dot(turnedA, a1) + dot(turnedB, b1);
    row.normalToTangent2 = dot(turnedA, a2) + dot(turnedB, b2);
    const Lanes k11 = inverseMass + dot(group.a.inertia * a1, a1) + dot(group.b.inertia * b1, b1);
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

// The places of each body's blocks, by counting sort.
void PileSolver::listBlocks() {
  firstBlock_.assign(moving_.size() + 1, 0);
  for (const Block& block : blocks_) {
    ++firstBlock_[at(block.a) + 1];
    ++firstBlock_[at(block.b) + 1];
  }
  for (std::size_t i = 1; i < firstBlock_.size(); ++i) {
    firstBlock_[i] += firstBlock_[i - 1];
  }
  cursor_.assign(firstBlock_.begin(), firstBlock_.end());
  placesOfBody_.resize(2 * blocks_.size());
  for (const Block& block : blocks_) {
    placesOfBody_[at(cursor_[at(block.a)]++)] = block.place;
    placesOfBody_[at(cursor_[at(block.b)]++)] = block.place;
  }
}

void PileSolver::warmStart() {
  for (const Block& block : blocks_) {
    Moving& a = moving_[at(block.a)];
    Moving& b = moving_[at(block.b)];
    for (int k = block.first; k < block.first + block.count; ++k) {
      const Row& row = staged_[at(k)];
      if (row.normalImpulse == 0) {
        continue;
      }
      const Vec3 impulse = row.normalImpulse * block.frame.normal + row.tangential1 * block.frame.tangent1 +
                           row.tangential2 * block.frame.tangent2;
      push(block.a, row.arm, impulse);
      push(block.b, row.arm + block.apart, -impulse);
      a.pushed = b.pushed = 1;
    }
  }
}

void PileSolver::wakeAll() {
  for (const Block& block : blocks_) {
    put(block.place);
  }
}

PileSolver::RowView PileSolver::row(int row) const {
  const Row& staged = staged_[at(row)];
  const Block& block = blocks_[at(blockOfRow_[at(row)])];
  return {.a = block.a,
          .b = block.b,
          .armA = staged.arm,
          .armB = staged.arm + block.apart,
          .directions = {block.frame.normal, block.frame.tangent1, block.frame.tangent2},
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

void PileSolver::queueBlocksOf(int body) {
  for (int k = firstBlock_[at(body)]; k < firstBlock_[at(body) + 1]; ++k) {
    put(placesOfBody_[at(k)]);
  }
}

std::int64_t PileSolver::solve(int sweeps, bool withFriction) {
  return withFriction ? sweep<Kind::kFriction>(sweeps) : sweep<Kind::kFrictionless>(sweeps);
}

std::int64_t PileSolver::shift(int sweeps, double change) {
  shiftChange_ = change;
  return sweep<Kind::kShift>(sweeps);
}

// Blocks put on the list ahead of the present group are solved in this sweep, the others in the next. The
// word is read again each time; only bits past the last group solved count.
template <PileSolver::Kind kKind>
std::int64_t PileSolver::sweep(int sweeps) {
  std::int64_t solved = 0;
  run([&]() __attribute__((always_inline)) {
    bool any = true;
    for (int sweep = 0; sweep < sweeps && any; ++sweep) {
      any = false;
      for (std::size_t word = 0; word < waiting_.size(); ++word) {
        std::uint64_t ahead = ~std::uint64_t{0};
        while ((waiting_[word] & ahead) != 0) {
          const int first = std::countr_zero(waiting_[word] & ahead) / kLanes * kLanes;
          const std::uint64_t lanes = (waiting_[word] >> first) & 0xfU;
          ahead = (~std::uint64_t{0} << first) << kLanes;
          waiting_[word] &= ~(std::uint64_t{0xf} << first);
          solveGroup<kKind>(groups_[(word * 64 + at(first)) / kLanes], static_cast<unsigned>(lanes));
          solved += std::popcount(lanes);
          any = true;
        }
      }
    }
  });
  return solved;
}

CAREEN_LANES PileSolver::Velocities PileSolver::velocitiesOf(const std::vector<Moving>& moving,
                                                             const Side& side) {
  const auto row = [&](std::size_t lane, std::size_t k) {
    return lanesFrom(moving[at(side.body[lane])].row(k));
  };
  Velocities all{.v = {row(0, 0), row(1, 0), row(2, 0)},
                 .w = {row(0, 1), row(1, 1), row(2, 1)},
                 .unqueuedChange = row(3, 0),
                 .pushed = row(3, 1)};
  transpose(all.v.x, all.v.y, all.v.z, all.unqueuedChange);
  transpose(all.w.x, all.w.y, all.w.z, all.pushed);
  return all;
}

template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::solveGroup(const Group& group, unsigned lanes) {
  const std::vector<Moving>& moving = kKind == Kind::kShift ? shifts_ : moving_;
  const LaneMask asked = maskOf(lanes);
  const Velocities fromA = velocitiesOf(moving, group.a);
  const Velocities fromB = velocitiesOf(moving, group.b);
  Velocities a = fromA;
  Velocities b = fromB;
  LaneMask changed{};
  for (int k = group.first; k < group.first + group.count; ++k) {
    LaneRow& row = rows_[at(k)];
    const LanesVec armB = row.arm + group.apart;
    const LanesVec u = (a.v + cross(a.w, row.arm)) - (b.v + cross(b.w, armB));
    Lanes& sum = kKind == Kind::kShift ? shiftRows_[at(k)].impulse : row.normalImpulse;
    const Lanes& bound = kKind == Kind::kShift ? shiftRows_[at(k)].bound : row.bound;
    const Lanes before = sum;
    const Lanes wanted = before - row.relaxedMass * (dot(group.normal, u) - bound);
    const Lanes normal = asked ? (wanted > 0 ? wanted : Lanes{}) : before;
    const Lanes change = normal - before;
    const LaneMask acts = (normal != 0) | (before != 0);
    if (!any(acts)) {
      continue;  // most rows are open
    }
    changed |= asked & acts;
    sum = normal;
    LanesVec impulse = change * group.normal;
    if constexpr (kKind == Kind::kFriction) {
      const Lanes u1 = dot(group.tangent1, u) + row.normalToTangent1 * change;
      const Lanes u2 = dot(group.tangent2, u) + row.normalToTangent2 * change;
      const Lanes limit = group.friction * normal;
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
      impulse = impulse + (p1 - row.tangential1) * group.tangent1 + (p2 - row.tangential2) * group.tangent2;
      row.tangential1 = p1;
      row.tangential2 = p2;
    }
    a.v = a.v + group.a.inverseMass * impulse;
    b.v = b.v - group.b.inverseMass * impulse;
    a.w = a.w + group.a.inertia * cross(row.arm, impulse);
    b.w = b.w - group.b.inertia * cross(armB, impulse);
  }
  if (any(changed)) {
    store<kKind>(group.a, fromA, a, changed);
    store<kKind>(group.b, fromB, b, changed);
  }
}

// Of bodies that cannot move, what was there.
template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::store(const Side& side, const Velocities& from, Velocities to,
                                    const LaneMask& changed) {
  const Lanes one = {1, 1, 1, 1};
  const Lanes change = sumOfSizes(to.v - from.v) + side.radius * sumOfSizes(to.w - from.w);
  const Lanes sum = from.unqueuedChange + change;
  const LaneMask queued = sum > (kKind == Kind::kShift ? shiftChange_ * one : side.change);
  to.unqueuedChange = queued ? Lanes{} : sum;
  to.pushed = changed & (side.inverseMass > 0) ? one : from.pushed;
  transpose(to.v.x, to.v.y, to.v.z, to.unqueuedChange);
  transpose(to.w.x, to.w.y, to.w.z, to.pushed);
  std::vector<Moving>& moving = kKind == Kind::kShift ? shifts_ : moving_;
  const auto put = [&](std::size_t lane, const Lanes& velocity, const Lanes& omega) {
    Moving& body = moving[at(side.body[lane])];
    lanesTo(velocity, body.row(0));
    lanesTo(omega, body.row(1));
  };
  put(0, to.v.x, to.w.x);
  put(1, to.v.y, to.w.y);
  put(2, to.v.z, to.w.z);
  put(3, to.unqueuedChange, to.pushed);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (queued[lane] != 0) {
      queueBlocksOf(side.body[at(lane)]);
    }
  }
}

// ---- What came of it.

double PileSolver::normalSpeed(int row) const {
  const Block& block = blocks_[at(blockOfRow_[at(row)])];
  const Vec3& arm = staged_[at(row)].arm;
  const Moving& a = moving_[at(block.a)];
  const Moving& b = moving_[at(block.b)];
  return block.frame.normal.dot(a.velocity + a.omega.cross(arm) - b.velocity -
                                b.omega.cross(arm + block.apart));
}

ContactResiduals PileSolver::residuals(double speed) const {
  double largest = 0;
  for (const LaneRow& row : rows_) {
    const Lanes squared = row.normalImpulse * row.normalImpulse +
                          (row.tangential1 * row.tangential1 + row.tangential2 * row.tangential2);
    largest = std::max({largest, squared[0], squared[1], squared[2], squared[3]});
  }
  ResidualSum sum(speed, std::sqrt(largest));
  for (std::size_t k = 0; k < staged_.size(); ++k) {
    const int row = static_cast<int>(k);
    const Block& block = blocks_[at(blockOfRow_[k])];
    const Moving& a = moving_[at(block.a)];
    const Moving& b = moving_[at(block.b)];
    const Vec3& arm = staged_[k].arm;
    const Vec3 u = a.velocity + a.omega.cross(arm) - b.velocity - b.omega.cross(arm + block.apart);
    sum.add({.friction = block.friction, .onLine = !(block.friction > 0)},
            {normalImpulse(row), tangential1(row), tangential2(row)},
            {block.frame.normal.dot(u) - rows_[rowAt(row)].bound[laneOf(row)], block.frame.tangent1.dot(u),
             block.frame.tangent2.dot(u)});
  }
  return sum.residuals();
}

}  // namespace careen
