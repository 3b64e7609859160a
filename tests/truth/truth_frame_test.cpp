#include "truth/truth_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

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

// A hammer whose centre of mass is not its frame's origin, the head turned, and a box that hides some of it.
TEST(TruthFrame, labelsOfSeveralPartsAreInTheBodysFrame) {
  const Trajectory run = record(setupOf(parseScene(R"({ "careen": 1, "name": "hammer", "duration": 1,
  "boxes": [
    { "name": "hammer", "mass": 2, "position": [0, 0, 1], "velocity": [0.3, 0, 0], "angular_velocity": [1, 5, 0],
      "parts": [ { "half_extents": [0.6, 0.08, 0.08] },
                 { "half_extents": [0.15, 0.4, 0.2], "position": [0.6, 0, 0.1],
                   "orientation": { "axis": [1, 2, 3], "angle_deg": 50 } } ] },
    { "name": "b", "half_extents": [0.1, 0.1, 0.5], "mass": 1, "position": [1.5, -3.5, 2] } ],
  "camera": { "eye": [3, -7, 3], "target": [0, 0, 0.8], "orbit": { "deg_per_s": 30 } },
  "film": { "size": [160, 90], "fps": 25 } })",
                                                   "test")));
  const TruthFrames truth(run);
  const CameraPath path(run, truth.clock(), 160.0 / 90);
  const Body& hammer = run.world.bodies[0];
  std::array<std::size_t, 13> faces{};
  bool isHidden = false;
  for (int frame = 0; frame < 25; ++frame) {
    std::map<std::string, NumpyArray> arrays = arraysOf(truth.encode(frame, channelsNamed("all")));
    const double time = frame / 25.0;
    const double next = std::min((frame + 1) / 25.0, 1.0);
    const View now = viewOf(path.at(time), extentOf(run), 160.0 / 90);
    const View then = viewOf(path.at(next), extentOf(run), 160.0 / 90);
    const Pose pose = run.boxPoseAt(0, time);
    const Pose later = run.boxPoseAt(0, next);
    EXPECT_LT((Vec3(&arrays["position"].numbers[0]) - pose.position).norm(), 1e-15);
    std::size_t visible = 0;
    for (std::size_t place = 0; place < 160 * 90; ++place) {
      if (arrays["instance"].numbers[place] != 1) {
        continue;
      }
      ++visible;
      const Vec3 coordinates(&arrays["coordinates"].numbers[3 * place]);
      const Vec3 pixel = now.pixelFromWorld(pose.worldPoint(coordinates), 160, 90);
      const Vec3 moved = then.pixelFromWorld(later.worldPoint(coordinates), 160, 90);
      const double x = static_cast<double>(place % 160) + 0.5;
      ASSERT_NEAR(pixel.x(), x, 1e-3);
      ASSERT_NEAR(pixel.y(), static_cast<double>(place / 160) + 0.5, 1e-3);
      ASSERT_NEAR(arrays["flow"].numbers[2 * place], moved.x() - x, 2e-3);
      const auto face = static_cast<std::size_t>(arrays["face"].numbers[place]);
      ASSERT_TRUE(face >= 1 && face <= 12);
      ++faces.at(face);
      // On that face of that part, given by the text of the scene.
      const bool isHead = face > 6;
      const Mat3 turn =
          isHead ? Eigen::AngleAxisd(50 * M_PI / 180, Vec3(1, 2, 3).normalized()).toRotationMatrix()
                 : Mat3(Mat3::Identity());
      const Vec3 half = isHead ? Vec3(0.15, 0.4, 0.2) : Vec3(0.6, 0.08, 0.08);
      const Vec3 own = turn.transpose() * (coordinates - (isHead ? Vec3(0.6, 0, 0.1) : Vec3(0, 0, 0)));
      const auto axis = static_cast<Eigen::Index>((face - 1) % 6 / 2);
      const double sign = face % 2 == 1 ? -1 : 1;
      ASSERT_NEAR(own[axis], sign * half[axis], 1e-6);
      ASSERT_TRUE((own.cwiseAbs().array() <= half.array() + 1e-6).all());
      const Vec3 normal(&arrays["normal"].numbers[3 * place]);
      ASSERT_NEAR((normal - sign * pose.worldFromBody * turn.col(axis)).norm(), 0, 1e-6);
    }
    EXPECT_EQ(arrays["visible_pixels"].numbers[0], static_cast<double>(visible));
    EXPECT_GE(arrays["alone_pixels"].numbers[0], static_cast<double>(visible));
    isHidden = isHidden || arrays["alone_pixels"].numbers[0] > static_cast<double>(visible);
  }
  EXPECT_TRUE(isHidden);
  EXPECT_GT(std::count_if(faces.begin(), faces.end(), [](std::size_t count) { return count > 20; }), 7);
  EXPECT_FALSE(hammer.boxCenter.isZero(0.1));
}

TEST(TruthFrame, refusesMoreBoxesThanFacesHaveNumbers) {
  std::string parts;
  for (int i = 0; i < 43; ++i) {
    parts += (i == 0 ? "" : ", ") + std::string(R"({ "half_extents": [0.1, 0.1, 0.1], "position": [)") +
             std::to_string(i) + ", 0, 0] }";
  }
  const Trajectory run = record(setupOf(
      parseScene(R"({ "careen": 1, "duration": 0.1, "boxes": [ { "name": "long", "mass": 1, "parts": [)" +
                     parts + "] } ] }",
                 "test")));
  EXPECT_NE(inputErrorOf([&] { TruthFrames{run}; }).find("found box long of 43 boxes, expected at most 42"),
            std::string::npos);
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
