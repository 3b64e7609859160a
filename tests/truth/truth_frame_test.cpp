#include "truth/truth_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/hash.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "trajectory/numpy_array.h"
#include "trajectory/zip_archive.h"
#include "view/camera.h"
#include "view/scene_extent.h"

namespace careen {
namespace {

const char* const kToss = R"({ "careen": 1, "name": "toss", "duration": 1, "gravity": [0, 0, -9.81],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 3], "open": ["-y", "+z"], "restitution": 0.9, "friction": 0.2 },
  "boxes": [
    { "name": "a", "half_extents": [0.4, 0.2, 0.1], "mass": 2, "position": [0, 0, 1], "velocity": [1, 0, 0],
      "angular_velocity": [1, 5, 0] },
    { "name": "b", "half_extents": [0.3, 0.3, 0.3], "mass": 1, "position": [1, 1, 0.5], "velocity": [-2, 0, 0] } ],
  "camera": { "eye": [3, -7, 3], "target": [0, 0, 0.8], "orbit": { "deg_per_s": 30 } },
  "film": { "size": [160, 90], "fps": 25 } })";

Trajectory toss() { return record(setupOf(parseScene(kToss, "test"))); }

std::map<std::string, NumpyArray> arraysOf(const std::string& archive) {
  std::map<std::string, NumpyArray> arrays;
  for (const auto& [name, bytes] : unzipped(archive, "test")) {
    arrays[name.substr(0, name.size() - 4)] = decodeNumpy(bytes, name);
  }
  return arrays;
}

TEST(TruthFrame, refusesBoxesThatAreDrawnAsMeshes) {
  Trajectory run = toss();
  run.stage.parts = {{.body = 1, .mesh = {}}};
  EXPECT_NE(inputErrorOf([&] { TruthFrames{run}; }).find("found box b drawn as a mesh"), std::string::npos);
}

TEST(TruthFrame, everyLabelFollowsFromTheRunByAnotherWay) {
  const Trajectory run = toss();
  const TruthFrames truth(run);
  const double aspect = 160.0 / 90;
  const CameraPath path(run, truth.clock(), aspect);
  ASSERT_GT(run.impacts.size(), 3U);
  std::size_t checked = 0;
  std::size_t acrossImpacts = 0;
  for (int frame = 0; frame < 25; ++frame) {
    std::map<std::string, NumpyArray> arrays = arraysOf(truth.encode(frame, channelsNamed("all")));
    const double time = frame / 25.0;
    const double next = std::min((frame + 1) / 25.0, 1.0);
    const View now = viewOf(path.at(time), extentOf(run), aspect);
    const View then = viewOf(path.at(next), extentOf(run), aspect);
    for (std::size_t place = 0; place < 160 * 90; place += 7) {
      const auto instance = static_cast<std::size_t>(arrays["instance"].numbers[place]);
      if (instance == 0) {
        EXPECT_EQ(arrays["depth"].numbers[place], 0);
        continue;
      }
      const auto vec = [&](const char* name) {
        const double* const n = &arrays[name].numbers[3 * place];
        return Vec3(n[0], n[1], n[2]);
      };
      const Vec3 coordinates = vec("coordinates");
      const bool isBox = instance <= 2;
      const Pose pose = isBox ? run.state(instance - 1, time).pose : Pose{};
      const Pose later = isBox ? run.state(instance - 1, next).pose : Pose{};
      const Vec3 point = pose.worldPoint(coordinates);
      const Vec3 pixel = now.pixelFromWorld(point, 160, 90);
      const double x = static_cast<double>(place % 160) + 0.5;
      const double y = static_cast<double>(place / 160) + 0.5;
      ASSERT_NEAR(pixel.x(), x, 1e-3);
      ASSERT_NEAR(pixel.y(), y, 1e-3);
      ASSERT_NEAR(arrays["distance"].numbers[place], (point - now.eye).norm(), 1e-5);
      ASSERT_NEAR(arrays["depth"].numbers[place], -now.worldFromCamera.col(2).dot(point - now.eye), 1e-5);
      const Vec3 moved = then.pixelFromWorld(later.worldPoint(coordinates), 160, 90);
      ASSERT_NEAR(arrays["flow"].numbers[2 * place], moved.x() - x, 2e-3);
      ASSERT_NEAR(arrays["flow"].numbers[2 * place + 1], moved.y() - y, 2e-3);
      const auto face = static_cast<int>(arrays["face"].numbers[place]);
      ASSERT_EQ(face == 0, !isBox);
      if (isBox) {
        const Vec3& half = run.world.bodies[instance - 1].halfExtents;
        const int axis = (face - 1) / 2;
        const double sign = face % 2 == 1 ? -1 : 1;
        ASSERT_NEAR(coordinates[axis], sign * half[axis], 1e-7);
        ASSERT_NEAR((vec("normal") - sign * pose.worldFromBody.col(axis)).norm(), 0, 1e-6);
        ASSERT_TRUE((coordinates.cwiseAbs().array() <= half.array() + 1e-6).all());
        for (const Impact& impact : run.impacts) {
          acrossImpacts += impact.time > time && impact.time < next ? 1 : 0;
        }
      }
      ++checked;
    }
    EXPECT_NEAR(arrays["visibility"].numbers[0],
                arrays["visible_pixels"].numbers[0] / arrays["alone_pixels"].numbers[0], 1e-15);
    EXPECT_EQ(arrays["position"].shape, (std::vector<std::size_t>{2, 3}));
    EXPECT_EQ(arrays["position"].numbers[2], run.state(0, time).pose.position.z());
    EXPECT_EQ(arrays["time"].numbers, std::vector<double>{time});
  }
  EXPECT_GT(checked, 15'000U);     // measured: 18,892
  EXPECT_GT(acrossImpacts, 300U);  // measured: 404 pixels whose box has an impact before the next frame
}

TEST(TruthFrame, hasOnlyWhatIsAskedFor) {
  const Trajectory run = toss();
  const std::map<std::string, NumpyArray> arrays =
      arraysOf(TruthFrames(run).encode(3, channelsNamed("face,depth")));
  EXPECT_TRUE(arrays.contains("face"));
  EXPECT_TRUE(arrays.contains("depth"));
  EXPECT_TRUE(arrays.contains("quaternion"));
  EXPECT_FALSE(arrays.contains("instance"));
  EXPECT_FALSE(arrays.contains("visibility"));
}

// The same everywhere: by g++ and clang++, at any optimisation. Remake it if the engine's motion changes.
TEST(TruthFrame, hasTheSameBitsEverywhere) {
  const Trajectory run = toss();
  Hash hash;
  for (const auto& [name, array] : arraysOf(TruthFrames(run).encode(2, channelsNamed("all")))) {
    for (const double number : array.numbers) {  // before the first impact
      hash.add(number);
    }
  }
  EXPECT_EQ(hash.text(), "ae63ff54321b14d6");
}

}  // namespace
}  // namespace careen
