#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/course.h"
#include "stage/camera.h"
#include "stage/color.h"
#include "stage/picture_settings.h"
#include "stage/scenery.h"
#include "stage/sound_material.h"
#include "stage/time_map.h"
#include "stage/triangle_mesh.h"

namespace careen {

/// Faces of a room, in the order x−, x+, y−, y+, z−, z+.
inline constexpr std::array<const char*, 6> kRoomSides = {"-x", "+x", "-y", "+y", "-z", "+z"};

struct RoomShape {
  Vec3 min = Vec3::Zero();     ///< [m]
  Vec3 max = Vec3::Zero();     ///< [m]
  std::array<bool, 6> open{};  ///< no wall on this side; order of kRoomSides
};

/// Points x with normal·x = offset, visible from where normal·x is greater. One that moves by itself has a
/// frame, as a Wall has.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit
  double offset = 0;            ///< [m]
  Course course = {};

  /// Its frame at a moment [s]; of one that is still, the world's.
  Pose frameAt(double time) const { return course.empty() ? Pose{} : partAt(course, time).at(time).pose; }
  /// Where it is at a moment [s].
  Plane at(double time) const {
    if (course.empty()) {
      return *this;
    }
    const Pose frame = frameAt(time);
    const Vec3 now = frame.worldFromBody * normal;
    return {.normal = now, .offset = dot(now, frame.position)};
  }
};

/// What a scene says of how a run of it is shown, and what another scene may say in its place.
struct Showing {
  std::optional<Camera> camera;  ///< absent: a camera that sees the whole motion is chosen
  CameraMove cameraMove;         ///< empty if there is no camera
  std::optional<Focus> focus;    ///< absent: all is sharp
  TimeMap timeMap;
  PictureSettings picture;
  Scenery scenery;
};

/// How a run is shown. Walls are drawn whether or not anything that moves can hit them.
struct Stage : Showing {
  std::string name = "untitled";  ///< the scene's
  std::optional<RoomShape> room;
  std::vector<Plane> planes;              ///< walls other than the room's
  std::vector<Color> colors;              ///< of the boxes, in their order
  std::vector<DrawnPart> parts;           ///< meshes drawn in place of boxes, by ascending body
  std::vector<SoundMaterial> boxSounds;   ///< of the boxes; empty: all are of wood
  std::vector<SoundMaterial> wallSounds;  ///< of the walls, those of the room first; empty: all are of stone
  std::string shownAs;  ///< hash of the scene whose camera and light these are; empty: the run's own

  /// Whether a wall moves by itself.
  bool hasMovingPlanes() const {
    return std::any_of(planes.begin(), planes.end(),
                       [](const Plane& plane) { return !plane.course.empty(); });
  }
};

}  // namespace careen
