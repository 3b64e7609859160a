#include "scene/scene_check.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/brief.h"
#include "physics/start/overlap.h"
#include "physics/world/given_inertia.h"
#include "scene/box_names.h"
#include "scene/film_check.h"
#include "scene/joint_check.h"
#include "scene/json_shape.h"
#include "scene/mesh_mass.h"
#include "scene/starts.h"

namespace careen {
namespace {

// The node of the member if the object has it, else that of the object.
const JsonNode& memberOrSelf(const JsonNode& object, std::string_view key) {
  const JsonNode* const child = object.find(key);
  return child == nullptr ? object : *child;
}

const JsonNode& elementOf(const JsonTree& tree, std::string_view list, std::size_t index) {
  return tree.root().find(list)->children[index];
}

void checkRoom(const JsonTree& tree, const Scene& scene) {
  if (!scene.room) {
    return;
  }
  const JsonNode& max = *tree.root().find("room")->find("max");
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!(scene.room->min[axis] < scene.room->max[axis])) {
      const JsonNode& node = max.children[static_cast<std::size_t>(axis)];
      tree.fail(node.offset, describe(node) + " for room.max[" + std::to_string(axis) + "]",
                "more than room.min[" + std::to_string(axis) + "], which is " + brief(scene.room->min[axis]));
    }
  }
}

// Boxes and walls share a column of impacts.csv.
// After its times are checked: what it is at the start is no change.
void takeGravityAtStart(const JsonTree& tree, Scene& scene) {
  for (std::size_t k = 0; k < scene.gravityChanges.size(); ++k) {
    const double time = scene.gravityChanges[k].time;
    if (k == 0 ? time != 0 : !(time > scene.gravityChanges[k - 1].time)) {
      const JsonNode& found = tree.root().find("gravity")->find("path")->children[k].children[0];
      tree.fail(found.offset, describe(found) + " for gravity.path[" + std::to_string(k) + "][0]",
                k == 0 ? "0, the start" : "a time after that of the point before");
    }
  }
  if (!scene.gravityChanges.empty()) {
    scene.gravityChanges.erase(scene.gravityChanges.begin());
  }
}

void checkNames(const JsonTree& tree, const Scene& scene) {
  std::map<std::string, std::string> owners;
  for (std::size_t side = 0; side < kRoomSides.size(); ++side) {
    owners.emplace(roomWallName(side), "a wall of the room");
  }
  const auto claim = [&](const std::string& name, std::string_view list, std::size_t index) {
    const std::string owner = std::string(list) + "[" + std::to_string(index) + "]";
    const auto [first, fresh] = owners.emplace(name, owner);
    if (!fresh) {
      const JsonNode& node = elementOf(tree, list, index);
      const std::string byDefault = node.find("name") == nullptr ? ", its name for want of one" : "";
      tree.fail(memberOrSelf(node, "name").offset, inQuotes(name) + " for " + owner + byDefault,
                "another name: " + first->second + " has this one");
    }
  };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    claim(scene.walls[i].name, "walls", i);
  }
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    claim(scene.boxes[i].name, "boxes", i);
  }
}

void checkMasses(const JsonTree& tree, const Scene& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    const JsonNode* const density = elementOf(tree, "boxes", i).find("density");
    if (density != nullptr && !(box.mass >= kSmallestPositive && box.mass <= kLargestNumber)) {
      tree.fail(density->offset,
                describe(*density) + " for the density of box " + inQuotes(box.name) +
                    ", whose mass it makes " + brief(box.mass) + " kg",
                "a mass from 1e-60 to 1e60 kg");
    }
  }
}

std::string inertiaInWords(const Mat3& inertia) {
  std::string words = "with ";
  const auto add = [&](const Vec3& row) {
    words += brief(row.x()) + ", " + brief(row.y()) + ", " + brief(row.z());
  };
  if (inertia == Mat3(inertia.diagonal().asDiagonal())) {
    words += "moments ";
    add(inertia.diagonal());
  } else {
    words += "rows ";
    for (Eigen::Index row = 0; row < 3; ++row) {
      words += row == 0 ? "" : "; ";
      add(inertia.row(row));
    }
  }
  return words + " kg m²";
}

void checkInertias(const JsonTree& tree, const Scene& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    const JsonNode* const inertia = elementOf(tree, "boxes", i).find("inertia");
    if (inertia == nullptr) {
      continue;
    }
    const std::size_t place = inertia->offset;
    if (box.fixed) {
      tree.fail(place, "inertia for the fixed box " + inQuotes(box.name), "none, as it stays where it is");
    }
    const std::string found = "the inertia of box " + inQuotes(box.name);
    if (const std::string why = whyNoTensor(*box.inertia); !why.empty()) {
      tree.fail(place, found + " " + inertiaInWords(*box.inertia), why);
    }
  }
}

void checkCenters(const JsonTree& tree, const Scene& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    const JsonNode* const center = elementOf(tree, "boxes", i).find("center");
    if (center == nullptr) {
      continue;
    }
    if (box.fixed) {
      tree.fail(center->offset, "center for the fixed box " + inQuotes(box.name),
                "none, as it stays where it is");
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (!(std::fabs(box.center[axis]) < box.halfExtents[axis])) {
        const JsonNode& node = center->children[static_cast<std::size_t>(axis)];
        tree.fail(node.offset,
                  describe(node) + " for center[" + std::to_string(axis) + "] of box " + inQuotes(box.name) +
                      ", whose half extent is " + brief(box.halfExtents[axis]) + " m",
                  "a centre of mass inside the box");
      }
    }
  }
}

void checkFixed(const JsonTree& tree, const Scene& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    const std::array<std::pair<const char*, const Vec3*>, 2> speeds = {
        {{"velocity", &box.velocity}, {"angular_velocity", &box.angularVelocity}}};
    for (const auto& [key, speed] : speeds) {
      if (box.fixed && !speed->isZero(0)) {
        tree.fail(elementOf(tree, "boxes", i).find(key)->offset,
                  std::string(key) + " for the fixed box " + inQuotes(box.name),
                  "none, as it stays where it is");
      }
    }
  }
}

// Its moments ascend.
void checkPath(const JsonTree& tree, const JsonNode& motion, const std::string& where) {
  const JsonNode* const path = motion.find("path");
  for (std::size_t k = 1; path != nullptr && k < path->children.size(); ++k) {
    const JsonNode& time = path->children[k].children[0];
    if (!(time.number > path->children[k - 1].children[0].number)) {
      tree.fail(time.offset, describe(time) + " for " + where + "[" + std::to_string(k) + "][0]",
                "a time after that of the point before");
    }
  }
}

// By itself moves only what nothing else does, and what a run can follow.
void checkMotion(const JsonTree& tree, const JsonNode& node, const JsonNode& motion, const std::string& path,
                 const std::string& name, const Driven& driven, double duration) {
  constexpr double kMostTurns = 1e12;  // [rad] of phases in a run: beyond, doubles do not tell them
  checkPath(tree, motion, path);
  for (const char* const key : {"surface_velocity", "surface_spin"}) {
    if (const JsonNode* const surface = node.find(key)) {
      tree.fail(surface->offset, std::string(key) + " for " + name + ", which has a motion", "one of them");
    }
  }
  const double turning = std::max(boundsOf(driven).angularSpeed, driven.rate);
  if (turning * duration > kMostTurns) {
    tree.fail(motion.offset,
              "a motion of " + name + " that turns or swings by " + brief(turning * duration) +
                  " rad in the run",
              "1e12 rad or less");
  }
}

void checkMotions(const JsonTree& tree, const Scene& scene) {
  const auto check = [&](const char* list, std::size_t i, const std::string& name, const Course& course) {
    const JsonNode& node = elementOf(tree, list, i);
    if (const JsonNode* const motion = node.find("motion")) {
      checkMotion(tree, node, *motion, std::string(list) + "[" + std::to_string(i) + "].motion.path", name,
                  course.front().motion, scene.settings.duration);
    }
  };
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    const JsonNode* const motion = elementOf(tree, "boxes", i).find("motion");
    if (motion != nullptr && !box.fixed) {
      tree.fail(motion->offset, "motion for box " + inQuotes(box.name) + ", which is not fixed",
                "it for fixed boxes only: others move as forces make them");
    }
    check("boxes", i, "box " + inQuotes(box.name), box.course);
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    check("walls", i, "wall " + inQuotes(scene.walls[i].name), scene.walls[i].course);
  }
}

// Joints and springs are of what is still or moved by forces.
void checkUnmoved(const JsonTree& tree, const Scene& scene, const std::optional<int>& body,
                  const JsonNode& end, const char* what) {
  if (body && !scene.boxes[static_cast<std::size_t>(*body)].course.empty()) {
    tree.fail(end.offset,
              std::string(what) + " to box " + inQuotes(scene.boxes[static_cast<std::size_t>(*body)].name) +
                  ", which has a motion",
              "one to a box without, or to the world");
  }
}

// Along them, if they are walls; of boxes, only of those that are fixed: their faces leave out what is not.
void checkSurfaces(const JsonTree& tree, const Scene& scene) {
  constexpr double kAlong = 1e-6;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const JsonNode* const velocity = elementOf(tree, "walls", i).find("surface_velocity");
    const SurfaceMotion& surface = scene.walls[i].material.surface;
    if (velocity != nullptr &&
        std::fabs(dot(scene.walls[i].normal, surface.velocity)) > kAlong * surface.velocity.norm()) {
      tree.fail(velocity->offset, "a surface_velocity that leaves wall " + inQuotes(scene.walls[i].name),
                "one along the wall");
    }
  }
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    for (const char* const key : {"surface_velocity", "surface_spin"}) {
      const JsonNode* const found = elementOf(tree, "boxes", i).find(key);
      if (found != nullptr && !scene.boxes[i].fixed) {
        tree.fail(found->offset,
                  std::string(key) + " for box " + inQuotes(scene.boxes[i].name) + ", which is not fixed",
                  "it for fixed boxes and walls only");
      }
    }
  }
}

std::optional<int> bodyAt(const JsonTree& tree, const BoxNames& boxes, const JsonNode& end) {
  const JsonNode& first = end.children[0];
  if (first.kind != JsonNode::Kind::kString) {
    return std::nullopt;
  }
  return boxes.named(tree, first);
}

void connectSprings(const JsonTree& tree, const BoxNames& boxes, Scene& scene) {
  for (std::size_t i = 0; i < scene.springs.size(); ++i) {
    const JsonNode& node = elementOf(tree, "springs", i);
    Spring& spring = scene.springs[i];
    spring.from.body = bodyAt(tree, boxes, *node.find("from"));
    spring.to.body = bodyAt(tree, boxes, *node.find("to"));
    checkUnmoved(tree, scene, spring.from.body, *node.find("from"), "a spring");
    checkUnmoved(tree, scene, spring.to.body, *node.find("to"), "a spring");
    if (spring.from.body == spring.to.body) {
      tree.fail(node.find("to")->offset,
                spring.to.body ? "a spring from a box to itself" : "a spring from the world to the world",
                "two ends that can move apart");
    }
  }
}

void checkStart(const JsonTree& tree, const Scene& scene) {
  const std::vector<Wall> walls = wallsOf(scene);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    for (const Wall& wall : walls) {
      const LowestGap lowest = lowestGap(wall, placedBox(box));
      if (lowest.overlaps()) {
        tree.fail(
            memberOrSelf(elementOf(tree, "boxes", i), "position").offset,
            "box " + inQuotes(box.name) + " " + brief(-lowest.gap) + " m behind wall " + inQuotes(wall.name),
            "a start on the wall's free side");
      }
    }
  }
}

void checkOverlap(const JsonTree& tree, const Scene& scene) {
  const std::optional<Overlap> overlap = findOverlap(scene);
  if (overlap) {
    tree.fail(memberOrSelf(elementOf(tree, "boxes", overlap->second), "position").offset,
              "box " + inQuotes(scene.boxes[overlap->second].name) + " " + brief(overlap->depth) +
                  " m inside box " + inQuotes(scene.boxes[overlap->first].name),
              "a start outside every other box");
  }
}

}  // namespace

void checkScene(const JsonTree& tree, Scene& scene, Starts starts) {
  checkRoom(tree, scene);
  takeGravityAtStart(tree, scene);
  checkNames(tree, scene);
  checkMasses(tree, scene);
  checkInertias(tree, scene);
  checkCenters(tree, scene);
  takeMassesFromMeshes(tree, scene);
  takeDrawnMeshes(tree, scene);
  checkFixed(tree, scene);
  checkSurfaces(tree, scene);
  checkMotions(tree, scene);
  const BoxNames boxes(scene);
  connectSprings(tree, boxes, scene);
  connectJoints(tree, boxes, scene);
  connectMotors(tree, scene);
  checkShown(tree, boxes, scene);
  if (starts == Starts::kApart) {
    checkStart(tree, scene);
    checkOverlap(tree, scene);
  }
}

}  // namespace careen
