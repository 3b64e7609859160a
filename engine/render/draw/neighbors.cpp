#include "render/draw/neighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <unordered_map>

namespace careen {
namespace {

constexpr double kFlush = 1e-3;   // [1] of a box's size: in front of a face by less, it does not count
constexpr double kInFront = 0.5;  // by so much, it counts fully: less covers only a rim of the face
constexpr double kFading = 0.3;   // [1] of what the first one that is left out covers, where weights fall
// [1] of half a box's diagonal: how far its centre is from a face where its shape no longer counts in full,
// and where it does not count at all.
constexpr double kNear = 1;
constexpr double kFar = 1.5;

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct Candidate {
  std::size_t box = 0;
  double covers = 0;
  double inFront = 0;  // [1] of what it covers if enough of it is in front of the face
  double isNear = 0;   // [1] 0: so far away that its shape does not matter
};

// About the part of what a face sees that a box covers, at the face's point nearest to it.
Candidate candidateOf(const DrawnBox& box, double area, const DrawnFace& face) {
  const Vec3 to = box.pose.position - face.centre;
  const Vec3 axes = box.pose.worldFromBody.transpose() * face.normal;
  const double front = face.normal.dot(to) + axes.cwiseAbs().dot(box.halfExtents);
  const double size = box.halfExtents.minCoeff();
  if (front <= kFlush * size) {
    return {};
  }
  const auto beyond = [&](const Vec3& half) {
    const double size2 = half.squaredNorm();
    const double part = size2 > 0 ? std::clamp(half.dot(to) / size2, -1.0, 1.0) : 0;
    return Vec3(part * half);
  };
  const Vec3 apart = to - beyond(face.across) - beyond(face.along);
  const double inFront = smoothstep(kFlush * size, kInFront * size, front);
  const double most = std::min(0.5, area / (std::numbers::pi * std::max(apart.squaredNorm(), 1e-300)));
  const double away = apart.norm() / box.halfExtents.norm();
  return {
      .box = 0, .covers = inFront * most, .inFront = inFront, .isNear = 1 - smoothstep(kNear, kFar, away)};
}

// Of candidates that come in order.
void keepOneOfEachBody(std::vector<Candidate>& found, std::span<const DrawnBox> boxes) {
  std::vector<std::size_t> bodies;
  const auto isAgain = [&](const Candidate& each) {
    const std::size_t body = boxes[each.box].body;
    if (std::find(bodies.begin(), bodies.end(), body) != bodies.end()) {
      return true;
    }
    bodies.push_back(body);
    return false;
  };
  found.erase(std::remove_if(found.begin(), found.end(), isAgain), found.end());
}

// Appends the first of the candidates that have a share, `most` of them; how many. What is left out is never
// more than half of what a face can see, and a weight is as much as nothing before its box is left out.
template <class Share>
std::size_t appendEntries(std::vector<Neighbors::Entry>& entries, const std::vector<Candidate>& found,
                          std::size_t most, const Share& shareOf) {
  std::vector<const Candidate*> kept;
  double out = 0;
  for (const Candidate& each : found) {
    if (shareOf(each) > 0) {
      if (kept.size() == most) {
        out = each.covers;
        break;
      }
      kept.push_back(&each);
    }
  }
  for (const Candidate* const each : kept) {
    const double fades = std::min(kFading * out, 0.5 - out);
    const double stays = fades > 0 ? std::min(1.0, (each->covers - out) / fades) : 1;
    entries.push_back({.box = each->box, .weight = stays * each->inFront * shareOf(*each)});
  }
  return kept.size();
}

// Boxes by cells of space.
class Cells {
 public:
  Cells(std::span<const DrawnBox> boxes, double size) : size_(size) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].marked) {
        content_[key(cellOf(boxes[i].pose.position))].push_back(i);
      }
    }
  }

  template <class Do>
  void around(const Vec3& point, const Do& doWith) const {
    const std::array<std::int64_t, 3> cell = cellOf(point);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          content_.find(key({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1}));
      if (found != content_.end()) {
        std::for_each(found->second.begin(), found->second.end(), doWith);
      }
    }
  }

 private:
  std::array<std::int64_t, 3> cellOf(const Vec3& point) const {
    const auto index = [&](double x) {
      return static_cast<std::int64_t>(std::floor(std::clamp(x / size_, -1e15, 1e15)));
    };
    return {index(point.x()), index(point.y()), index(point.z())};
  }
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t mixed = 0;
    for (const std::int64_t index : cell) {
      mixed = (mixed ^ static_cast<std::uint64_t>(index)) * 0x9E3779B97F4A7C15U;
      mixed ^= mixed >> 29U;
    }
    return mixed;
  }

  double size_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> content_;
};

}  // namespace

double largestSilhouette(const DrawnBox& box) {
  const Vec3& h = box.halfExtents;
  return 4 * Vec3(h.x() * h.y(), h.y() * h.z(), h.z() * h.x()).norm();
}

Neighbors neighborsOf(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces, double least) {
  std::vector<double> areas;
  std::vector<double> reaches;  // [m] from a face's nearest point to where each box covers as much as nothing
  double reach = 0;             // [m] from a face's nearest point to the centre of a box that it still sees
  double radius = 0;
  for (const DrawnBox& box : boxes) {
    areas.push_back(largestSilhouette(box));
    radius = std::max(radius, box.halfExtents.norm());
    reaches.push_back(std::sqrt(areas.back() / (std::numbers::pi * least)));
    reach = std::max(reach, reaches.back());
  }
  reach += radius;  // from a box's centre, of which a face's points are no farther away than its corners
  const Cells cells(boxes, std::max(reach, 1e-300));
  std::vector<std::size_t> bodies;
  std::transform(boxes.begin(), boxes.end(), std::back_inserter(bodies),
                 [](const DrawnBox& box) { return box.body; });
  std::sort(bodies.begin(), bodies.end());
  const bool hasCopies = std::adjacent_find(bodies.begin(), bodies.end()) != bodies.end();
  Neighbors neighbors;
  std::vector<std::size_t> near;
  std::size_t nearOf = boxes.size();
  std::vector<Candidate> found;
  for (const DrawnFace& face : faces) {
    const DrawnBox& own = boxes[face.box];
    if (!own.marked) {
      neighbors.lists.push_back({.begin = neighbors.entries.size()});
      continue;
    }
    if (face.box != nearOf) {
      near.clear();
      cells.around(own.pose.position, [&](std::size_t box) {
        if (boxes[box].body != own.body &&
            (boxes[box].pose.position - own.pose.position).squaredNorm() <= reach * reach) {
          near.push_back(box);
        }
      });
      nearOf = face.box;
    }
    found.clear();
    const double size = std::sqrt(face.across.squaredNorm() + face.along.squaredNorm());
    for (const std::size_t box : near) {
      const Vec3 to = boxes[box].pose.position - face.centre;
      const double most = reaches[box] + size;
      if (face.normal.dot(to) <= -radius || to.squaredNorm() > most * most) {
        continue;
      }
      Candidate candidate = candidateOf(boxes[box], areas[box], face);
      if (candidate.covers > least) {
        candidate.box = box;
        found.push_back(candidate);
      }
    }
    const auto coversMore = [](const Candidate& a, const Candidate& b) {
      return a.covers != b.covers ? a.covers > b.covers : a.box < b.box;
    };
    if (hasCopies) {
      std::sort(found.begin(), found.end(), coversMore);
      keepOneOfEachBody(found, boxes);
    } else {
      const std::size_t enough = std::min(found.size(), kMostNear + kMostFar + 1);
      std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(enough), found.end(),
                        coversMore);
      found.resize(enough);
    }
    Neighbors::List list{.begin = neighbors.entries.size()};
    list.near =
        appendEntries(neighbors.entries, found, kMostNear, [](const Candidate& each) { return each.isNear; });
    list.far = appendEntries(neighbors.entries, found, kMostFar,
                             [](const Candidate& each) { return 1 - each.isNear; });
    neighbors.lists.push_back(list);
  }
  return neighbors;
}

}  // namespace careen
