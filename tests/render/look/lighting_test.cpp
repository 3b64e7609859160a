#include "render/look/lighting.h"

#include <gtest/gtest.h>

#include "render/stage.h"
#include "view/materials.h"

namespace careen {
namespace {

// Values of IEC 61966-2-1: 188 is 0.5029, 55 is 0.0382, 10 lies on the straight piece, 10/255/12.92.
TEST(Lighting, turnsSrgbIntoLinearLight) {
  const Vec3 linear = linearFromSrgb({188, 55, 10});
  EXPECT_NEAR(linear.x(), 0.50289, 1e-5);
  EXPECT_NEAR(linear.y(), 0.03820, 1e-5);
  EXPECT_NEAR(linear.z(), 0.0030353, 1e-7);
  EXPECT_EQ(linearFromSrgb({0, 255, 0}), Vec3(0, 1, 0));
}

TEST(Lighting, everyValueComesBackFromLinearLight) {
  for (int value = 0; value < 256; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    EXPECT_EQ(srgbFromLinear(linearFromSrgb({byte, byte, byte}).x()), value);
  }
}

// From wherever one looks: the light comes from above, from the viewer's side, and from the left.
TEST(Lighting, shinesOverTheLeftShoulder) {
  for (const Vec3& eye : {Vec3(6, -8, 4), Vec3(-3, 5, 1), Vec3(0, -9, 0.5)}) {
    const Camera camera = cameraAt(eye, Vec3(0, 0, 1), 40);
    const Vec3 towards = lightingOf(Look::kStudio, camera).light->towards;
    const Vec3 back = camera.eye - camera.target;
    EXPECT_GT(towards.z(), 0);
    EXPECT_GT(towards.dot(Vec3(back.x(), back.y(), 0)), 0);
    EXPECT_LT(towards.dot(camera.up.cross(back)), 0);
  }
}

TEST(Lighting, isTheLooksButForWhatTheSceneSays) {
  const Camera camera = cameraAt(Vec3(6, -8, 4), Vec3(0, 0, 1), 40);
  Stage stage;
  stage.picture.look = Look::kClay;
  const Lighting look = lightingOf(Look::kClay, camera);
  EXPECT_EQ(lightingOf(stage, camera).light->towards, look.light->towards);
  EXPECT_EQ(lightingOf(stage, camera).light->spread, look.light->spread);
  EXPECT_EQ(lightingOf(stage, camera).sky, look.sky);
  stage.scenery = {.towardsLight = Vec3(0, 0.6, 0.8),
                   .lightDegrees = 90,
                   .lightColor = Color{255, 0, 188},
                   .ambient = ColorPair{{0, 255, 0}, {0, 0, 255}},
                   .background = ColorPair{{255, 255, 255}, {0, 0, 0}},
                   .gloss = {},
                   .marks = {},
                   .titles = {}};
  const Lighting asked = lightingOf(stage, camera);
  EXPECT_EQ(asked.light->towards, Vec3(0, 0.6, 0.8));
  EXPECT_NEAR(asked.light->spread, 1, 1e-15);  // the tangent of 45°
  EXPECT_NEAR(asked.light->color.z(), 0.50289, 1e-5);
  EXPECT_EQ(asked.sky, Vec3(0, 1, 0));
  EXPECT_EQ(asked.ground, Vec3(0, 0, 1));
  EXPECT_EQ(asked.backgroundTop, Vec3(1, 1, 1));
  EXPECT_EQ(asked.backgroundBottom, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace careen
