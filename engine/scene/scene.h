#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/body.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"
#include "stage/color.h"
#include "stage/sound_material.h"
#include "stage/stage.h"
#include "stage/triangle_mesh.h"

namespace careen {

struct Room : RoomShape {
  Material material;
  std::optional<SoundMaterial> sound;
};

struct SceneBox {
  std::string name;
  Vec3 halfExtents = Vec3::Zero();  ///< [m] of several boxes, of that around them about the frame's origin
  std::vector<BodyPart> parts;      ///< in the box's frame; none: it is one box
  double mass = 0;                  ///< [kg] 0 if the box is fixed and the scene gives none
  std::optional<Mat3> inertia;      ///< [kg m²] about the centre of mass, box's axes; absent: solid
  Vec3 center = Vec3::Zero();       ///< [m] centre of mass, from the box's middle along its axes
  std::string massFrom;             ///< file of the mesh that mass, centre and inertia are of; empty: none
  std::string drawFrom;             ///< file of the mesh that is drawn in place of the box; empty: none
  TriangleMesh drawn;               ///< that mesh, in the box's frame
  Pose pose;                        ///< of the box's middle
  Vec3 velocity = Vec3::Zero();     ///< [m/s] of the box's middle
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s] world frame
  Material material;
  bool fixed = false;
  Course course;  ///< of one that is fixed: how it moves by itself; `pose` is that at the start
  Color color;
  std::optional<SoundMaterial> sound;
};

/// A scene file, read and checked. Angles are in radians, except the camera's.
struct Scene : Showing {
  RunSettings settings;
  std::string text;  ///< the file, byte for byte
  std::string name = "untitled";
  Vec3 gravity = Vec3::Zero();                ///< [m/s²] at the start
  std::vector<GravityChange> gravityChanges;  ///< as in World
  GravityPath gravityPath = GravityPath::kSteps;
  std::optional<Room> room;
  std::vector<Wall> walls;                               ///< the explicit walls; the room's come from `room`
  std::vector<std::optional<SoundMaterial>> wallSounds;  ///< of the explicit walls
  std::vector<SceneBox> boxes;
  std::vector<Spring> springs;
  std::optional<Control> control;          ///< of joints, by their index here
  std::vector<Joint> joints;               ///< their ends in frames of boxes, with their origin in the middle
  std::vector<std::pair<int, int>> apart;  ///< boxes that pass through each other, as in World
  std::optional<Drag> drag;
};

/// Name of a wall of the room: "room-x" for side 0.
std::string roomWallName(std::size_t side);

/// The room's walls without its open sides, named room-x room+x … room+z, then the explicit walls.
std::vector<Wall> wallsOf(const Scene& scene);

}  // namespace careen
