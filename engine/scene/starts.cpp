#include "scene/starts.h"

#include <cstddef>
#include <vector>

namespace careen {
namespace {

std::vector<PlacedBox> placedBoxes(const Scene& scene) {
  std::vector<PlacedBox> placed;
  placed.reserve(scene.boxes.size());
  for (const SceneBox& box : scene.boxes) {
    placed.push_back({.name = box.name,
                      .halfExtents = box.halfExtents,
                      .pose = box.pose,
                      .inverseMass = box.fixed ? 0 : 1 / box.mass});
  }
  return placed;
}

}  // namespace

std::optional<Overlap> findOverlap(const Scene& scene) {
  return traitsOf(scene.method).boxBox ? firstOverlap(placedBoxes(scene)) : std::nullopt;
}

Parted moveApart(Scene& scene) {
  const bool meet = traitsOf(scene.method).boxBox;
  Parted parted = moveApart(placedBoxes(scene), wallsOf(scene), meet ? Meeting::kAll : Meeting::kWalls);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    scene.boxes[i].pose.position = parted.positions[i];
  }
  scene.startsApart = meet;
  return parted;
}

}  // namespace careen
