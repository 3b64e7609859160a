#include "physics/pile/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>

#include "physics/solver/residual_sum.h"

namespace careen {
namespace {

constexpr std::size_t kMostOpen = 16;  // groups that a block is tried with
constexpr std::size_t kBlocksPerSlab = 800;
constexpr int kMostSlabs = 8;
constexpr int kGroupsPerWord = 64 / kLanes;
constexpr double kRelaxation = 1.4;  // [1] of normal impulses; 1 to 2. Halves the sweeps that a heap needs.

}  // namespace

void PileSolver::begin(std::size_t bodies) {
  bodies_ = bodies;
  moving_.assign(bodies + 1, {});
  inertia_.assign(bodies + 1, {});
  places_.resize(bodies);
  staged_.clear();
  blocks_.clear();
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
  const auto entry = [&](int i, int j) { return scaled.row(i).dot(axes.row(j)); };
  inertia.xx = entry(0, 0);
  inertia.yy = entry(1, 1);
  inertia.zz = entry(2, 2);
  inertia.xy = entry(0, 1);
  inertia.xz = entry(0, 2);
  inertia.yz = entry(1, 2);
}

void PileSolver::beginBlock(int a, Partner b, double friction, const PileFrame& frame, const Vec3& apart) {
  blocks_.emplace_back();
  setBlock({.blocks = static_cast<int>(blocks_.size()) - 1, .rows = static_cast<int>(staged_.size())}, 0, a,
           b, friction, frame, apart);
}

void PileSolver::reserve(Extent all) {
  blocks_.resize(at(all.blocks));
  staged_.resize(at(all.rows));
}

void PileSolver::setBlock(Extent index, int count, int a, Partner b, double friction, const PileFrame& frame,
                          const Vec3& apart) {
  blocks_[at(index.blocks)] = {.a = a,
                               .b = indexOf(b),
                               .first = index.rows,
                               .count = count,
                               .friction = friction,
                               .frame = frame,
                               .apart = apart};
}

// ---- Parts and groups.

void PileSolver::link() {
  findParts();
  findGroups();
  fillGroups();
  listBlocks();
}

// A block of two slabs is a part's between them; of slabs that are no neighbours, the last part's.
void PileSolver::findParts() {
  const int slabs = std::clamp(static_cast<int>(blocks_.size() / kBlocksPerSlab), 1, kMostSlabs);
  phases_ = {{.first = 0, .count = slabs}};
  if (slabs > 1) {
    findSlabs(slabs);
    phases_.push_back({.first = slabs, .count = slabs / 2});
    phases_.push_back({.first = slabs + slabs / 2, .count = (slabs - 1) / 2});
    phases_.push_back({.first = 2 * slabs - 1, .count = 1});
    for (Block& block : blocks_) {
      const int a = movable(block.a) ? slabs_[at(block.a)] : slabs_[at(block.b)];
      const int b = movable(block.b) ? slabs_[at(block.b)] : a;
      const auto [low, high] = std::minmax(a, b);
      block.part = low == high       ? low
                   : low + 1 == high ? phases_[low % 2 == 0 ? 1 : 2].first + low / 2
                                     : phases_[3].first;
    }
  }
  parts_.assign(at(phases_.back().first + phases_.back().count), {});
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].nobody = static_cast<int>(bodies_ + 1 + k);
  }
  moving_.resize(bodies_ + 1 + parts_.size());
}

// With as many ends of blocks each.
void PileSolver::findSlabs(int count) {
  std::vector<int> ends;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  for (const Block& block : blocks_) {
    for (const int body : {block.a, block.b}) {
      if (movable(body)) {
        ends.push_back(body);
        low = low.cwiseMin(places_[at(body)]);
        high = high.cwiseMax(places_[at(body)]);
      }
    }
  }
  slabs_.assign(bodies_ + 1, 0);
  if (ends.empty()) {
    return;
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::vector<double> along(ends.size());
  for (std::size_t k = 0; k < ends.size(); ++k) {
    along[k] = places_[at(ends[k])][axis];
  }
  auto from = along.begin();
  for (int slab = 1; slab < count; ++slab) {
    const auto cut = along.begin() + static_cast<std::ptrdiff_t>(along.size()) * slab / count;
    std::nth_element(from, cut, along.end());
    from = cut;
    for (std::size_t i = 0; i < bodies_; ++i) {
      slabs_[i] += places_[i][axis] >= *cut ? 1 : 0;
    }
  }
}

// Those of a part are in words of waiting_ of their own.
void PileSolver::findGroups() {
  ordered_.resize(blocks_.size());
  std::vector<int> next(parts_.size() + 1, 0);
  for (const Block& block : blocks_) {
    ++next[at(block.part) + 1];
  }
  for (std::size_t k = 1; k < next.size(); ++k) {
    next[k] += next[k - 1];
  }
  for (std::size_t index = 0; index < blocks_.size(); ++index) {
    ordered_[at(next[at(blocks_[index].part)]++)] = static_cast<int>(index);
  }
  groups_.clear();
  std::size_t ordered = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (std::vector<int>& open : open_) {
      open.clear();
    }
    parts_[k].firstWord = groups_.size() / kGroupsPerWord;
    for (; ordered < ordered_.size() && at(blocks_[at(ordered_[ordered])].part) == k; ++ordered) {
      findGroup(ordered_[ordered]);
    }
    groups_.resize((groups_.size() + kGroupsPerWord - 1) / kGroupsPerWord * kGroupsPerWord);
    parts_[k].lastWord = groups_.size() / kGroupsPerWord;
  }
  waiting_.assign(groups_.size() / kGroupsPerWord, 0);
}

// The first group with as many rows and none of its bodies, of those that are not full; a new one, if there
// is none.
void PileSolver::findGroup(int index) {
  Block& block = blocks_[at(index)];
  const std::size_t rows = at(block.count);
  if (rows >= open_.size()) {
    open_.resize(rows + 1);
  }
  std::vector<int>& open = open_[rows];
  auto found = std::find_if(open.begin(), open.end(),
                            [&](int group) { return !sharesBody(groups_[at(group)], block); });
  const int nobody = parts_[at(block.part)].nobody;
  if (found == open.end()) {
    if (open.size() == kMostOpen) {
      open.erase(open.begin());
    }
    open.push_back(static_cast<int>(groups_.size()));
    Group& group = groups_.emplace_back();
    group.a.fill(nobody);
    group.b.fill(nobody);
    found = open.end() - 1;
  }
  Group& group = groups_[at(*found)];
  const int lane = group.used++;
  group.a[at(lane)] = movable(block.a) ? block.a : nobody;
  group.b[at(lane)] = movable(block.b) ? block.b : nobody;
  group.counts[at(lane)] = block.count;
  group.blocks[at(lane)] = index;
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
    shares |= (group.a[k] == a) | (group.a[k] == b) | (group.b[k] == a) | (group.b[k] == b);
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
  rows_.resize(rows);
  lanes_.resize(groups_.size());
  rowPlaces_.resize(staged_.size());
  blockOfRow_.resize(staged_.size());
  team_->share(groups_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      fillGroup(groups_[k], lanes_[k]);
    }
    run([&]() __attribute__((always_inline)) {
      for (std::size_t k = first; k < last; ++k) {
        findMasses(groups_[k], lanes_[k]);
      }
    });
  });
}

void PileSolver::fillGroup(const Group& group, LaneBlock& lanes) {
  lanes = {};
  std::fill_n(rows_.begin() + group.first, group.count, LaneRow{});
  for (int lane = 0; lane < group.used; ++lane) {
    const int index = group.blocks[at(lane)];
    const Block& block = blocks_[at(index)];
    lanes.friction[lane] = block.friction;
    const auto put = [&](LanesVec& to, const Vec3& v) { setLane(to, lane, v.x(), v.y(), v.z()); };
    put(lanes.normal, block.frame.normal);
    put(lanes.tangent1, block.frame.tangent1);
    put(lanes.tangent2, block.frame.tangent2);
    put(lanes.apart, block.apart);
    fillSide(lanes.a, lane, block.a);
    fillSide(lanes.b, lane, block.b);
    for (int k = 0; k < block.count; ++k) {
      const Row& from = staged_[at(block.first + k)];
      LaneRow& row = rows_[at(group.first + k)];
      put(row.arm, from.arm);
      row.bound[lane] = from.bound;
      row.normalImpulse[lane] = from.normalImpulse;
      row.tangential1[lane] = from.tangential1;
      row.tangential2[lane] = from.tangential2;
      rowPlaces_[at(block.first + k)] = at(group.first + k) * kLanes + at(lane);
      blockOfRow_[at(block.first + k)] = index;
    }
  }
}

void PileSolver::fillSide(Side& side, int lane, int body) const {
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
CAREEN_LANES void PileSolver::findMasses(const Group& group, const LaneBlock& lanes) {
  const Lanes one = {1, 1, 1, 1};
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

// The places of each body's blocks, by counting sort.
void PileSolver::listBlocks() {
  firstBlock_.assign(bodies_ + 2, 0);
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

void PileSolver::wakeRow(int row) { putShared(blocks_[at(blockOfRow_[at(row)])].place); }

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

// Those of other parts, which others may put there too, are solved after this phase.
CAREEN_LANES void PileSolver::queueBlocksOf(int body, const Part& part) {
  for (int k = firstBlock_[at(body)]; k < firstBlock_[at(body) + 1]; ++k) {
    const int place = placesOfBody_[at(k)];
    const std::size_t word = at(place) / 64;
    if (word >= part.firstWord && word < part.lastWord) {
      waiting_[word] |= bitOf(place);
    } else {
      putShared(place);
    }
  }
}

std::int64_t PileSolver::solve(int sweeps, bool withFriction) {
  return withFriction ? sweep<Kind::kFriction>(sweeps) : sweep<Kind::kFrictionless>(sweeps);
}

std::int64_t PileSolver::shift(int sweeps, double change) {
  shiftChange_ = change;
  return sweep<Kind::kShift>(sweeps);
}

template <PileSolver::Kind kKind>
std::int64_t PileSolver::sweep(int sweeps) {
  std::int64_t all = 0;
  bool any = true;
  for (int sweep = 0; sweep < sweeps && any; ++sweep) {
    any = false;
    for (const Phase& phase : phases_) {
      const auto work = [&](int k) {
        run([&]() __attribute__((always_inline)) { sweepPart<kKind>(parts_[at(phase.first + k)]); });
      };
      team_->run(phase.count, work);
    }
    for (const Part& part : parts_) {
      all += part.solved;
      any = any || part.solved > 0;
    }
  }
  return all;
}

// Blocks put on the list ahead of the present group are solved in this sweep, the others in the next. The
// word is read again each time; only bits past the last group solved count.
template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::sweepPart(Part& part) {
  std::int64_t solved = 0;
  for (std::size_t word = part.firstWord; word < part.lastWord; ++word) {
    std::uint64_t ahead = ~std::uint64_t{0};
    while ((waiting_[word] & ahead) != 0) {
      const int first = std::countr_zero(waiting_[word] & ahead) / kLanes * kLanes;
      const std::uint64_t lanes = (waiting_[word] >> first) & 0xfU;
      ahead = (~std::uint64_t{0} << first) << kLanes;
      waiting_[word] &= ~(std::uint64_t{0xf} << first);
      solveGroup<kKind>((word * 64 + at(first)) / kLanes, static_cast<unsigned>(lanes), part);
      solved += std::popcount(lanes);
    }
  }
  part.solved = solved;
}

CAREEN_LANES PileSolver::Velocities PileSolver::velocitiesOf(const std::vector<Moving>& moving,
                                                             const std::array<int, kLanes>& bodies) {
  const auto row = [&](std::size_t lane, std::size_t k) {
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

template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::solveGroup(std::size_t index, unsigned lanes, const Part& part) {
  const Group& group = groups_[index];
  const LaneBlock& block = lanes_[index];
  const std::vector<Moving>& moving = kKind == Kind::kShift ? shifts_ : moving_;
  const LaneMask asked = maskOf(lanes);
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
    store<kKind>(group.a, block.a, fromA, a, changed, part);
    store<kKind>(group.b, block.b, fromB, b, changed, part);
  }
}

// Of bodies that cannot move, what was there.
template <PileSolver::Kind kKind>
CAREEN_LANES void PileSolver::store(const std::array<int, kLanes>& bodies, const Side& side,
                                    const Velocities& from, Velocities to, const LaneMask& changed,
                                    const Part& part) {
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
    Moving& body = moving[at(bodies[lane])];
    lanesTo(velocity, body.row(0));
    lanesTo(omega, body.row(1));
  };
  put(0, to.v.x, to.w.x);
  put(1, to.v.y, to.w.y);
  put(2, to.v.z, to.w.z);
  put(3, to.unqueuedChange, to.pushed);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (queued[lane] != 0) {
      queueBlocksOf(bodies[at(lane)], part);
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
  const double largest = team_->largest(rows_.size(), [&](std::size_t first, std::size_t last) {
    double squares = 0;
    for (std::size_t k = first; k < last; ++k) {
      const LaneRow& row = rows_[k];
      const Lanes squared = row.normalImpulse * row.normalImpulse +
                            (row.tangential1 * row.tangential1 + row.tangential2 * row.tangential2);
      squares = std::max({squares, squared[0], squared[1], squared[2], squared[3]});
    }
    return squares;
  });
  ResidualSum sum(speed, std::sqrt(largest));
  std::mutex mutex;
  team_->share(staged_.size(), [&](std::size_t first, std::size_t last) {
    ResidualSum part(speed, std::sqrt(largest));
    for (std::size_t k = first; k < last; ++k) {
      const int row = static_cast<int>(k);
      const Block& block = blocks_[at(blockOfRow_[k])];
      const Moving& a = moving_[at(block.a)];
      const Moving& b = moving_[at(block.b)];
      const Vec3& arm = staged_[k].arm;
      const Vec3 u = a.velocity + a.omega.cross(arm) - b.velocity - b.omega.cross(arm + block.apart);
      part.add({.friction = block.friction, .onLine = !(block.friction > 0)},
               {normalImpulse(row), tangential1(row), tangential2(row)},
               {block.frame.normal.dot(u) - rows_[rowAt(row)].bound[laneOf(row)], block.frame.tangent1.dot(u),
                block.frame.tangent2.dot(u)});
    }
    const std::lock_guard lock(mutex);
    sum.include(part);
  });
  return sum.residuals();
}

}  // namespace careen
