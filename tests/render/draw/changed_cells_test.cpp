#include "render/draw/changed_cells.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "render/draw/renderer.h"
#include "render/stage.h"
#include "scene/scene_reader.h"

namespace careen {
namespace {

View viewFrom(const Vec3& eye) {
  const Camera camera{.eye = eye, .target = Vec3::Zero(), .up = Vec3::UnitZ(), .fovDegrees = 90};
  return viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 16.0 / 9);
}

TEST(ChangedCells, areComparedOnceTwoPicturesHaveTheirBlockInCommon) {
  const View view = viewFrom(Vec3(0, -10, 0));
  const PictureCells none(view);
  FrameBlock block;
  block.sky = {1, 1, 1, 1};
  ChangedCells changed;
  const auto picture = [&](const View& seen, bool mayBeCompared, std::uint64_t piece) {
    changed.begin(seen, block, 1280, 720, mayBeCompared);
    if (changed.inputs() != nullptr) {
      changed.inputs()->add(std::vector<Vec3>{Vec3(0.3, 0, 0.3), Vec3(0.4, 0, 0.3), Vec3(0.4, 0, 0.4)}, 0,
                            piece);
    }
    changed.find(none, none);
    changed.beginDrawing();
    changed.endDrawing();
    return changed.cells().count();
  };
  EXPECT_EQ(picture(view, true, 1), PictureCells::kCount);
  EXPECT_EQ(picture(view, true, 1), PictureCells::kCount);  // nobody knows what the first was drawn from
  EXPECT_EQ(picture(view, true, 1), 0U);
  EXPECT_EQ(picture(view, true, 2), 1U);
  EXPECT_EQ(picture(view, false, 2), PictureCells::kCount);
  EXPECT_EQ(picture(view, true, 2), PictureCells::kCount);
  EXPECT_EQ(picture(view, true, 2), 0U);
  EXPECT_EQ(picture(viewFrom(Vec3(0, -10.5, 0)), true, 2), PictureCells::kCount);
  EXPECT_EQ(picture(view, true, 2), PictureCells::kCount);
  EXPECT_EQ(picture(view, true, 2), PictureCells::kCount);
  block.sky = {1, 1, 1, 0.5F};
  EXPECT_EQ(picture(view, true, 2), PictureCells::kCount);
}

TEST(ChangedCells, whereSurfacesNeedSomethingElseTheyAreDrawn) {
  const View view = viewFrom(Vec3(0, -10, 0));
  const PictureCells none(view);
  PictureCells marked(view);
  const std::vector<Vec3> outline = {Vec3(0.3, 0, 0.3), Vec3(0.4, 0, 0.3), Vec3(0.4, 0, 0.4)};
  marked.mark(outline);
  ChangedCells changed;
  for (int i = 0; i < 3; ++i) {
    changed.begin(view, {}, 1280, 720, true);
    changed.find(none, none);
    changed.endDrawing();
  }
  EXPECT_EQ(changed.cells().count(), 0U);
  changed.begin(view, {}, 1280, 720, true);
  changed.find(none, marked);
  EXPECT_EQ(changed.cells().count(), 1U);
  EXPECT_TRUE(changed.cells()[PictureCells::indexOf(20, 12)]);
}

// Every so many boxes, from the one with this index on, a little elsewhere and turned.
std::vector<Pose> moved(std::vector<Pose> poses, std::size_t from, std::size_t every, double by) {
  for (std::size_t i = from; i < poses.size(); i += every) {
    poses[i].position += by * Vec3(0.3, -0.2, 0.5);
    poses[i].worldFromBody =
        Eigen::AngleAxisd(by, Vec3(1, 2, 2) / 3).toRotationMatrix() * poses[i].worldFromBody;
  }
  return poses;
}

// Poses at the start and others near it: nothing moves, one box does, then some, and they move back.
std::vector<std::vector<Pose>> movements(const Scene& scene) {
  const std::vector<Pose> start = posesOf(scene);
  return {start,
          start,
          start,
          moved(start, 0, start.size(), 0.02),
          moved(start, 0, start.size(), 0.5),
          moved(moved(start, 0, start.size(), 0.5), 1, 3, 0.1),
          moved(start, 0, start.size(), 0.5),
          start};
}

// How many of these pictures differ from those that are drawn anew: after each a picture from elsewhere.
int differences(const Scene& scene, int width, int height) {
  const RunSetup setup = setupOf(scene, width, height);
  const std::vector<std::vector<Pose>> all = movements(scene);
  const Camera camera = cameraOf(setup, setup.stage.picture.aspect());
  Camera elsewhere = camera;
  elsewhere.eye += 0.01 * (camera.eye - camera.target);
  Renderer renderer(setup);
  std::vector<Picture> pictures;
  for (const std::vector<Pose>& poses : all) {
    pictures.push_back(renderer.draw({.poses = poses, .camera = camera}));
  }
  int different = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    renderer.draw({.poses = all[i], .camera = elsewhere});
    different += renderer.draw({.poses = all[i], .camera = camera}).rgb == pictures[i].rgb ? 0 : 1;
  }
  return different;
}

TEST(ChangedCells, picturesHaveTheSameBytesWhetherCellsAreKeptOrNot) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAREEN_SOURCE_DIR "/assets/scenes")) {
    if (entry.path().extension() != ".json") {
      continue;
    }
    Scene scene = readScene(entry.path());
    ++scenes;
    for (const Look look : {Look::kStudio, Look::kBlueprint, Look::kClay}) {
      scene.picture.look = look;
      const bool isLarge = entry.path().stem() == "careen" && look == Look::kStudio;
      EXPECT_EQ(differences(scene, isLarge ? 640 : 160, isLarge ? 360 : 90), 0)
          << entry.path() << ", " << nameOf(look);
    }
  }
  EXPECT_GT(scenes, 20);
}

TEST(ChangedCells, keptPicturesAreThoseOfANewRenderer) {
  Scene scene = readScene(CAREEN_SOURCE_DIR "/assets/scenes/wall.json");
  for (const Antialiasing antialiasing :
       {Antialiasing::kOff, Antialiasing::kEdges, Antialiasing::kSupersampled}) {
    scene.picture.antialiasing = antialiasing;
    const RunSetup setup = setupOf(scene, 160, 90);
    Renderer renderer(setup);
    for (const std::vector<Pose>& poses : movements(scene)) {
      EXPECT_EQ(renderer.draw(poses).rgb, Renderer(setup).draw(poses).rgb) << nameOf(antialiasing);
    }
  }
}

}  // namespace
}  // namespace careen
