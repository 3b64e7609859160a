// Boxes that are drawn as meshes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "render/draw/renderer.h"
#include "render/stage.h"
#include "support/article_equations.h"
#include "support/meshes.h"

namespace careen {
namespace {

constexpr int kWidthOfMesh = 320;
constexpr int kHeightOfMesh = 180;

Picture drawnMesh(const Scene& scene, const RenderOptions& options = {}) {
  return Renderer(setupOf(scene, kWidthOfMesh, kHeightOfMesh), options).draw(posesOf(scene));
}

// A crate in the shadow of another, in the look that has no marks: its mesh looks as it does.
TEST(RendererMesh, theMeshOfABoxLooksAsTheBox) {
  Scene scene = crateInRoom();
  scene.picture.look = Look::kClay;
  scene.boxes[0].pose.worldFromBody = axisAngle(Vec3(1, 2, 3).normalized(), 0.7);
  SceneBox other = scene.boxes[0];
  other.name = "other";
  other.pose.position += Vec3(0.2, 0.3, 1.1);
  scene.boxes.push_back(other);
  for (const Antialiasing antialiasing : {Antialiasing::kEdges, Antialiasing::kMultisampled}) {
    scene.picture.antialiasing = antialiasing;
    scene.boxes[0].drawn = {};
    const Picture box = drawnMesh(scene);
    scene.boxes[0].drawn = boxMesh(scene.boxes[0].halfExtents, Vec3::Zero());
    const Picture mesh = drawnMesh(scene);
    int far = 0;
    double sum = 0;
    for (std::size_t k = 0; k < box.rgb.size(); ++k) {
      const int apart = std::abs(int{box.rgb[k]} - int{mesh.rgb[k]});
      far += apart > 6 ? 1 : 0;
      sum += apart;
    }
    const auto count = static_cast<double>(box.rgb.size());
    EXPECT_LT(far, 0.002 * count) << nameOf(antialiasing);
    EXPECT_LT(sum, 0.05 * count) << nameOf(antialiasing);
  }
}

// Seen from the side, the lower half of a box covers half of the pixels that the box does, to a row of them.
TEST(RendererMesh, onlyTheMeshIsSeen) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(1, 0.5, 0.6)));
  scene.boxes[0].color = Color{255, 0, 0};
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 20);
  scene.boxes[0].drawn = boxMesh(Vec3(1, 0.5, 0.3), Vec3(0, 0, -0.3));
  const Picture picture = drawnMesh(scene, lit(evenLighting(Vec3::Ones())));
  // The nearest face lies 9.5 m from the eye.
  const double pixels = 0.5 * kHeightOfMesh / std::tan(10 * std::numbers::pi / 180) / 9.5;
  double covered = 0;
  for (int y = 0; y < kHeightOfMesh; ++y) {
    for (int x = 0; x < kWidthOfMesh; ++x) {
      const std::array<int, 3> color = pixelAt(picture, x, y);
      covered += color[1] == 0 ? 1 : 0;
      if (y < kHeightOfMesh / 2 - 2) {
        EXPECT_EQ(color[1], 255) << x << ' ' << y;  // nothing is there
      }
    }
  }
  EXPECT_NEAR(covered / (2 * 0.6 * pixels * pixels), 1, 0.06);
}

}  // namespace
}  // namespace careen
