#include "physics/pile/pairs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "physics/pile/index.h"

namespace careen {
namespace {

constexpr double kFat = 0.1;  // [1] of the smallest size, on every side
constexpr int kLeaf = 4;
constexpr int kMostRefits = 16;
constexpr std::size_t kDeepest = 128;

// The bits of a key: 24 of a's place, one of half-spaces, 23 of b's place, 8 of a's box, 8 of b's.
constexpr unsigned kBoxBits = 8;
constexpr unsigned kPlaceBits = 23;
constexpr unsigned kShiftOfB = 2 * kBoxBits;
constexpr unsigned kShiftOfA = kShiftOfB + kPlaceBits + 1;
constexpr std::uint64_t kMostPlace = (1U << kPlaceBits) - 1;
constexpr std::uint64_t kMostBox = (1U << kBoxBits) - 1;
constexpr std::uint64_t kHalfSpace = 1ULL << (kShiftOfB + kPlaceBits);

PilePair pairOf(std::uint64_t key) {
  return {.key = key,
          .a = static_cast<int>(key >> kShiftOfA),
          .b = static_cast<int>(key >> kShiftOfB & kMostPlace),
          .boxA = static_cast<int>(key >> kBoxBits & kMostBox),
          .boxB = static_cast<int>(key & kMostBox)};
}

}  // namespace

const PilePairs::Box PilePairs::kNowhere = {.low = Vec3::Constant(std::numeric_limits<double>::max()),
                                            .high = Vec3::Constant(-std::numeric_limits<double>::max())};

bool PilePairs::Box::overlaps(const Box& other) const {
  return low.x() <= other.high.x() && other.low.x() <= high.x() && low.y() <= other.high.y() &&
         other.low.y() <= high.y() && low.z() <= other.high.z() && other.low.z() <= high.z();
}

bool PilePairs::Box::holds(const Box& other) const {
  return low.x() <= other.low.x() && other.high.x() <= high.x() && low.y() <= other.low.y() &&
         other.high.y() <= high.y() && low.z() <= other.low.z() && other.high.z() <= high.z();
}

void PilePairs::Box::include(const Box& other) {
  low = low.cwiseMin(other.low);
  high = high.cwiseMax(other.high);
}

void PilePairs::clearPlace(int body) {
  if (at(body) < fat_.size()) {
    fat_[at(body)] = kNowhere;
  }
  std::erase_if(pairs_, [&](const PilePair& pair) {
    const bool gone = pair.a == body || pair.b == body;
    if (gone && pair.slot >= 0) {
      freed_.push_back(pair.slot);
    }
    return gone;
  });
}

// AABB of the box over `time` at its current velocities; rotation moves no corner farther than 2 radii, and
// no side farther than angle × radius.
PilePairs::Box PilePairs::sweptBox(const PileBody& body, const Vec3& gravity, double time) {
  const Vec3 reach = body.axes.cwiseAbs() * body.halfExtents;
  const Vec3 middle = body.middle();
  Box box{.low = middle - reach, .high = middle + reach};
  if (body.stays()) {
    return box;
  }
  const Vec3 moved =
      time * (body.isDriven() ? body.velocity : Vec3(body.velocity + (time + body.behind) * gravity));
  const double turned = body.radius * std::min(1.0, body.omega.norm() * time);
  box.low += moved.cwiseMin(0) - Vec3::Constant(turned);
  box.high += moved.cwiseMax(0) + Vec3::Constant(turned);
  return box;
}

// Gives those that left their fat AABBs new ones; whether there are any.
bool PilePairs::findLeft(std::span<const PileBody> bodies, const Vec3& gravity, double time,
                         double lookAhead) {
  std::atomic<bool> any = false;
  team_->share(bodies.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const PileBody& body = bodies[i];
      const bool stays = body.absent || !body.isBox() ||
                         (body.stays() && fat_[i].low.x() <= fat_[i].high.x()) ||
                         fat_[i].holds(sweptBox(body, gravity, time));
      left_[i] = stays ? 0 : 1;
      if (!stays) {
        const Vec3 margin = Vec3::Constant(kFat * body.length);
        fat_[i] = sweptBox(body, gravity, lookAhead);
        fat_[i].low -= margin;
        fat_[i].high += margin;
        any = true;
      }
    }
  });
  return any;
}

void PilePairs::update(std::span<const PileBody> bodies, const Vec3& gravity, double time, double lookAhead) {
  if (fat_.size() < bodies.size()) {
    fat_.resize(bodies.size(), kNowhere);
    left_.resize(bodies.size(), 0);
    nodes_.clear();
  }
  if (!findLeft(bodies, gravity, time, lookAhead)) {
    return;
  }
  if (nodes_.empty() || ++refits_ > kMostRefits) {
    buildTree();
  } else {
    refit();
  }
  found_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (left_[i] != 0) {
      findPartners(bodies, static_cast<int>(i));
    }
  }
  std::sort(found_.begin(), found_.end());
  merge();
}

void PilePairs::buildTree() {
  refits_ = 0;
  nodes_.clear();
  order_.resize(fat_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    order_[i] = static_cast<int>(i);
  }
  if (!order_.empty()) {
    buildNode(0, static_cast<int>(order_.size()));
  }
}

int PilePairs::buildNode(int first, int count) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({.box = fat_[at(order_[at(first)])], .first = first, .count = count});
  Box centers{.low = fat_[at(order_[at(first)])].low + fat_[at(order_[at(first)])].high};
  centers.high = centers.low;
  for (int k = first + 1; k < first + count; ++k) {
    const Box& box = fat_[at(order_[at(k)])];
    nodes_[at(index)].box.include(box);
    const Vec3 center = box.low + box.high;
    centers.include({.low = center, .high = center});
  }
  if (count > kLeaf) {
    int axis = 0;
    (centers.high - centers.low).maxCoeff(&axis);
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](int i, int j) {
      const double x = fat_[at(i)].low[axis] + fat_[at(i)].high[axis];
      const double y = fat_[at(j)].low[axis] + fat_[at(j)].high[axis];
      return x < y || (x == y && i < j);
    });
    buildNode(first, count / 2);
    nodes_[at(index)].right = buildNode(first + count / 2, count - count / 2);
  }
  return index;
}

void PilePairs::refit() {
  for (std::size_t k = nodes_.size(); k-- > 0;) {
    Node& node = nodes_[k];
    if (node.right == 0) {
      node.box = fat_[at(order_[at(node.first)])];
      for (int i = node.first + 1; i < node.first + node.count; ++i) {
        node.box.include(fat_[at(order_[at(i)])]);
      }
    } else {
      node.box = nodes_[k + 1].box;
      node.box.include(nodes_[at(node.right)].box);
    }
  }
}

// A pair of two bodies that both left is found from the lower place.
void PilePairs::findPartners(std::span<const PileBody> bodies, int body) {
  const Box& box = fat_[at(body)];
  const bool held = bodies[at(body)].held();
  std::array<int, kDeepest> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const int index = stack[--size];
    const Node& node = nodes_[at(index)];
    if (!node.box.overlaps(box)) {
      continue;
    }
    if (node.right != 0) {
      stack[size++] = node.right;
      stack[size++] = index + 1;
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k) {
      const int other = order_[at(k)];
      const bool twice = left_[at(other)] != 0 && other < body;
      if (other != body && !twice && !(held && bodies[at(other)].held()) && box.overlaps(fat_[at(other)]) &&
          (!mayTouch_ || mayTouch_(body, other))) {
        const auto [a, b] = std::minmax(body, other);
        addFound(bodies[at(a)], a, bodies[at(b)], b);
      }
    }
  }
  if (held) {
    return;
  }
  for (int w = 0; !bodies[at(w)].isBox(); ++w) {
    const PileBody& wall = bodies[at(w)];
    const WallPlane plane = wall.plane();
    const Vec3& n = plane.normal;
    const Vec3 lowest = (n.array() > 0).select(box.low, box.high);
    if (wall.isDriven() || dot(n, lowest) <= plane.offset) {  // what is driven may come anywhere
      addFound(bodies[at(body)], body, bodies[at(w)], w);
    }
  }
}

// All boxes of the two.
void PilePairs::addFound(const PileBody& a, int placeA, const PileBody& b, int placeB) {
  const std::uint64_t key = static_cast<std::uint64_t>(placeA) << kShiftOfA |
                            static_cast<std::uint64_t>(placeB) << kShiftOfB | (b.isBox() ? 0 : kHalfSpace);
  for (int i = 0; i < a.partCount(); ++i) {
    for (int j = 0; j < b.partCount(); ++j) {
      found_.push_back(key | static_cast<std::uint64_t>(i) << kBoxBits | static_cast<std::uint64_t>(j));
    }
  }
}

// Keeps old pairs of which neither body left; of the others, those found again.
void PilePairs::merge() {
  merged_.clear();
  auto found = found_.begin();
  const auto hasLeft = [&](const PilePair& pair) { return left_[at(pair.a)] != 0 || left_[at(pair.b)] != 0; };
  const auto add = [&] {
    merged_.push_back(pairOf(*found));
    ++found;
  };
  for (const PilePair& old : pairs_) {
    while (found != found_.end() && *found < old.key) {
      add();
    }
    const bool again = found != found_.end() && *found == old.key;
    if (again) {
      ++found;
    }
    if (again || !hasLeft(old)) {
      merged_.push_back(old);
    } else if (old.slot >= 0) {
      freed_.push_back(old.slot);
    }
  }
  while (found != found_.end()) {
    add();
  }
  pairs_.swap(merged_);
}

}  // namespace careen
