#include "view/out_of_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "support/stages.h"

namespace careen {
namespace {

// Two boxes; the second one goes to the right at 1 m/s, and out of the picture after 2 m.
Scene twoBoxes() {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.settings.duration = 4;
  scene.boxes.push_back(boxAt(Vec3(0, 0, 1), Vec3(0.2, 0.2, 0.2)));
  scene.boxes.push_back(boxAt(Vec3(0, 0, 2), Vec3(0.2, 0.2, 0.2)));
  scene.boxes[0].name = "stays";
  scene.boxes[1].name = "leaves";
  scene.boxes[1].velocity = Vec3(1, 0, 0);
  scene.camera = cameraAt(Vec3(0, -6, 1), Vec3(0, 0, 1), 2 * std::atan(3.0 / 16) * 180 / std::numbers::pi);
  return scene;
}

TEST(OutOfView, tellsWhichBoxLeavesThePictureAndWhen) {
  const Scene scene = twoBoxes();  // half of the picture is 6 * 3 / 16 * 16 / 9 = 2 m wide
  const Trajectory run = runOf(scene);
  const OutOfView found = outOfView(run);
  EXPECT_EQ(found.boxes, 1U);
  EXPECT_EQ(found.first, 1U);
  EXPECT_NEAR(found.moment, 2, 0.01);
  EXPECT_EQ(outOfView(run, std::vector<double>{0, 1.9}).boxes, 0U);
  EXPECT_EQ(outOfView(run, std::vector<double>{3}).boxes, 1U);
  std::ostringstream out;
  print(out, found, run);
  EXPECT_EQ(out.str().substr(0, 53), "out of view  1 of 2 boxes at some moment: leaves at 2");
}

TEST(OutOfView, aCameraThatNobodyPlacedLeavesNothingOut) {
  Scene scene = twoBoxes();
  scene.camera.reset();
  const Trajectory run = runOf(scene);
  const OutOfView found = outOfView(run);
  EXPECT_EQ(found.boxes, 0U);
  std::ostringstream out;
  print(out, found, run);
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace careen
