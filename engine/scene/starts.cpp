#include "scene/starts.h"

#include <cstddef>
#include <string>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "physics/world/method.h"

namespace careen {
namespace {

std::vector<PlacedBox> placedBoxes(const Scene& scene) {
  std::vector<PlacedBox> placed;
  placed.reserve(scene.boxes.size());
  for (const SceneBox& box : scene.boxes) {
    placed.push_back(placedBox(box));
  }
  return placed;
}

}  // namespace

PlacedBox placedBox(const SceneBox& box) {
  return {.name = box.name,
          .halfExtents = box.halfExtents,
          .pose = box.pose,
          .inverseMass = box.fixed ? 0 : 1 / box.mass,
          .parts = box.parts};
}

std::optional<Overlap> findOverlap(const Scene& scene) {
  return traitsOf(scene.settings.method).boxBox ? firstOverlap(placedBoxes(scene), scene.apart)
                                                : std::nullopt;
}

void checkApart(const Scene& scene) {
  if (const std::optional<Overlap> overlap = findOverlap(scene)) {
    throw InputError("box " + scene.boxes[overlap->second].name + " starts " + brief(overlap->depth) +
                     " m inside box " + scene.boxes[overlap->first].name +
                     "; expected boxes apart, as method " +
                     std::string(traitsOf(scene.settings.method).name) + " lets them meet");
  }
}

Parted moveApart(Scene& scene) {
  const bool meet = traitsOf(scene.settings.method).boxBox;
  Parted parted =
      moveApart(placedBoxes(scene), wallsOf(scene), meet ? Meeting::kAll : Meeting::kWalls, scene.apart);
  for (const Joint& joint : scene.joints) {
    for (const JointEnd& end : {joint.from, joint.to}) {
      const auto box = static_cast<std::size_t>(end.body.value_or(0));
      if (end.body && parted.positions[box] != scene.boxes[box].pose.position) {
        throw InputError("box " + scene.boxes[box].name + " of joint " + joint.name +
                         " starts inside another box or a wall; expected boxes of joints apart from others, "
                         "or that pass through them, as moving them would tear the joint");
      }
    }
  }
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    scene.boxes[i].pose.position = parted.positions[i];
  }
  return parted;
}

}  // namespace careen
