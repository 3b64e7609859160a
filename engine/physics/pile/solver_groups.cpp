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
constexpr std::size_t kBlocksPerSlab = 400;
constexpr std::size_t kMostSlabs = 8;
constexpr int kThinLayers = 1024;
constexpr double kRelaxation = 1.4;  // [1] of normal impulses; 1 to 2. Halves the sweeps that a heap needs.

// Parts of that many slabs: the slabs, then what is between neighbouring ones, of even pairs and of odd
// pairs; last, blocks of slabs that are no neighbours.
constexpr std::size_t between(std::size_t low, std::size_t slabs) {
  return slabs + (low % 2 == 0 ? 0 : slabs / 2) + low / 2;
}
constexpr std::size_t lastPart(std::size_t slabs) { return 2 * slabs - 1; }

}  // namespace

void PileSolver::link() {
  findParts();
  findGroups();
  fillGroups();
  orderParts();
}

void PileSolver::findParts() {
  const auto slabs = std::clamp<std::size_t>(blocks_.size() / kBlocksPerSlab, 1, kMostSlabs);
  const std::size_t parts = lastPart(slabs) + (slabs > 1 ? 1 : 0);
  parts_.resize(parts);
  rounds_.begin(parts);
  for (std::size_t k = 0; k < parts; ++k) {
    parts_[k].nobody = static_cast<int>(bodies_ + 1 + k);
  }
  moving_.resize(bodies_ + 1 + parts);
  if (slabs == 1) {
    return;
  }
  findSlabs(slabs);
  const auto findPart = [&](Block& block) {
    const std::size_t a = movable(block.a) ? slabs_[at(block.a)] : slabs_[at(block.b)];
    const std::size_t b = movable(block.b) ? slabs_[at(block.b)] : a;
    const auto [low, high] = std::minmax(a, b);
    block.part = low == high ? low : low + 1 == high ? between(low, slabs) : lastPart(slabs);
  };
  team_->share(blocks_.size(), [&](std::size_t first, std::size_t last) {
    std::for_each(blocks_.begin() + static_cast<std::ptrdiff_t>(first),
                  blocks_.begin() + static_cast<std::ptrdiff_t>(last), findPart);
  });
  for (std::size_t slab = 0; slab < slabs; ++slab) {
    const std::size_t after = slab + 1 < slabs ? between(slab, slabs) : lastPart(slabs);
    rounds_.setPlace(slab, static_cast<double>(slab) / static_cast<double>(slabs));
    rounds_.setPlace(after, (static_cast<double>(slab) + 0.5) / static_cast<double>(slabs));
  }
}

// Which parts share bodies.
void PileSolver::orderParts() {
  const std::size_t slabs = (parts_.size() + 1) / 2;
  const auto share = [&](std::size_t k, std::size_t other) {
    if (!parts_[k].groups.empty() && !parts_[other].groups.empty()) {
      rounds_.share(k, other);
    }
  };
  for (std::size_t low = 0; low + 1 < slabs; ++low) {
    share(low, between(low, slabs));
    share(low + 1, between(low, slabs));
    if (low > 0) {
      share(between(low - 1, slabs), between(low, slabs));
    }
  }
  for (std::size_t k = 0; k + 1 < parts_.size(); ++k) {
    share(k, lastPart(slabs));
  }
}

// With about as many ends of blocks each: a slab ends between two of many thin layers.
void PileSolver::findSlabs(std::size_t count) {
  std::vector<std::size_t> ends(bodies_ + 1, 0);
  for (const Block& block : blocks_) {
    ++ends[at(block.a)];
    ++ends[at(block.b)];
  }
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  std::size_t all = 0;
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
  std::array<std::size_t, kThinLayers> layers{};  // ends in each, then their slabs
  for (std::size_t i = 0; i < bodies_; ++i) {
    if (ends[i] > 0 && inertia_[i].inverseMass > 0) {
      layers[at(layerOf(i))] += ends[i];
    }
  }
  std::size_t before = 0;
  for (std::size_t& layer : layers) {
    before += std::exchange(layer, before * count / all);
  }
  for (std::size_t i = 0; i < bodies_; ++i) {
    slabs_[i] = inertia_[i].inverseMass > 0 ? layers[at(layerOf(i))] : 0;
  }
}

void PileSolver::findGroups() {
  ordered_.resize(blocks_.size());
  std::vector<std::size_t> next(parts_.size() + 1, 0);
  for (const Block& block : blocks_) {
    ++next[block.part + 1];
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].blocks = std::span(ordered_).subspan(next[k], next[k + 1]);
    next[k + 1] += next[k];
  }
  for (std::size_t index = 0; index < blocks_.size(); ++index) {
    ordered_[next[blocks_[index].part]++] = static_cast<int>(index);
  }
  forParts([&](Part& part) { findGroupsOf(part); });
}

void PileSolver::findGroupsOf(Part& part) {
  part.groups.clear();
  for (std::vector<int>& open : part.open) {
    open.clear();
  }
  for (const int index : part.blocks) {
    findGroup(index, part);
  }
  part.rows = 0;
  for (Group& group : part.groups) {
    group.count = *std::max_element(group.counts.begin(), group.counts.end());
    part.rows += group.count;
  }
}

// The first group with as many rows and none of its bodies, of those that are not full; a new one, if there
// is none.
void PileSolver::findGroup(int index, Part& part) {
  const Block& block = blocks_[at(index)];
  const std::size_t rows = at(block.count);
  if (rows >= part.open.size()) {
    part.open.resize(rows + 1);
  }
  std::vector<int>& open = part.open[rows];
  auto found = std::find_if(open.begin(), open.end(),
                            [&](int group) { return !sharesBody(part.groups[at(group)], block); });
  if (found == open.end()) {
    if (open.size() == kMostOpen) {
      open.erase(open.begin());
    }
    open.push_back(static_cast<int>(part.groups.size()));
    Group& group = part.groups.emplace_back();
    group.a.fill(part.nobody);
    group.b.fill(part.nobody);
    found = open.end() - 1;
  }
  Group& group = part.groups[at(*found)];
  const int lane = group.used++;
  group.a[at(lane)] = movable(block.a) ? block.a : part.nobody;
  group.b[at(lane)] = movable(block.b) ? block.b : part.nobody;
  group.counts[at(lane)] = block.count;
  group.blocks[at(lane)] = index;
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

// By those who will solve them.
void PileSolver::fillGroups() {
  int rows = 0;
  std::size_t groups = 0;
  for (Part& part : parts_) {
    part.first = groups;
    groups += part.groups.size();
    part.last = groups;
    rows += std::exchange(part.rows, rows);
  }
  groups_.resize(groups);
  lanes_.resize(groups);
  rows_.resize(at(rows));
  seen_.resize(groups * kLanes);
  changes_.assign(moving_.size(), 0);
  rowPlaces_.resize(staged_.size());
  blockOfRow_.resize(staged_.size());
  forParts([&](Part& part) {
    fillGroupsOf(part);
    run([&]() __attribute__((always_inline)) {
      for (std::size_t k = part.first; k < part.last; ++k) {
        findMasses(groups_[k], lanes_[k]);
      }
    });
  });
}

void PileSolver::fillGroupsOf(Part& part) {
  int row = part.rows;
  for (std::size_t k = part.first; k < part.last; ++k) {
    Group& group = groups_[k];
    group = part.groups[k - part.first];
    group.first = row;
    row += group.count;
    for (int lane = 0; lane < group.used; ++lane) {
      blocks_[at(group.blocks[at(lane)])].place = static_cast<int>(k) * kLanes + lane;
    }
    std::fill_n(seen_.begin() + static_cast<std::ptrdiff_t>(k * kLanes), kLanes, 0);
    fillGroup(group, lanes_[k]);
  }
}

void PileSolver::fillGroup(const Group& group, LaneBlock& lanes) {
  if (group.used < kLanes) {
    lanes = {};
    std::fill_n(rows_.begin() + group.first, group.count, LaneRow{});
  }
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
