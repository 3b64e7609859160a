#include "view/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene_reader.h"
#include "support/stages.h"

namespace careen {
namespace {

constexpr double kAspect = 16.0 / 9;

class CameraPathTest : public testing::Test {
 protected:
  CameraPathTest() { scene_.settings.duration = 8; }

  Camera at(double filmTime) const {
    return CameraPath(shownAs(scene_, run_), scene_.timeMap.within(scene_.settings.duration), kAspect)
        .at(filmTime);
  }

  Scene scene_ = crateInRoom();
  Trajectory run_ = drifting(crateInRoom(), Vec3(1, 0.5, 0.25));
};

TEST_F(CameraPathTest, isTheScenesOwnCameraIfThatDoesNotMove) {
  for (const double time : {0.0, 0.7, 8.0}) {
    EXPECT_EQ(at(time).eye, scene_.camera->eye);
    EXPECT_EQ(at(time).target, scene_.camera->target);
    EXPECT_EQ(at(time).fovDegrees, 38);
  }
}

TEST_F(CameraPathTest, orbitComesBackAfterAFullTurn) {
  scene_.camera = cameraAt(Vec3(1, -7, 3), Vec3(1, 0, 1), 38);
  scene_.cameraMove.orbitDegrees = 90;
  EXPECT_EQ(at(0).eye, Vec3(1, -7, 3));
  EXPECT_EQ(at(1).eye, Vec3(8, 0, 3));  // to the right
  EXPECT_EQ(at(2).eye, Vec3(1, 7, 3));
  EXPECT_EQ(at(4).eye, Vec3(1, -7, 3));
  EXPECT_EQ(at(8).eye, Vec3(1, -7, 3));
  for (int i = 0; i < 22; ++i) {
    const double time = 0.37 * i;
    EXPECT_EQ(at(time).target, Vec3(1, 0, 1));
    EXPECT_NEAR((at(time).eye - at(time).target).norm(), std::hypot(7, 2), 1e-14);
    EXPECT_NEAR(at(time).eye.z(), 3, 1e-15);
  }
  scene_.cameraMove.orbitDegrees = -90;
  EXPECT_EQ(at(1).eye, Vec3(-6, 0, 3));
}

// ---- Keys.

const std::vector<CameraKey> kKeys = {
    {.time = 1, .eye = Vec3(0, -8, 2), .target = Vec3(0, 0, 1), .fovDegrees = 40},
    {.time = 1.5, .eye = Vec3(3, -7, 2), .target = Vec3(0, 0, 1), .fovDegrees = 30},
    {.time = 3.5, .eye = Vec3(5, -2, 4), .target = Vec3(1, 0, 1), .fovDegrees = 5},
    {.time = 4, .eye = Vec3(4, 3, 5), .target = Vec3(2, 1, 1), .fovDegrees = 5},
    {.time = 7, .eye = Vec3(4, 3, 5), .target = Vec3(-2, 1, 1), .fovDegrees = 120}};

TEST_F(CameraPathTest, keysAreMetExactly) {
  scene_.cameraMove.keys = kKeys;
  for (const CameraKey& key : kKeys) {
    EXPECT_EQ(at(key.time).eye, key.eye);
    EXPECT_EQ(at(key.time).target, key.target);
    EXPECT_EQ(at(key.time).fovDegrees, key.fovDegrees);
  }
  EXPECT_EQ(at(0).eye, kKeys.front().eye);
  EXPECT_EQ(at(8).fovDegrees, kKeys.back().fovDegrees);
}

// What one second changes, by a difference over `step` [s].
double speed(double from, double to, double (*of)(const CameraKey&)) {
  return (of(between(kKeys, to)) - of(between(kKeys, from))) / (to - from);
}

TEST(CameraPath, speedDoesNotJumpAtKeys) {
  for (double (*of)(const CameraKey&) :
       {+[](const CameraKey& key) { return key.eye.x(); }, +[](const CameraKey& key) { return key.eye.y(); },
        +[](const CameraKey& key) { return key.target.x(); },
        +[](const CameraKey& key) { return key.fovDegrees; }}) {
    for (const CameraKey& key : kKeys) {
      EXPECT_NEAR(speed(key.time - 1e-6, key.time, of), speed(key.time, key.time + 1e-6, of), 1e-3)
          << key.time;
    }
    EXPECT_NEAR(speed(kKeys[0].time, kKeys[0].time + 1e-6, of), 0, 1e-3);  // from rest to rest
    EXPECT_NEAR(speed(kKeys[4].time - 1e-6, kKeys[4].time, of), 0, 1e-3);
  }
  // It does not rest at every key, as easing from each to the next would.
  EXPECT_GT(speed(1.5, 1.5 + 1e-6, [](const CameraKey& key) { return key.eye.x(); }), 1);
}

TEST(CameraPath, nothingOvershootsItsKeysAndWhatIsEqualStays) {
  for (std::size_t i = 0; i + 1 < kKeys.size(); ++i) {
    const CameraKey& a = kKeys[i];
    const CameraKey& b = kKeys[i + 1];
    for (int part = 0; part <= 64; ++part) {
      const CameraKey key = between(kKeys, a.time + part / 64.0 * (b.time - a.time));
      constexpr double kRounding = 1e-12;
      EXPECT_GE(key.fovDegrees, std::min(a.fovDegrees, b.fovDegrees) - kRounding);
      EXPECT_LE(key.fovDegrees, std::max(a.fovDegrees, b.fovDegrees) + kRounding);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(key.eye[axis], std::min(a.eye[axis], b.eye[axis]) - kRounding) << key.time;
        EXPECT_LE(key.eye[axis], std::max(a.eye[axis], b.eye[axis]) + kRounding) << key.time;
      }
    }
  }
  EXPECT_EQ(between(kKeys, 3.8).fovDegrees, 5);
  EXPECT_EQ(between(kKeys, 5).eye, Vec3(4, 3, 5));
}

// Half way between two keys at rest: half of it, at 3/2 of the mean speed.
TEST(CameraPath, twoKeysAreAnEaseFromRestToRest) {
  const std::vector<CameraKey> two = {{.time = 0, .eye = Vec3::Zero()}, {.time = 2, .eye = Vec3(4, 0, 0)}};
  EXPECT_EQ(between(two, 1).eye.x(), 2);
  EXPECT_NEAR((between(two, 1 + 1e-5).eye.x() - between(two, 1 - 1e-5).eye.x()) / 2e-5, 3, 1e-8);
  EXPECT_EQ(between(two, 0.5).eye.x(), 4 * (3.0 / 16 - 2.0 / 64));
}

TEST(CameraPath, goesStraightOrCutsWhereAsked) {
  EXPECT_EQ(between(kKeys, 1.5, Easing::kLinear).eye, kKeys[1].eye);
  EXPECT_LT((between(kKeys, 2, Easing::kLinear).eye - Vec3(3.5, -5.75, 2.5)).norm(),
            1e-15);  // a quarter of the way
  EXPECT_EQ(between(kKeys, 9, Easing::kLinear).eye, kKeys[4].eye);
  EXPECT_EQ(between(kKeys, 0.5, Easing::kCut).eye, kKeys[0].eye);
  EXPECT_EQ(between(kKeys, 3.499, Easing::kCut).eye, kKeys[1].eye);
  EXPECT_EQ(between(kKeys, 3.5, Easing::kCut).eye, kKeys[2].eye);
}

// ---- Following.

TEST_F(CameraPathTest, followsSteadyMotionExactly) {
  scene_.cameraMove.followed = 0;
  run_.settings.duration = scene_.settings.duration;
  for (const double time : {0.0, 0.05, 1.3, 4.0, 7.95, 8.0}) {
    const Vec3 moved = time * Vec3(1, 0.5, 0.25);
    EXPECT_LT((at(time).eye - scene_.camera->eye - moved).norm(), 1e-13) << time;
    EXPECT_LT((at(time).target - scene_.camera->target - moved).norm(), 1e-13) << time;
  }
  scene_.cameraMove.keys = kKeys;
  EXPECT_LT((at(4).eye - Vec3(4, 3, 5) - Vec3(4, 2, 1)).norm(), 1e-13);  // keys are taken along
}

// A box that falls from a metre and bounces without loss, 4.5 m/s down and up again every 0.9 s.
Scene bouncing() {
  Scene scene;
  scene.settings.duration = 6;
  scene.gravity = Vec3(0, 0, -10);
  scene.walls.push_back(wallAt(Vec3::UnitZ(), 0));
  scene.walls[0].material.restitution = 1;
  scene.boxes.push_back(boxAt(Vec3(0, 0, 1.2), Vec3(0.2, 0.2, 0.2)));
  scene.boxes[0].velocity = Vec3(0.5, 0, 0);
  scene.camera = cameraAt(Vec3(0, -5, 1.2), Vec3(0, 0, 1.2), 40);
  scene.cameraMove.followed = 0;
  return scene;
}

TEST(CameraPath, followingIsNotJerkedByImpactsAndKeepsTheBoxInThePicture) {
  const Scene scene = bouncing();
  const Trajectory run = runOf(scene);
  ASSERT_GT(run.impacts.size(), 5U);
  const TimeMap clock = scene.timeMap.within(scene.settings.duration);
  const CameraPath path(run, clock, kAspect);
  const auto boxAtTime = [&](double time) { return run.state(0, time).pose.position; };
  constexpr double kStep = 1.0 / 512;
  double hardest = 0;     // [m/s²] of the eye
  double boxHardest = 0;  // of the box, by the same differences
  double farthest = 0;    // from the middle of the picture: 1 is its edge
  for (int i = 1; i < 6 * 512 - 1; ++i) {
    const double time = kStep * i;
    const auto bend = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      return (a - 2 * b + c).norm() / (kStep * kStep);
    };
    hardest =
        std::max(hardest, bend(path.at(time - kStep).eye, path.at(time).eye, path.at(time + kStep).eye));
    boxHardest =
        std::max(boxHardest, bend(boxAtTime(time - kStep), boxAtTime(time), boxAtTime(time + kStep)));
    const View view = viewOf(path.at(time), extentOf(setupOf(scene)), kAspect);
    farthest = std::max(farthest, std::abs(view.pixelFromWorld(boxAtTime(time), 2, 2).y() - 1));
  }
  EXPECT_GT(boxHardest, 4000);
  EXPECT_LT(hardest, 40);    // 9 m/s spread over 0.4 s
  EXPECT_LT(farthest, 0.3);  // half the picture is 1.8 m there
}

TEST(CameraPath, followingInSlowMotionIsSmoothInTheFilmsTime) {
  Scene scene = bouncing();
  scene.timeMap.keys = {{0, 0}, {0.4, 0.4}, {4.4, 0.6}, {4.8, 1}};
  const Trajectory run = runOf(scene);
  const CameraPath path(run, scene.timeMap.within(scene.settings.duration), kAspect);
  // At 1/20 speed a throw is h² g / 6 / 400 off, 0.17 mm, but near the impact, at 1.3 s.
  const Vec3 moved = path.at(2.5).eye - scene.camera->eye;
  const Vec3 box = run.state(0, scene.timeMap.sceneTime(2.5)).pose.position - Vec3(0, 0, 1.2);
  EXPECT_LT((moved - box).norm(), 2e-4);
}

// ---- Framing.

// How far the farthest corner of any box gets out, in halves of the picture, over the whole run.
double farthestOut(const Scene& scene, const Trajectory& run, const Camera& camera, double aspect) {
  const View view = viewOf(camera, extentOf(setupOf(scene)), aspect);
  double out = 0;
  for (int moment = 0; moment <= 997; ++moment) {
    const std::vector<Pose> poses = run.poses(run.settings.duration * moment / 997);
    for (std::size_t box = 0; box < poses.size(); ++box) {
      for (int index = 0; index < kCorners; ++index) {
        const Vec3 pixel =
            view.pixelFromWorld(poses[box].worldPoint(corner(scene.boxes[box].halfExtents, index)), 2, 2);
        out = std::max({out, std::abs(pixel.x() - 1), std::abs(pixel.y() - 1)});
        EXPECT_LT(std::abs(pixel.z()), 1);  // neither too near nor too far to be drawn
      }
    }
  }
  return out;
}

TEST(CameraPath, cameraThatNobodyPlacedSeesAllBoxesAllTheTimeAndNotMuchMore) {
  const std::filesystem::path scenes = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes";
  for (const char* name :
       {"careen", "zeno", "galperin-pi", "dzhanibekov", "elastic-room", "hecker-1997", "hard/kilometre",
        "hard/millimetre", "hard/far-away", "hard/free-fall", "hard/needle", "hard/room-million"}) {
    Scene scene = readScene(scenes / (std::string(name) + ".json"));
    scene.camera.reset();
    scene.cameraMove = {};
    scene.timeMap = {};
    scene.settings.duration = std::min(scene.settings.duration, 20.0);
    const Trajectory run = runOf(scene);
    for (const double aspect : {kAspect, 0.6}) {
      const CameraPath path(run, scene.timeMap.within(scene.settings.duration), aspect);
      const double out = farthestOut(scene, run, path.at(0), aspect);
      EXPECT_LT(out, 0.97) << name << ' ' << aspect;
      EXPECT_GT(out, 0.85) << name << ' ' << aspect;
      EXPECT_EQ(path.at(0).eye, path.at(scene.settings.duration).eye) << name;
    }
  }
}

TEST(CameraPath, framesWhatTheFilmShowsOfTheRun) {
  Scene scene = bouncing();
  scene.camera.reset();
  scene.cameraMove = {};
  scene.boxes[0].velocity = Vec3(3, 0, 0);
  const Trajectory run = runOf(scene);
  const Camera whole = cameraThatFrames(run, scene.timeMap.within(6), kAspect);  // 18 m
  scene.timeMap.keys = {{0, 0}, {4, 2}};
  const Camera third = cameraThatFrames(run, scene.timeMap.within(6), kAspect);  // 6 m
  EXPECT_NEAR(whole.target.x(), 9, 2.5);
  EXPECT_NEAR(third.target.x(), 3, 1);
  EXPECT_LT((third.eye - third.target).norm(), 0.5 * (whole.eye - whole.target).norm());
}

}  // namespace
}  // namespace careen
