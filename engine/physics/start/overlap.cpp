#include "physics/start/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/names.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

using Indices = std::vector<std::size_t>;

bool passThrough(ApartPairs apart, std::size_t a, std::size_t b) {
  const std::pair pair(static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b)));
  return std::binary_search(apart.begin(), apart.end(), pair);
}

// Boxes whose AABBs overlap, and that may touch, each pair once, in unspecified order: sweep along x.
template <class Visit>
void forBoundsThatMeet(std::span<const PlacedBox> boxes, std::span<const Vec3> positions, ApartPairs apart,
                       const Visit& visit) {
  std::vector<Vec3> reach;
  reach.reserve(boxes.size());
  for (const PlacedBox& box : boxes) {
    reach.emplace_back(box.pose.worldFromBody.cwiseAbs() * box.halfExtents);
  }
  Indices order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto low = [&](std::size_t i) { return positions[i].x() - reach[i].x(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    const double high = positions[i].x() + reach[i].x();
    for (std::size_t l = k + 1; l < order.size() && low(order[l]) <= high; ++l) {
      const std::size_t j = order[l];
      const Vec3 between = (positions[i] - positions[j]).cwiseAbs();
      const Vec3 both = reach[i] + reach[j];
      if (between.y() <= both.y() && between.z() <= both.z() &&
          (boxes[i].inverseMass > 0 || boxes[j].inverseMass > 0) && !passThrough(apart, i, j)) {
        visit(i, j);
      }
    }
  }
}

// Of boxes that have been moved: their separation is given.
BoxAxes axesOf(const PlacedBox& a, const PlacedBox& b, const Vec3& bToA) {
  return {a.pose.worldFromBody, a.halfExtents, b.pose.worldFromBody, b.halfExtents, bToA};
}

// The lengths whose difference is the gap of two boxes.
double lengthsOf(const PlacedBox& a, const PlacedBox& b, const Vec3& at, const Vec3& other) {
  return a.halfExtents.norm() + b.halfExtents.norm() + at.cwiseAbs().sum() + other.cwiseAbs().sum();
}

std::vector<Vec3> positionsOf(std::span<const PlacedBox> boxes) {
  std::vector<Vec3> positions;
  positions.reserve(boxes.size());
  for (const PlacedBox& box : boxes) {
    positions.push_back(box.pose.position);
  }
  return positions;
}

// Convergence: rounding relative to the lengths of the gap.
constexpr double kTight = 0x1p-48;
// No room is detected by stagnating gaps: improvement of less than a thousandth in this many sweeps per box.
// Towers take about 3 n² in all, those with a heavy top more.
constexpr double kStalls = 0.999;
constexpr std::size_t kSweepsPerBox = 100;
constexpr std::size_t kMostPushes = 300'000'000;  // in total: a few seconds
constexpr int kRounds = 200;
// Largest mass ratio to the lightest box: the number of sweeps grows in proportion.
constexpr double kHeaviest = 64;

// Constraint: n·(a − b) ≥ `least`.
struct Barrier {
  std::size_t a = 0;
  std::size_t b = 0;
  int choice = 0;  // rank of the axis among the pair's, by depth: 0 is the least
  Vec3 normal = Vec3::Zero();
  double least = 0;       // [m]
  double lengths = 0;     // [m] whose difference is the gap
  double multiplier = 0;  // [kg m]
};

// Walls are indexed after the boxes: they lie at the origin, and cannot be moved.
class Parting {
 public:
  Parting(std::span<const PlacedBox> boxes, std::span<const Wall> walls, Meeting meeting, ApartPairs apart)
      : boxes_(boxes),
        walls_(walls),
        meeting_(meeting),
        apart_(apart),
        ease_(easeOf(boxes)),
        start_(positionsOf(boxes)),
        now_(start_),
        rank_(boxes.size() + walls.size()) {
    rankByName(boxes_, 0);
    rankByName(walls_, boxes.size());
    ease_.resize(rank_.size(), 0);
    start_.resize(rank_.size(), Vec3::Zero());
    now_ = start_;
  }

  Parted run() {
    bool parted = true;
    for (int round = 0; round < kRounds && pushes_ < kMostPushes; ++round) {
      if (!addBarriers() && parted) {
        return result();
      }
      parted = relax();
      if (!parted && !turnToNextAxis()) {
        break;
      }
    }
    const Barrier& worst = barriers_[deepest()];
    const std::string other =
        isBox(worst.b) ? "box " + boxes_[worst.b].name : "wall " + walls_[worst.b - boxes_.size()].name;
    throw InputError("box " + boxes_[worst.a].name + " cannot be moved out of " + other +
                     ": there is no room for it, " + brief(-gapOf(worst)) +
                     " m are missing; expected boxes that have room to part");
  }

 private:
  bool isBox(std::size_t index) const { return index < boxes_.size(); }

  template <class Named>
  void rankByName(std::span<const Named> named, std::size_t first) {
    const Indices order = orderByName(named);
    for (std::size_t k = 0; k < order.size(); ++k) {
      rank_[first + order[k]] = first + k;
    }
  }

  static std::vector<double> easeOf(std::span<const PlacedBox> boxes) {
    double easiest = 0;
    for (const PlacedBox& box : boxes) {
      easiest = std::max(easiest, box.inverseMass);
    }
    std::vector<double> ease;
    for (const PlacedBox& box : boxes) {
      ease.push_back(box.inverseMass > 0 ? std::max(box.inverseMass, easiest / kHeaviest) : 0);
    }
    return ease;
  }

  double gapOf(const Barrier& barrier) const {
    return dot(barrier.normal, Vec3(now_[barrier.a] - now_[barrier.b])) - barrier.least;
  }
  double easeOf(const Barrier& barrier) const { return ease_[barrier.a] + ease_[barrier.b]; }

  // Order of names, walls after boxes.
  bool before(const Barrier& x, const Barrier& y) const {
    const auto key = [this](const Barrier& each) {
      return std::array<std::size_t, 3>{isBox(each.b) ? 0U : 1U, rank_[each.a], rank_[each.b]};
    };
    return key(x) < key(y);
  }

  // Adds constraints for overlaps at the current positions; false if there are no new ones.
  bool addBarriers() {
    const std::size_t known = barriers_.size();
    if (meeting_ == Meeting::kAll) {
      addPairs();
    }
    addWalls();
    std::sort(barriers_.begin(), barriers_.end(),
              [this](const Barrier& x, const Barrier& y) { return before(x, y); });
    return barriers_.size() > known;
  }

  void addPairs() {
    forBoundsThatMeet(boxes_, now_, apart_, [this](std::size_t i, std::size_t j) {
      const auto [a, b] = rank_[i] < rank_[j] ? std::pair(i, j) : std::pair(j, i);
      const double lengths = lengthsOf(boxes_[a], boxes_[b], now_[a], now_[b]);
      if (!pairs_.contains({a, b}) &&
          axesOf(boxes_[a], boxes_[b], now_[a] - now_[b]).gap() < -kGapAllowance * lengths) {
        pairs_.insert({a, b});
        barriers_.push_back({.a = a, .b = b, .lengths = lengths});
        choose(barriers_.back(), now_[a] - now_[b]);
      }
    });
  }

  void addWalls() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Pose pose{.position = now_[i], .worldFromBody = boxes_[i].pose.worldFromBody};
      for (std::size_t w = 0; w < walls_.size() && ease_[i] > 0; ++w) {
        const LowestGap lowest = lowestGap(walls_[w], {pose, boxes_[i].halfExtents});
        if (lowest.overlaps() && behind_.insert({i, w}).second) {
          const double centre = dot(walls_[w].normal, now_[i]);
          barriers_.push_back({.a = i,
                               .b = boxes_.size() + w,
                               .normal = walls_[w].normal,
                               .least = centre - lowest.gap,
                               .lengths = lowest.lengths});
        }
      }
    }
  }

  // Of the pair's 15 axes in both directions, takes number barrier.choice in order of the distance the boxes
  // must move along it.
  void choose(Barrier& barrier, const Vec3& bToA) const {
    const BoxAxes axes = axesOf(boxes_[barrier.a], boxes_[barrier.b], bToA);
    struct Way {
      double depth = 0;
      int axis = 0;
      double sign = 1;
    };
    std::vector<Way> ways;
    for (int k = 0; k < BoxAxis::kCount; ++k) {
      const double separation = axes.separation({k});
      if (separation > std::numeric_limits<double>::lowest()) {
        ways.push_back({.depth = -separation, .axis = k, .sign = 1});
        const double across = 2 * std::fabs(dot(axes.normal({k}), bToA));
        ways.push_back({.depth = across - separation, .axis = k, .sign = -1});
      }
    }
    std::stable_sort(ways.begin(), ways.end(), [](const Way& x, const Way& y) { return x.depth < y.depth; });
    const Way& way = ways[std::min(static_cast<std::size_t>(barrier.choice), ways.size() - 1)];
    barrier.normal = way.sign * axes.normal({way.axis});
    barrier.least = dot(barrier.normal, bToA) + way.depth;
  }

  // Sweeps until every overlap is removed to rounding; false if that does not converge.
  bool relax() {
    const std::size_t sweeps = kSweepsPerBox * (boxes_.size() + 1);
    double before = std::numeric_limits<double>::max();
    while (pushes_ < kMostPushes) {
      double worst = before;
      for (std::size_t k = 0; k < sweeps && worst > kTight; ++k) {
        worst = sweep();
      }
      if (worst <= kTight) {
        return true;
      }
      if (worst > kStalls * before) {
        break;
      }
      before = worst;
    }
    return std::all_of(barriers_.begin(), barriers_.end(),
                       [this](const Barrier& each) { return gapOf(each) >= -kGapAllowance * each.lengths; });
  }

  // Largest correction of a constraint, relative to its lengths.
  double sweep() {
    double worst = 0;
    for (Barrier& barrier : barriers_) {
      const double before = barrier.multiplier;
      barrier.multiplier = std::max(0.0, before - gapOf(barrier) / easeOf(barrier));
      const double change = barrier.multiplier - before;
      push(barrier, change);
      worst = std::max(worst, std::fabs(change) * easeOf(barrier) / barrier.lengths);
    }
    pushes_ += barriers_.size();
    return worst;
  }

  void push(const Barrier& barrier, double multiplier) {
    now_[barrier.a] += (multiplier * ease_[barrier.a]) * barrier.normal;
    now_[barrier.b] -= (multiplier * ease_[barrier.b]) * barrier.normal;
  }

  std::size_t deepest() const {
    const auto least = std::min_element(
        barriers_.begin(), barriers_.end(),
        [this](const Barrier& x, const Barrier& y) { return gapOf(x) / x.lengths < gapOf(y) / y.lengths; });
    return static_cast<std::size_t>(least - barriers_.begin());
  }

  // For contradictory constraints: next axis for the pair with the largest multiplier, then restart. False if
  // there is no pair among them.
  bool turnToNextAxis() {
    Barrier* hardest = nullptr;
    for (Barrier& each : barriers_) {
      if (isBox(each.b) && (hardest == nullptr || each.multiplier > hardest->multiplier)) {
        hardest = &each;
      }
    }
    if (hardest == nullptr || hardest->choice + 1 >= 2 * BoxAxis::kCount) {
      return false;
    }
    ++hardest->choice;
    now_ = start_;
    choose(*hardest, now_[hardest->a] - now_[hardest->b]);
    for (Barrier& each : barriers_) {
      each.multiplier = 0;
    }
    return true;
  }

  Parted result() const {
    Parted parted{.positions = {now_.begin(), now_.begin() + std::ssize(boxes_)},
                  .pairs = pairs_.size(),
                  .behindWalls = behind_.size()};
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const double way = (now_[i] - start_[i]).norm();
      parted.moved += way > 0 ? 1U : 0U;
      parted.furthest = std::max(parted.furthest, way);
    }
    return parted;
  }

  std::span<const PlacedBox> boxes_;
  std::span<const Wall> walls_;
  Meeting meeting_;
  ApartPairs apart_;
  std::vector<double> ease_;  // [1/kg] inverse mass used for each; 0: fixed
  std::vector<Vec3> start_;
  std::vector<Vec3> now_;
  Indices rank_;  // of its name, walls after boxes
  std::vector<Barrier> barriers_;
  std::set<std::pair<std::size_t, std::size_t>> pairs_;
  std::set<std::pair<std::size_t, std::size_t>> behind_;
  std::size_t pushes_ = 0;
};

}  // namespace

LowestGap lowestGap(const Wall& wall, BoxAt box) {
  const Vec3& halfExtents = box.halfExtents;
  const double reach = dot((box.pose.worldFromBody.transpose() * wall.normal).cwiseAbs(), halfExtents);
  const double size = dot(wall.normal.cwiseAbs(), box.middle().cwiseAbs());
  return {.gap = gapToPlane(box, wall.normal, wall.offset), .lengths = size + reach + std::fabs(wall.offset)};
}

std::vector<Overlap> overlaps(std::span<const PlacedBox> boxes, ApartPairs apart) {
  std::vector<Overlap> all;
  forBoundsThatMeet(boxes, positionsOf(boxes), apart, [&](std::size_t i, std::size_t j) {
    const auto [first, second] = std::minmax(i, j);
    const PlacedBox& a = boxes[first];
    const PlacedBox& b = boxes[second];
    const double gap = BoxAxes(a.at(), b.at()).gap();
    if (gap < -kGapAllowance * lengthsOf(a, b, a.pose.position, b.pose.position)) {
      all.push_back({.first = first, .second = second, .depth = -gap});
    }
  });
  return all;
}

std::optional<Overlap> firstOverlap(std::span<const PlacedBox> boxes, ApartPairs apart) {
  const std::vector<Overlap> all = overlaps(boxes, apart);
  const auto first = std::min_element(all.begin(), all.end(), [](const Overlap& x, const Overlap& y) {
    return std::pair(x.second, x.first) < std::pair(y.second, y.first);
  });
  return first == all.end() ? std::nullopt : std::optional(*first);
}

Parted moveApart(std::span<const PlacedBox> boxes, std::span<const Wall> walls, Meeting meeting,
                 ApartPairs apart) {
  return Parting(boxes, walls, meeting, apart).run();
}

}  // namespace careen
