#include <gtest/gtest.h>

#include <vector>

#include "render/draw/renderer.h"
#include "render/stage.h"

namespace careen {
namespace {

constexpr int kWidthOfShot = 160;
constexpr int kHeightOfShot = 90;

Picture drawnShot(const Scene& scene, const RenderOptions& options = {}) {
  return Renderer(setupOf(scene, kWidthOfShot, kHeightOfShot), options).draw(posesOf(scene));
}

RenderOptions litFrom(const Camera& camera) {
  RenderOptions options;
  options.lighting = lightingOf(Look::kStudio, camera);
  return options;
}

TEST(RendererShot, sameShotGivesTheSameBytesWhateverWasSeenBefore) {
  const Scene scene = crateInRoom();
  const std::vector<Pose> poses = posesOf(scene);
  const Camera elsewhere = cameraAt(Vec3(2, -6, 2), Vec3(0.5, 0, 1), 50);
  Renderer renderer(setupOf(scene, kWidthOfShot, kHeightOfShot));
  const Picture first = renderer.draw(poses);
  const Picture other = renderer.draw({.poses = poses, .camera = elsewhere});
  EXPECT_NE(other.rgb, first.rgb);
  EXPECT_EQ(renderer.draw(poses).rgb, first.rgb);
  EXPECT_EQ(renderer.draw({.poses = poses, .camera = *scene.camera}).rgb, first.rgb);
  // Floor and walls move with the eye: a scene that has its camera there looks the same.
  Scene there = scene;
  there.camera = elsewhere;
  EXPECT_EQ(drawnShot(there, litFrom(*scene.camera)).rgb, other.rgb);
}

TEST(RendererShot, lightStaysWhereTheFirstCameraPutsIt) {
  Scene scene = crateInRoom();
  RenderOptions options;
  options.camera = cameraAt(Vec3(4, -6, 2), Vec3(0, 0, 1), 50);
  EXPECT_EQ(Renderer(setupOf(scene, kWidthOfShot, kHeightOfShot), options)
                .draw({.poses = posesOf(scene), .camera = *scene.camera})
                .rgb,
            drawnShot(scene, litFrom(*options.camera)).rgb);
  EXPECT_NE(drawnShot(scene).rgb, drawnShot(scene, litFrom(*options.camera)).rgb);
}

}  // namespace
}  // namespace careen
