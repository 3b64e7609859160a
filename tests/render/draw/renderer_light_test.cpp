// Light in pictures against rays: closed intervals of boxes and planes, which share nothing with the
// renderer.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "image/srgb.h"
#include "render/draw/renderer.h"
#include "render/stage.h"
#include "view/camera.h"

namespace careen {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 180;
constexpr int kRays = 1024;

struct Hit {
  int thing = -1;  // box, or kFloor
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};
constexpr int kFloor = 1000;

// Distance along a ray to where it enters a box, and through which side; negative where it does not.
double enters(const SceneBox& box, const Vec3& from, const Vec3& along, Vec3* normal) {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = box.pose.worldFromBody.col(k);
    const double at = axis.dot(from - box.pose.position);
    const double slope = axis.dot(along);
    const double sign = slope < 0 ? -1 : 1;
    const double into = (-sign * box.halfExtents[k] - at) / slope;
    if (into > first) {
      first = into;
      if (normal != nullptr) {
        *normal = -sign * axis;
      }
    }
    last = std::min(last, (sign * box.halfExtents[k] - at) / slope);
  }
  return first < last && last > 0 ? std::max(first, 0.0) : -1;
}

Hit seenAt(const Scene& scene, double x, double y) {
  const Camera& camera = *scene.camera;
  const Mat3 axes = lookAt(camera.eye, camera.target, camera.up);
  const double slope = std::tan(0.5 * camera.fovDegrees * std::numbers::pi / 180);
  const Vec3 along =
      axes * Vec3((2 * x / kWidth - 1) * slope * kWidth / kHeight, (1 - 2 * y / kHeight) * slope, -1);
  Hit hit;
  double nearest = std::numeric_limits<double>::infinity();
  if (along.z() < 0) {
    nearest = -camera.eye.z() / along.z();
    hit = {.thing = kFloor, .point = camera.eye + nearest * along};
  }
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    Vec3 normal;
    const double at = enters(scene.boxes[i], camera.eye, along, &normal);
    if (at > 0 && at < nearest) {
      nearest = at;
      hit = {.thing = static_cast<int>(i), .point = camera.eye + at * along, .normal = normal};
    }
  }
  return hit;
}

bool isFree(const Scene& scene, const Hit& hit, const Vec3& along) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    if (static_cast<int>(i) != hit.thing && enters(scene.boxes[i], hit.point, along, nullptr) >= 0) {
      return false;
    }
  }
  return true;
}

// Points of a disc of radius 1, evenly spread along a spiral.
Vec2 onDisc(int k) {
  const double radius = std::sqrt((k + 0.5) / kRays);
  return radius * Vec2(std::cos(2.399963229728653 * k), std::sin(2.399963229728653 * k));
}

// The part of rays about `middle` that are free: of a disc of this slope, or of the cosine-weighted half
// space.
double freePart(const Scene& scene, const Hit& hit, const Vec3& middle, std::optional<double> spread) {
  const Vec3 across = middle.unitOrthogonal();
  const Vec3 above = middle.cross(across);
  int free = 0;
  for (int k = 0; k < kRays; ++k) {
    const Vec2 at = onDisc(k);
    const double slope = spread ? *spread : 1;
    const double forward = spread ? 1 : std::sqrt(1 - at.squaredNorm());
    free += isFree(scene, hit, slope * (at.x() * across + at.y() * above) + forward * middle) ? 1 : 0;
  }
  return static_cast<double>(free) / kRays;
}

struct Errors {
  double planes = 0;
  double boxes = 0;
  double most = 0;
};

double lightAt(const Picture& picture, int x, int y) {
  return SrgbTables::get().linear(static_cast<std::uint8_t>(pixelAt(picture, x, y)[1])) / 65535.0;
}

// Root mean square over every third pixel of every third row that has no edge beside it.
template <class Expected>
Errors errorsOf(const Scene& scene, const Picture& with, const Picture& without, const Expected& expected) {
  Errors errors;
  int planes = 0;
  int boxes = 0;
  for (int y = 2; y + 2 < kHeight; y += 3) {
    for (int x = 2; x + 2 < kWidth; x += 3) {
      const Hit hit = seenAt(scene, x + 0.5, y + 0.5);
      bool isAlone = hit.thing >= 0;
      for (const auto& [dx, dy] : {std::pair{2, 0}, {-2, 0}, {0, 2}, {0, -2}}) {
        const Hit other = seenAt(scene, x + 0.5 + dx, y + 0.5 + dy);
        isAlone = isAlone && other.thing == hit.thing && other.normal.dot(hit.normal) > 0.999;
      }
      const double all = lightAt(without, x, y);
      if (!isAlone || all < 0.05 || (hit.thing == kFloor && hit.point.head<2>().norm() > 4)) {
        continue;
      }
      const std::optional<double> part = expected(hit);
      if (!part) {
        continue;
      }
      const double error = lightAt(with, x, y) / all - *part;
      (hit.thing == kFloor ? errors.planes : errors.boxes) += error * error;
      (hit.thing == kFloor ? planes : boxes) += 1;
      errors.most = std::max(errors.most, std::abs(error));
    }
  }
  EXPECT_GT(planes, 500);
  EXPECT_GT(boxes, 50);
  errors.planes = std::sqrt(errors.planes / std::max(planes, 1));
  errors.boxes = std::sqrt(errors.boxes / std::max(boxes, 1));
  return errors;
}

Scene onFloor() {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.room.emplace();
  scene.room->min = Vec3(-30, -30, 0);
  scene.room->max = Vec3(30, 30, 9);
  scene.room->open = {true, true, true, true, false, true};
  scene.camera = cameraAt(Vec3(3, -6, 4), Vec3(0, 0, 0.8), 40);
  scene.picture.antialiasing = Antialiasing::kOff;
  return scene;
}

void add(Scene& scene, const Vec3& position, const Vec3& half, double turn) {
  SceneBox box = boxAt(position, half, Color{255, 255, 255});
  box.name = "box-" + std::to_string(scene.boxes.size());
  box.pose.worldFromBody = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  scene.boxes.push_back(box);
}

// A cube that flies, a stack, a wall of bricks, a heap.
std::vector<std::pair<const char*, Scene>> scenes() {
  Scene flying = onFloor();
  add(flying, Vec3(0, 0, 1), Vec3(0.6, 0.4, 0.3), 0.4);
  flying.boxes[0].pose.worldFromBody = Quat(0.8, 0.2, 0.4, 0.4).normalized().toRotationMatrix();
  Scene stack = onFloor();
  for (int i = 0; i < 5; ++i) {
    add(stack, Vec3(0.03 * i, 0.05 * (i % 2), 0.3 + 0.6 * i), Vec3(0.3, 0.3, 0.3), 0.2 * i);
  }
  Scene wall = onFloor();
  for (int i = 0; i < 20; ++i) {
    add(wall, Vec3(0.82 * (i % 4) - 1.2 + 0.4 * (i / 4 % 2), 0, 0.2 + 0.4 * (i / 4)), Vec3(0.4, 0.2, 0.2),
        0.02 * (i % 3));
  }
  Scene heap = onFloor();
  for (int i = 0; i < 40; ++i) {
    add(heap, Vec3(1.3 * std::sin(2.4 * i), 1.3 * std::cos(1.7 * i), 0.3 + 0.045 * i), Vec3(0.25, 0.2, 0.15),
        0.7 * i);
    heap.boxes.back().pose.worldFromBody =
        Quat(1, std::sin(3.0 * i), std::sin(5.0 * i), std::sin(7.0 * i)).normalized().toRotationMatrix();
  }
  return {{"flying", flying}, {"stack", stack}, {"wall", wall}, {"heap", heap}};
}

RenderOptions plain(Lighting lighting) {
  RenderOptions options = lit(lighting);
  options.materials->marks = false;
  options.materials->joints = 0;
  options.materials->tileContrast = 0;
  options.materials->corners = 0;
  options.materials->bounce = 0;
  options.materials->boxRoughness = options.materials->tileRoughness = 1;
  options.materials->floor = Vec3::Ones();
  return options;
}

TEST(Light, shadowsAreThoseOfRays) {
  for (const auto& [name, scene] : scenes()) {
    Lighting lighting = evenLighting();
    lighting.sky = lighting.ground = Vec3::Zero();
    lighting.backgroundTop = lighting.backgroundBottom = Vec3::Constant(0.5);
    lighting.light = Light{.towards = Vec3(-0.5, -0.6, 1), .color = Vec3::Constant(0.8)};
    const RenderOptions options = plain(lighting);
    const Picture with = Renderer(setupOf(scene, kWidth, kHeight), options).draw(posesOf(scene));
    RenderOptions bare = options;
    bare.lighting->light->castsShadow = false;
    const Picture without = Renderer(setupOf(scene, kWidth, kHeight), bare).draw(posesOf(scene));
    const Vec3 towards = lighting.light->towards.normalized();
    const Errors errors =
        errorsOf(scene, with, without, [&, &scene = scene](const Hit& hit) -> std::optional<double> {
          return hit.normal.dot(towards) < 0.05
                     ? std::nullopt
                     : std::optional(freePart(scene, hit, towards, lighting.light->spread));
        });
    std::cout << name << ": light on planes " << errors.planes << ", on boxes " << errors.boxes << ", most "
              << errors.most << '\n';
    // Measured: 0.004, 0.013, 0.007, 0.020 on planes, 0.039 and 0.021 on boxes of stack and heap. What is
    // left is too dark: where the penumbras of two boxes overlap, both count.
    EXPECT_LT(errors.planes, 0.023) << name;
    EXPECT_LT(errors.boxes, 0.042) << name;
  }
}

TEST(Light, occlusionIsThatOfRays) {
  for (const auto& [name, scene] : scenes()) {
    Lighting lighting = evenLighting(Vec3::Constant(0.5));
    lighting.sky = lighting.ground = Vec3::Constant(0.8);
    RenderOptions options = plain(lighting);
    const Picture without = Renderer(setupOf(scene, kWidth, kHeight), options).draw(posesOf(scene));
    options.materials->occlusion = true;
    const Picture with = Renderer(setupOf(scene, kWidth, kHeight), options).draw(posesOf(scene));
    const Errors errors =
        errorsOf(scene, with, without, [&scene = scene](const Hit& hit) -> std::optional<double> {
          return freePart(scene, hit, hit.normal, std::nullopt);
        });
    std::cout << name << ": occlusion on planes " << errors.planes << ", on boxes " << errors.boxes
              << ", most " << errors.most << '\n';
    // Measured: 0.007, 0.023, 0.054, 0.046 on planes, 0.014, 0.026, 0.106 on boxes of the last three. What is
    // left is too bright: boxes that are left out because each covers little, at most eight on a face, and
    // products of what two boxes leave where they cover different parts of the view.
    EXPECT_LT(errors.planes, 0.06) << name;
    EXPECT_LT(errors.boxes, 0.115) << name;
  }
}

}  // namespace
}  // namespace careen
