// Which blocks of a PileSolver are solved side by side: by several threads, and four by each.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "physics/pile/solver.h"

namespace careen {
namespace {

constexpr std::size_t kMostOpen = 16;  // groups that a block is tried with
constexpr std::size_t kBlocksPerSlab = 800;
constexpr int kMostSlabs = 8;
constexpr int kThinLayers = 1024;
constexpr double kRelaxation = 1.4;  // [1] of normal impulses; 1 to 2. Halves the sweeps that a heap needs.

}  // namespace

void PileSolver::link() {
  findParts();
  findGroups();
  fillGroups();
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

// With about as many ends of blocks each: a slab ends between two of many thin layers.
void PileSolver::findSlabs(int count) {
  std::vector<int> ends(bodies_ + 1, 0);
  for (const Block& block : blocks_) {
    ++ends[at(block.a)];
    ++ends[at(block.b)];
  }
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  int all = 0;
  for (std::size_t i = 0; i < bodies_; ++i) {
    if (ends[i] > 0 && inertia_[i].inverseMass > 0) {
      low = low.cwiseMin(places_[i]);
      high = high.cwiseMax(places_[i]);
      all += ends[i];
    }
  }
  slabs_.assign(bodies_ + 1, 0);
  int axis = 0;
  if (all == 0 || (high - low).maxCoeff(&axis) == 0) {
    return;
  }
  const double perLength = kThinLayers / (high[axis] - low[axis]);
  const auto layerOf = [&](std::size_t body) {
    const double layer = perLength * (places_[body][axis] - low[axis]);
    return static_cast<int>(std::clamp(layer, 0.0, kThinLayers - 1.0));
  };
  std::array<int, kThinLayers> layers{};  // ends in each, then their slabs
  for (std::size_t i = 0; i < bodies_; ++i) {
    if (ends[i] > 0 && inertia_[i].inverseMass > 0) {
      layers[at(layerOf(i))] += ends[i];
    }
  }
  int before = 0;
  for (int& layer : layers) {
    before += std::exchange(layer, static_cast<int>(std::int64_t{before} * count / all));
  }
  for (std::size_t i = 0; i < bodies_; ++i) {
    slabs_[i] = inertia_[i].inverseMass > 0 ? layers[at(layerOf(i))] : 0;
  }
}

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
    parts_[k].first = groups_.size();
    for (; ordered < ordered_.size() && at(blocks_[at(ordered_[ordered])].part) == k; ++ordered) {
      findGroup(ordered_[ordered]);
    }
    parts_[k].last = groups_.size();
  }
  changes_.assign(moving_.size(), 0);
  seen_.assign(groups_.size() * kLanes, 0);
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

}  // namespace careen
