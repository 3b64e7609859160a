#include "render/draw/neighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "render/draw/kept_lists.h"

namespace careen {
namespace {

constexpr float kFlush = 1e-3F;   // [1] of a box's size: in front of a face by less, it does not count
constexpr float kInFront = 0.5F;  // by so much, it counts fully: less covers only a rim of the face
constexpr double kFading = 0.3;   // [1] of what the first one that is left out covers, where weights fall
// [1] of half a box's diagonal: how far its centre is from a face where its shape no longer counts in full,
// and where it does not count at all.
constexpr float kNear = 1;
constexpr float kFar = 1.5F;

constexpr float kTiny = 1e-30F;

using Numbers = Eigen::ArrayXf;  // one for each of several boxes, so that they are looked at together

Numbers smoothstep(const Numbers& from, const Numbers& to, const Numbers& x) {
  const Numbers t = ((x - from) / (to - from)).max(0.0F).min(1.0F);
  return t * t * (3.0F - 2.0F * t);
}

struct Candidate {
  std::size_t box = 0;
  float covers = 0;   // [1] of what the face sees
  float inFront = 0;  // [1] of what it covers if enough of it is in front of the face
  float isFar = 0;    // [1] 1: so far away that its shape does not matter
};

// The boxes about a box, as its faces see them.
class Surroundings {
 public:
  explicit Surroundings(std::span<const DrawnBox> boxes)
      : boxes_(boxes), shapes_(kColumns, static_cast<Eigen::Index>(boxes.size())) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const DrawnBox& box = boxes[i];
      const Mat3 halfAxes = box.pose.worldFromBody * box.halfExtents.asDiagonal();
      auto shape = shapes_.col(static_cast<Eigen::Index>(i));
      shape.segment<9>(kHalfAxes) = halfAxes.reshaped().cast<float>();
      shape[kSize] = static_cast<float>(box.halfExtents.minCoeff()) + kTiny;
      shape[kRadius] = static_cast<float>(box.halfExtents.norm()) + kTiny;
      shape[kArea] = static_cast<float>(largestSilhouette(box) / std::numbers::pi) + kTiny;
    }
  }

  void lookFrom(const Vec3& centre, const std::vector<std::size_t>& near) {
    centre_ = centre;
    near_ = near;
    about_.resize(static_cast<Eigen::Index>(near.size()), kColumns);
    for (std::size_t i = 0; i < near.size(); ++i) {
      auto row = about_.row(static_cast<Eigen::Index>(i));
      row = shapes_.col(static_cast<Eigen::Index>(near[i])).transpose();
      row.segment<3>(kCentre) = (boxes_[near[i]].pose.position - centre).transpose().cast<float>();
    }
  }

  // Those that cover more than `least` of what a face of that box sees, at the face's point nearest to each.
  void find(const DrawnFace& face, float least, std::vector<Candidate>& found) const {
    using Vector = Eigen::Vector3f;
    const auto dot = [&](const Vector& with, int column) -> Numbers {
      return with.x() * about_.col(column) + with.y() * about_.col(column + 1) +
             with.z() * about_.col(column + 2);
    };
    const Vector to = (face.centre - centre_).cast<float>();
    const Vector normal = face.normal.cast<float>();
    const Numbers extent =
        dot(normal, kHalfAxes).abs() + dot(normal, kHalfAxes + 3).abs() + dot(normal, kHalfAxes + 6).abs();
    const Numbers front = dot(normal, kCentre) - normal.dot(to) + extent;
    const Numbers size = about_.col(kSize);
    const Numbers inFront = smoothstep(kFlush * size, kInFront * size, front);
    Numbers apart2 = (about_.col(kCentre) - to.x()).square() + (about_.col(kCentre + 1) - to.y()).square() +
                     (about_.col(kCentre + 2) - to.z()).square();
    for (const Vec3& half : {face.across, face.along}) {
      const Vector edge = half.cast<float>();
      const float edge2 = edge.squaredNorm() + kTiny;
      const Numbers along = dot(edge, kCentre) - edge.dot(to);
      const Numbers part = (along / edge2).max(-1.0F).min(1.0F);
      apart2 -= part * (2.0F * along - edge2 * part);
    }
    const Numbers area = about_.col(kArea);
    const Numbers covers = inFront * (area / apart2.max(area)).min(0.5F);
    const Numbers radius = about_.col(kRadius);
    const Numbers isFar = smoothstep(kNear * radius, kFar * radius, apart2.max(0.0F).sqrt());
    for (Eigen::Index i = 0; i < covers.size(); ++i) {
      if (covers[i] > least) {
        found.push_back({.box = near_[static_cast<std::size_t>(i)],
                         .covers = covers[i],
                         .inFront = inFront[i],
                         .isFar = isFar[i]});
      }
    }
  }

 private:
  // [m] from the centre of the box that looks; then what a box is anywhere.
  enum Column { kCentre = 0, kHalfAxes = 3, kSize = 12, kRadius, kArea, kColumns };

  std::span<const DrawnBox> boxes_;
  Eigen::ArrayXXf shapes_;  // of all, a column each
  Vec3 centre_ = Vec3::Zero();
  std::vector<std::size_t> near_;
  Eigen::ArrayXXf about_;  // of these, a row each
};

// Of candidates that come in order.
void keepOneOfEachBody(std::vector<Candidate>& found, std::span<const DrawnBox> boxes) {
  std::vector<std::size_t> bodies;
  const auto isAgain = [&](const Candidate& each) {
    const std::size_t body = boxes[each.box].shown;
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
std::size_t appendEntries(std::vector<FaceNeighbors::Entry>& entries, const std::vector<Candidate>& found,
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

// Lists of faces that see none of the boxes that have changed, neither as they were nor as they are.
class KeptNeighbors {
 public:
  KeptNeighbors(const KeptLists& kept, double reach) : kept_(kept), reach_(reach), changed_(kept.changed()) {}

  // Appends the face's list, if it is kept.
  bool append(const DrawnFace& face, std::size_t index, const DrawnBox& own, FaceNeighbors& neighbors) {
    const std::optional<std::size_t> before = kept_.before(index);
    if (!before || !counts(face, own, kept_.neighborsBefore().lists[*before].least)) {
      return false;
    }
    FaceNeighbors::List list = kept_.neighborsBefore().lists[*before];
    const auto entries = std::span(kept_.neighborsBefore().entries).subspan(list.begin, list.near + list.far);
    list.begin = neighbors.entries.size();
    neighbors.lists.push_back(list);
    for (const FaceNeighbors::Entry& entry : entries) {
      neighbors.entries.push_back({.box = kept_.boxNow(entry.box), .weight = entry.weight});
    }
    return true;
  }

 private:
  bool counts(const DrawnFace& face, const DrawnBox& own, float least) {
    if (face.box != nearOf_) {
      near_.clear();
      for (std::size_t i = 0; i < kept_.changed().size(); ++i) {
        const DrawnBox& box = kept_.changed()[i];
        if (box.marked && (box.pose.position - own.pose.position).squaredNorm() <= reach_ * reach_) {
          near_.push_back(i);
        }
      }
      changed_.lookFrom(own.pose.position, near_);
      nearOf_ = face.box;
    }
    found_.clear();
    changed_.find(face, std::nextafter(least, 0.0F), found_);
    return found_.empty();
  }

  const KeptLists& kept_;
  double reach_;
  Surroundings changed_;
  std::optional<std::size_t> nearOf_;
  std::vector<std::size_t> near_;
  std::vector<Candidate> found_;
};

}  // namespace

double largestSilhouette(const DrawnBox& box) {
  const Vec3& h = box.halfExtents;
  return 4 * Vec3(h.x() * h.y(), h.y() * h.z(), h.z() * h.x()).norm();
}

FaceNeighbors neighborsOf(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces, double least,
                          const KeptLists* kept) {
  double reach = 0;  // [m] from a face's nearest point to the centre of a box that it still sees
  double radius = 0;
  std::optional<KeptNeighbors> keeping;
  for (const DrawnBox& box : boxes) {
    radius = std::max(radius, box.halfExtents.norm());
    reach = std::max(reach, std::sqrt(largestSilhouette(box) / (std::numbers::pi * least)));
  }
  reach += radius;  // from a box's centre, of which a face's points are no farther away than its corners
  if (kept != nullptr && !kept->isEmpty()) {
    double farthest = reach;
    for (const DrawnBox& box : kept->changed()) {
      farthest = std::max(farthest, std::sqrt(largestSilhouette(box) / (std::numbers::pi * least)) + radius);
    }
    keeping.emplace(*kept, farthest);
  }
  const Cells cells(boxes, std::max(reach, 1e-300));
  const bool hasCopies = haveCopies(boxes);
  FaceNeighbors neighbors;
  Surroundings surroundings(boxes);
  std::vector<std::size_t> near;
  std::size_t nearOf = boxes.size();
  std::vector<Candidate> found;
  for (std::size_t index = 0; index < faces.size(); ++index) {
    const DrawnFace& face = faces[index];
    const DrawnBox& own = boxes[face.box];
    if (!own.marked) {
      neighbors.lists.push_back({.begin = neighbors.entries.size()});
      continue;
    }
    if (keeping && keeping->append(face, index, own, neighbors)) {
      continue;
    }
    if (face.box != nearOf) {
      near.clear();
      cells.around(own.pose.position, [&](std::size_t box) {
        if (boxes[box].shown != own.shown &&
            (boxes[box].pose.position - own.pose.position).squaredNorm() <= reach * reach) {
          near.push_back(box);
        }
      });
      surroundings.lookFrom(own.pose.position, near);
      nearOf = face.box;
    }
    found.clear();
    surroundings.find(face, static_cast<float>(least), found);
    const auto coversMore = [](const Candidate& a, const Candidate& b) {
      return a.covers != b.covers ? a.covers > b.covers : a.box < b.box;
    };
    if (hasCopies) {
      std::sort(found.begin(), found.end(), coversMore);
      keepOneOfEachBody(found, boxes);
    } else {
      const auto enough = static_cast<std::ptrdiff_t>(std::min(found.size(), kMostNear + kMostFar + 1));
      if (found.begin() + enough != found.end()) {
        std::nth_element(found.begin(), found.begin() + enough, found.end(), coversMore);
        found.erase(found.begin() + enough, found.end());
      }
      std::sort(found.begin(), found.end(), coversMore);
    }
    const bool isFull = found.size() > kMostNear + kMostFar;
    FaceNeighbors::List list{.begin = neighbors.entries.size(),
                             .least = isFull ? found.back().covers : static_cast<float>(least)};
    list.near = appendEntries(neighbors.entries, found, kMostNear,
                              [](const Candidate& each) { return 1.0 - each.isFar; });
    list.far =
        appendEntries(neighbors.entries, found, kMostFar, [](const Candidate& each) { return each.isFar; });
    neighbors.lists.push_back(list);
  }
  return neighbors;
}

}  // namespace careen
