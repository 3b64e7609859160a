#include "physics/pile/block_groups.h"

#include <algorithm>
#include <limits>

namespace careen {
namespace {

constexpr std::size_t kMostOpen = 16;  // groups that a block is tried with
constexpr std::size_t kBlocksPerSlab = 400;
constexpr std::size_t kMostSlabs = 8;
constexpr int kThinLayers = 1024;

// Parts of that many slabs: the slabs, then what is between neighbouring ones, of even pairs and of odd
// pairs; last, blocks of slabs that are no neighbours.
constexpr std::size_t between(std::size_t low, std::size_t slabs) {
  return slabs + (low % 2 == 0 ? 0 : slabs / 2) + low / 2;
}
constexpr std::size_t lastPart(std::size_t slabs) { return 2 * slabs - 1; }

}  // namespace

void BlockGroups::find(std::span<const RowBlock> blocks, std::span<const SolverBody> bodies) {
  blocks_ = blocks;
  bodies_ = bodies;
  findParts();
  divideBlocks();
  forParts([&](std::size_t part, std::size_t, std::size_t) {
    findGroups(parts_[part], static_cast<int>(bodies_.size() + part));
  });
  placeGroups();
}

void BlockGroups::findParts() {
  const auto slabs = std::clamp<std::size_t>(blocks_.size() / kBlocksPerSlab, 1, kMostSlabs);
  const std::size_t parts = lastPart(slabs) + (slabs > 1 ? 1 : 0);
  parts_.resize(parts);
  rounds_.begin(parts);
  partOf_.assign(blocks_.size(), 0);
  if (slabs == 1) {
    return;
  }
  findSlabs(slabs);
  team_->share(blocks_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const RowBlock& block = blocks_[k];
      const std::size_t a = moves(block.a) ? slabs_[at(block.a)] : slabs_[at(block.b)];
      const std::size_t b = moves(block.b) ? slabs_[at(block.b)] : a;
      const auto [low, high] = std::minmax(a, b);
      partOf_[k] = low == high ? low : low + 1 == high ? between(low, slabs) : lastPart(slabs);
    }
  });
  for (std::size_t slab = 0; slab < slabs; ++slab) {
    const std::size_t after = slab + 1 < slabs ? between(slab, slabs) : lastPart(slabs);
    rounds_.setPlace(slab, static_cast<double>(slab) / static_cast<double>(slabs));
    rounds_.setPlace(after, (static_cast<double>(slab) + 0.5) / static_cast<double>(slabs));
  }
}

void BlockGroups::order() {
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
void BlockGroups::findSlabs(std::size_t count) {
  std::vector<std::size_t> ends(bodies_.size(), 0);
  for (const RowBlock& block : blocks_) {
    ++ends[at(block.a)];
    ++ends[at(block.b)];
  }
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  std::size_t all = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (ends[i] > 0 && bodies_[i].moves()) {
      low = low.cwiseMin(bodies_[i].place);
      high = high.cwiseMax(bodies_[i].place);
      all += ends[i];
    }
  }
  slabs_.assign(bodies_.size(), 0);
  int axis = 0;
  if (all == 0 || (high - low).maxCoeff(&axis) == 0) {
    return;
  }
  const double perLength = kThinLayers / (high[axis] - low[axis]);
  const auto layerOf = [&](std::size_t body) {
    const double layer = perLength * (bodies_[body].place[axis] - low[axis]);
    return static_cast<int>(std::clamp(layer, 0.0, kThinLayers - 1.0));
  };
  std::array<std::size_t, kThinLayers> layers{};  // ends in each, then their slabs
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (ends[i] > 0 && bodies_[i].moves()) {
      layers[at(layerOf(i))] += ends[i];
    }
  }
  std::size_t before = 0;
  for (std::size_t& layer : layers) {
    before += std::exchange(layer, before * count / all);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    slabs_[i] = bodies_[i].moves() ? layers[at(layerOf(i))] : 0;
  }
}

// Among the parts, each of which keeps the order of its own.
void BlockGroups::divideBlocks() {
  ordered_.resize(blocks_.size());
  std::vector<std::size_t> next(parts_.size() + 1, 0);
  for (const std::size_t part : partOf_) {
    ++next[part + 1];
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].blocks = std::span(ordered_).subspan(next[k], next[k + 1]);
    next[k + 1] += next[k];
  }
  for (std::size_t index = 0; index < blocks_.size(); ++index) {
    ordered_[next[partOf_[index]]++] = static_cast<int>(index);
  }
}

void BlockGroups::findGroups(Part& part, int nobody) {
  part.groups.clear();
  for (std::vector<int>& open : part.open) {
    open.clear();
  }
  for (const int index : part.blocks) {
    addToGroup(index, part, nobody);
  }
  part.rows = 0;
  for (Group& group : part.groups) {
    group.count = *std::max_element(group.counts.begin(), group.counts.end());
    part.rows += group.count;
  }
}

// The first group with as many rows and none of its bodies, of those that are not full; a new one, if there
// is none.
void BlockGroups::addToGroup(int index, Part& part, int nobody) {
  const RowBlock& block = blocks_[at(index)];
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
    group.a.fill(nobody);
    group.b.fill(nobody);
    found = open.end() - 1;
  }
  Group& group = part.groups[at(*found)];
  const std::size_t lane = at(group.used++);
  group.a[lane] = isRead(block.a) ? block.a : nobody;
  group.b[lane] = isRead(block.b) ? block.b : nobody;
  group.counts[lane] = block.count;
  group.blocks[lane] = index;
  if (group.used == kLanes) {
    open.erase(found);
  }
}

bool BlockGroups::sharesBody(const Group& group, const RowBlock& block) const {
  const int a = isRead(block.a) ? block.a : -1;
  const int b = isRead(block.b) ? block.b : -1;
  bool shares = false;
  for (std::size_t k = 0; k < kLanes; ++k) {
    shares |= (group.a[k] == a) | (group.a[k] == b) | (group.b[k] == a) | (group.b[k] == b);
  }
  return shares;
}

// All parts' one after the other.
void BlockGroups::placeGroups() {
  int rows = 0;
  std::size_t groups = 0;
  for (Part& part : parts_) {
    part.first = groups;
    groups += part.groups.size();
    part.last = groups;
    rows += std::exchange(part.rows, rows);
  }
  groups_.resize(groups);
  placeOf_.resize(blocks_.size());
  forParts([&](std::size_t part, std::size_t first, std::size_t last) {
    int row = parts_[part].rows;
    for (std::size_t k = first; k < last; ++k) {
      Group& group = groups_[k];
      group = parts_[part].groups[k - first];
      group.first = row;
      row += group.count;
      for (int lane = 0; lane < group.used; ++lane) {
        placeOf_[at(group.blocks[at(lane)])] = static_cast<int>(k) * kLanes + lane;
      }
    }
  });
}

}  // namespace careen
