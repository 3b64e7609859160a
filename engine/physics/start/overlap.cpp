#include "physics/start/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/names.h"
#include "physics/geometry/separation.h"
#include "physics/solver/displacement_solver.h"

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

// Of boxes that have been moved: the way from the place of b's body to that of a's is given.
BoxAxes axesOf(const BoxAt& a, const BoxAt& b, const Vec3& bToA) {
  const Vec3 apart = a.isCentered() && b.isCentered() ? bToA : Vec3(bToA + (a.arm() - b.arm()));
  return {a.pose.worldFromBody, a.halfExtents, b.pose.worldFromBody, b.halfExtents, apart};
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

// Convergence [1] of the lengths of gaps.
constexpr double kTight = 0x1p-46;
constexpr std::size_t kMostPushes = 100'000'000;  // in total: a few seconds
constexpr int kRounds = 200;
// Largest mass ratio to the lightest box: the number of steps grows with its root.
constexpr double kHeaviest = 64;

// Constraint: n·(a − b) ≥ `least`.
struct Barrier {
  std::size_t a = 0;
  std::size_t b = 0;
  int boxA = 0;    // which of a's boxes
  int boxB = 0;    // likewise of b's
  int choice = 0;  // rank of the axis among the pair's, by depth: 0 is the least
  Vec3 normal = Vec3::Zero();
  double least = 0;    // [m]
  double lengths = 0;  // [m] whose difference is the gap
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
    double work = 0;
    const Barrier* hardest = &barriers_.front();
    for (const Barrier& each : barriers_) {
      work += std::max(0.0, -gapOf(each)) * forceOf(each);
      hardest = forceOf(each) > forceOf(*hardest) ? &each : hardest;
    }
    const std::string other = isBox(hardest->b) ? "box " + boxes_[hardest->b].name
                                                : "wall " + walls_[hardest->b - boxes_.size()].name;
    throw InputError("box " + boxes_[hardest->a].name + " cannot be moved out of " + other +
                     ": there is no room for it, " + brief(work / forceOf(*hardest)) +
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
  // [kg m] Of contradictory constraints: what pushes along each grows in proportion to this.
  double forceOf(const Barrier& barrier) const {
    return std::max(0.0, -gapOf(barrier)) / (ease_[barrier.a] + ease_[barrier.b]);
  }

  // Adds constraints for overlaps at the current positions; false if there are no new ones.
  bool addBarriers() {
    const std::size_t known = barriers_.size();
    if (meeting_ == Meeting::kAll) {
      addPairs();
    }
    addWalls();
    std::sort(barriers_.begin(), barriers_.end(), [this](const Barrier& x, const Barrier& y) {
      return std::tuple(rank_[x.a], rank_[x.b], x.boxA, x.boxB) <
             std::tuple(rank_[y.a], rank_[y.b], y.boxA, y.boxB);
    });
    return barriers_.size() > known;
  }

  void addPairs() {
    forBoundsThatMeet(boxes_, now_, apart_, [this](std::size_t i, std::size_t j) {
      const auto [a, b] = rank_[i] < rank_[j] ? std::pair(i, j) : std::pair(j, i);
      const double lengths = lengthsOf(boxes_[a], boxes_[b], now_[a], now_[b]);
      for (int k = 0; k < boxes_[a].partCount(); ++k) {
        for (int l = 0; l < boxes_[b].partCount(); ++l) {
          if (!known_.contains({a, k, b, l}) &&
              axesOf(boxes_[a].at(k), boxes_[b].at(l), now_[a] - now_[b]).gap() < -kGapAllowance * lengths) {
            known_.insert({a, k, b, l});
            barriers_.push_back({.a = a, .b = b, .boxA = k, .boxB = l, .lengths = lengths});
            choose(barriers_.back(), now_[a] - now_[b]);
          }
        }
      }
    });
  }

  void addWalls() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      PlacedBox box = boxes_[i];
      box.pose.position = now_[i];
      for (std::size_t w = 0; w < walls_.size() && ease_[i] > 0; ++w) {
        const LowestGap lowest = lowestGap(walls_[w], box);
        if (lowest.overlaps() && known_.insert({i, 0, boxes_.size() + w, 0}).second) {
          const Vec3 normal = planeAt(walls_[w], 0).normal;
          const double centre = dot(normal, now_[i]);
          barriers_.push_back({.a = i,
                               .b = boxes_.size() + w,
                               .normal = normal,
                               .least = centre - lowest.gap,
                               .lengths = lowest.lengths});
        }
      }
    }
  }

  // Of the pair's 15 axes in both directions, takes number barrier.choice in order of the distance the boxes
  // must move along it.
  void choose(Barrier& barrier, const Vec3& bToA) const {
    const BoxAt boxA = boxes_[barrier.a].at(barrier.boxA);
    const BoxAt boxB = boxes_[barrier.b].at(barrier.boxB);
    const BoxAxes axes = axesOf(boxA, boxB, bToA);
    const Vec3 apart = bToA + (boxA.arm() - boxB.arm());
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
        const double across = 2 * std::fabs(dot(axes.normal({k}), apart));
        ways.push_back({.depth = across - separation, .axis = k, .sign = -1});
      }
    }
    std::stable_sort(ways.begin(), ways.end(), [](const Way& x, const Way& y) { return x.depth < y.depth; });
    const Way& way = ways[std::min(static_cast<std::size_t>(barrier.choice), ways.size() - 1)];
    barrier.normal = way.sign * axes.normal({way.axis});
    barrier.least = dot(barrier.normal, bToA) + way.depth;
  }

  // The least displacement that removes every overlap; false if there is none.
  bool relax() {
    solver_.begin(start_.size(), 0);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      solver_.setBody(static_cast<int>(i), {.inverseMass = ease_[i]});
    }
    double shortest = std::numeric_limits<double>::max();
    for (const Barrier& each : barriers_) {
      const double gap = dot(each.normal, Vec3(start_[each.a] - start_[each.b])) - each.least;
      solver_.add({.a = static_cast<int>(each.a),
                   .b = static_cast<int>(each.b),
                   .normal = each.normal,
                   .bound = -gap});
      shortest = std::min(shortest, each.lengths);
    }
    const std::size_t most = (kMostPushes - pushes_) / barriers_.size();
    const int steps = solver_.solveExactly(kTight * shortest, static_cast<int>(most));
    pushes_ += static_cast<std::size_t>(steps) * barriers_.size();
    for (std::size_t i = 0; i < start_.size(); ++i) {
      now_[i] = start_[i] + solver_.displacement(static_cast<int>(i));
    }
    return std::all_of(barriers_.begin(), barriers_.end(),
                       [this](const Barrier& each) { return gapOf(each) >= -kGapAllowance * each.lengths; });
  }

  // For contradictory constraints: next axis for the pair that is pushed hardest, then restart. False if
  // there is no pair among them.
  bool turnToNextAxis() {
    Barrier* hardest = nullptr;
    for (Barrier& each : barriers_) {
      if (isBox(each.b) && (hardest == nullptr || forceOf(each) > forceOf(*hardest))) {
        hardest = &each;
      }
    }
    if (hardest == nullptr || hardest->choice + 1 >= 2 * BoxAxis::kCount) {
      return false;
    }
    ++hardest->choice;
    now_ = start_;
    choose(*hardest, now_[hardest->a] - now_[hardest->b]);
    return true;
  }

  Parted result() const {
    Parted parted{.positions = {now_.begin(), now_.begin() + std::ssize(boxes_)}};
    for (const Barrier& each : barriers_) {
      ++(isBox(each.b) ? parted.pairs : parted.behindWalls);
    }
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
  DisplacementSolver solver_;
  std::set<std::tuple<std::size_t, int, std::size_t, int>> known_;  // pairs of boxes that have one
  std::size_t pushes_ = 0;
};

}  // namespace

BoxAt PlacedBox::at(int part) const {
  return parts.empty() ? BoxAt{.pose = pose, .halfExtents = halfExtents}
                       : boxAt(pose, parts[static_cast<std::size_t>(part)], part);
}

PlacedBox placedBox(const Body& body, const Pose& pose) {
  PlacedBox placed{.name = body.name,
                   .halfExtents = body.halfExtents,
                   .pose = boxPose(body, pose),
                   .inverseMass = body.mass.inverseMass};
  for (const BodyPart& part : body.parts) {
    placed.parts.push_back(part.seenFrom(body.boxCenter));
  }
  return placed;
}

LowestGap lowestGap(const Wall& atStart, const PlacedBox& placed) {
  const WallPlane wall = planeAt(atStart, 0);
  LowestGap lowest{.gap = std::numeric_limits<double>::infinity()};
  for (int k = 0; k < placed.partCount(); ++k) {
    const BoxAt box = placed.at(k);
    const double gap = gapToPlane(box, wall.normal, wall.offset);
    if (gap < lowest.gap) {
      const double reach =
          dot((box.pose.worldFromBody.transpose() * wall.normal).cwiseAbs(), box.halfExtents);
      const double size = dot(wall.normal.cwiseAbs(), box.middle().cwiseAbs());
      lowest = {.gap = gap, .lengths = size + reach + std::fabs(wall.offset)};
    }
  }
  return lowest;
}

std::vector<Overlap> overlaps(std::span<const PlacedBox> boxes, ApartPairs apart) {
  std::vector<Overlap> all;
  forBoundsThatMeet(boxes, positionsOf(boxes), apart, [&](std::size_t i, std::size_t j) {
    const auto [first, second] = std::minmax(i, j);
    const PlacedBox& a = boxes[first];
    const PlacedBox& b = boxes[second];
    double gap = std::numeric_limits<double>::infinity();
    for (int k = 0; k < a.partCount(); ++k) {
      for (int l = 0; l < b.partCount(); ++l) {
        gap = std::min(gap, BoxAxes(a.at(k), b.at(l)).gap());
      }
    }
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
