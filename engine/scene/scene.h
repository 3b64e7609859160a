#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/body.h"
#include "physics/world/method.h"
#include "physics/world/world.h"
#include "stage/frame_rate.h"
#include "stage/overlay.h"
#include "stage/shutter.h"
#include "stage/time_map.h"

namespace careen {

/// sRGB, 8 bits a channel.
struct Color {
  std::uint8_t red = 200;
  std::uint8_t green = 200;
  std::uint8_t blue = 200;
};

/// Faces of a room, in the order x−, x+, y−, y+, z−, z+.
inline constexpr std::array<const char*, 6> kRoomSides = {"-x", "+x", "-y", "+y", "-z", "+z"};

struct Room {
  Vec3 min = Vec3::Zero();     ///< [m]
  Vec3 max = Vec3::Zero();     ///< [m]
  std::array<bool, 6> open{};  ///< no wall on that side; order of kRoomSides
  Material material;
};

struct SceneBox {
  std::string name;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  double mass = 0;                  ///< [kg] 0 if the box is fixed and the scene gives none
  Pose pose;
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s] world frame
  Material material;
  bool fixed = false;
  Color color;
};

struct Camera {
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  Vec3 up = Vec3::UnitZ();     ///< [1] unit, not along the line of sight
  double fovDegrees = 40;      ///< [deg] vertical
};

/// How a film looks; each is a small set of numbers of the renderer's.
enum class Look { kStudio, kBlueprint, kClay };
inline constexpr std::array<std::string_view, 3> kLooks = {"studio", "blueprint",
                                                           "clay"};  ///< their names, in order

/// How edges are kept smooth.
enum class Antialiasing {
  kOff,
  kEdges,         ///< every pixel that an edge crosses gets its share of both sides: nearly as cheap as off
  kMultisampled,  ///< four samples a pixel
  kSupersampled,  ///< drawn twice as large each way, for stills: patterns are smooth too
};
inline constexpr std::array<std::string_view, 4> kAntialiasings = {"off", "edges", "4x", "supersampled"};

/// Where the camera is at a moment of the film.
struct CameraKey {
  double time = 0;             ///< [s] of the film
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  double fovDegrees = 40;      ///< [deg] vertical
};

/// How the camera moves from where Scene::camera puts it. Keys and an orbit exclude each other.
struct CameraMove {
  double orbitDegrees = 0;  ///< [deg/s] of the film: the eye about target and up, by the right-hand rule
  std::optional<std::size_t> followed;  ///< box that eye and target go along with
  std::vector<CameraKey> keys;          ///< in order of time; the first is what Scene::camera says
};

/// [px] in width and height: what GL drivers draw into.
inline constexpr int kLargestFilm = 16384;

struct Film {
  int width = 1280;  ///< [px]
  int height = 720;  ///< [px]
  FrameRate rate;
  Antialiasing antialiasing = Antialiasing::kEdges;
  TimeMap time;
  Shutter shutter;
};

/// A scene file, read and checked. Angles are radians but for the camera's.
struct Scene {
  std::string text;  ///< the file, byte for byte
  std::string name = "untitled";
  double duration = 0;          ///< [s]
  Vec3 gravity = Vec3::Zero();  ///< [m/s²]
  std::optional<Room> room;
  std::vector<Wall> walls;  ///< those written out; the room's come from `room`
  std::vector<SceneBox> boxes;
  std::vector<Spring> springs;
  std::optional<Drag> drag;
  Method method = Method::kExact;
  double dt = 1.0 / 240;         ///< [s]
  double tolerance = 1e-6;       ///< of methods that choose their own steps
  bool startsApart = false;      ///< known that no two boxes that can meet overlap at the start
  std::optional<Camera> camera;  ///< absent: one that sees all that happens is chosen
  CameraMove cameraMove;         ///< none where there is no camera
  Film film;
  Look look = Look::kStudio;
  OverlaySet overlays;  ///< drawn over the film
};

/// "room-x" for side 0: what the room's walls are called.
std::string roomWallName(std::size_t side);

/// The room's walls, less its open sides, named room-x room+x … room+z, then those written out.
std::vector<Wall> wallsOf(const Scene& scene);

}  // namespace careen
