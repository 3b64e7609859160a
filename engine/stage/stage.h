#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
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

/// Points x with normal·x = offset, visible from where normal·x is greater.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit
  double offset = 0;            ///< [m]
};

/// How a run is shown. Walls are drawn whether or not anything that moves can hit them.
struct Stage {
  std::string name = "untitled";  ///< the scene's
  std::optional<RoomShape> room;
  std::vector<Plane> planes;     ///< walls other than the room's
  std::vector<Color> colors;     ///< of the boxes, in their order
  std::vector<DrawnPart> parts;  ///< meshes drawn in place of boxes, by ascending body
  std::optional<Camera> camera;  ///< absent: a camera that sees the whole motion is chosen
  CameraMove cameraMove;         ///< empty if there is no camera
  TimeMap timeMap;
  PictureSettings picture;
  Scenery scenery;
  std::optional<Focus> focus;             ///< absent: all is sharp
  std::vector<SoundMaterial> boxSounds;   ///< of the boxes; empty: all are of wood
  std::vector<SoundMaterial> wallSounds;  ///< of the walls, those of the room first; empty: all are of stone
  std::string shownAs;  ///< hash of the scene whose camera and light these are; empty: the run's own
};

}  // namespace careen
