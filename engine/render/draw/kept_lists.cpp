#include "render/draw/kept_lists.h"

#include <algorithm>
#include <utility>

namespace careen {
namespace {

constexpr std::size_t kSides = 6;

bool isSame(const DrawnBox& a, const DrawnBox& b) {
  return a.pose.position == b.pose.position && a.pose.worldFromBody == b.pose.worldFromBody &&
         a.halfExtents == b.halfExtents && a.marked == b.marked && a.mesh == b.mesh;
}

// Of each number that boxes may have, the box that has it.
std::vector<std::optional<std::size_t>> byNumber(std::span<const DrawnBox> boxes, std::size_t count) {
  std::vector<std::optional<std::size_t>> places(count);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    places[boxes[i].shown] = i;
  }
  return places;
}

}  // namespace

void KeptLists::begin(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces, const Vec3& eye,
                      double pixelAngle) {
  faceBefore_.clear();
  changed_.clear();
  if (eye == eye_ && pixelAngle == pixelAngle_ && !faces_.empty() && !haveCopies(boxes) &&
      !haveCopies(boxes_)) {
    compare(boxes, faces);
  }
  eye_ = eye;
  pixelAngle_ = pixelAngle;
  boxes_.assign(boxes.begin(), boxes.end());
  faces_.assign(faces.begin(), faces.end());
}

void KeptLists::compare(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces) {
  std::size_t count = 0;
  for (const std::span<const DrawnBox> all : {boxes, std::span<const DrawnBox>(boxes_)}) {
    for (const DrawnBox& box : all) {
      count = std::max(count, box.shown + 1);
    }
  }
  const std::vector<std::optional<std::size_t>> now = byNumber(boxes, count);
  const std::vector<std::optional<std::size_t>> before = byNumber(boxes_, count);
  boxNow_.assign(boxes_.size(), 0);
  std::vector<bool> isKept(boxes.size());
  for (std::size_t number = 0; number < count; ++number) {
    if (now[number] && before[number] && isSame(boxes[*now[number]], boxes_[*before[number]])) {
      boxNow_[*before[number]] = *now[number];
      isKept[*now[number]] = true;
      continue;
    }
    for (const auto& [place, of] :
         {std::pair(before[number], std::span<const DrawnBox>(boxes_)), std::pair(now[number], boxes)}) {
      if (place) {
        changed_.push_back(of[*place]);
      }
    }
  }
  if (changed_.size() >= boxes.size()) {
    changed_.clear();
    return;
  }
  std::vector<std::optional<std::size_t>> faceOf(kSides * count);
  const auto numberOf = [](const DrawnBox& box, const DrawnFace& face) {
    return kSides * box.shown + static_cast<std::size_t>(face.side);
  };
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    faceOf[numberOf(boxes_[faces_[i].box], faces_[i])] = i;
  }
  faceBefore_.resize(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (isKept[faces[i].box]) {
      faceBefore_[i] = faceOf[numberOf(boxes[faces[i].box], faces[i])];
    }
  }
}

void KeptLists::keep(FaceShadows shadows, FaceNeighbors neighbors) {
  shadows_ = std::move(shadows);
  neighbors_ = std::move(neighbors);
}

}  // namespace careen
