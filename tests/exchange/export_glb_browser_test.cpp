// The file as three.js plays it, in Chromium, against the run.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/base64.h"
#include "exchange/export_glb.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "stage/time_map.h"
#include "support/browser.h"
#include "view/camera.h"
#include "view/camera_path.h"

namespace careen {
namespace {

constexpr const char* kThree = "/usr/share/javascript/three/";

// Loads the file by three.js' own loader and returns, for each time and name, the node's matrix in the world.
std::string pageOf(const std::string& glb) {
  return std::string("<!DOCTYPE html><script src='file://") + kThree +
         "three.js'></script><script src='file://" + kThree +
         "examples/js/loaders/GLTFLoader.js'></script><script>const bytes = Uint8Array.from(atob('" +
         base64(glb) + R"('), letter => letter.charCodeAt(0));
const loaded = new Promise((done, fail) => new THREE.GLTFLoader().parse(bytes.buffer, '', done, fail));
async function matrices(names, times) {
  const gltf = await loaded;
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const action = mixer.clipAction(gltf.animations[0]);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  const objects = names.map(name => gltf.parser.json.nodes.findIndex(node => node.name === name))
    .map(index => gltf.parser.getDependency('node', index));
  const nodes = await Promise.all(objects);
  return times.map(time => {
    action.reset();
    action.time = time;
    mixer.update(0);
    gltf.scene.updateMatrixWorld(true);
    return nodes.map(node => node.matrixWorld.elements.slice());
  });
}
</script>)";
}

// z up of the world, as three.js has it: y up.
Mat4 inThree(const Pose& pose, const Vec3& scale) {
  Mat4 up;
  up << 1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1;
  Mat4 worldFromUnit = Mat4::Identity();
  worldFromUnit.topLeftCorner<3, 3>() = pose.worldFromBody * scale.asDiagonal();
  worldFromUnit.topRightCorner<3, 1>() = pose.position;
  return up * worldFromUnit;
}

struct Off {
  double position = 0;  // [m]
  double attitude = 0;  // [rad]
  void add(const Mat4& found, const Mat4& exact) {
    position = std::max(position, (found - exact).topRightCorner<3, 1>().norm());
    Mat3 a = found.topLeftCorner<3, 3>();
    Mat3 b = exact.topLeftCorner<3, 3>();
    a.colwise().normalize();
    b.colwise().normalize();
    // A turn by θ has ‖A − B‖² = 8 sin²(θ/2) in Frobenius' norm.
    attitude = std::max(attitude, (a - b).norm() / std::sqrt(2.0));
  }
};

class ExportGlbInBrowser : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(std::filesystem::exists(kThree)) << "apt install libjs-three"; }

  // The largest error of boxes and camera at a thousand moments, half of them close to impacts.
  Off measure(const Trajectory& run, const GlbFile& file) {
    folder_.write("page.html", pageOf(file.bytes));
    Browser browser;
    browser.open(folder_ / "page.html");
    const TimeMap clock = run.stage.timeMap.within(run.settings.duration);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<double> times;
    for (int i = 0; i < 1000; ++i) {
      const double near =
          run.impacts.empty() ? 0 : run.impacts[static_cast<std::size_t>(i) % run.impacts.size()].time;
      const double time = i % 2 == 0 ? any(random) * clock.duration() : near + 0.01 * (any(random) - 0.5);
      times.push_back(std::clamp(time, 0.0, clock.duration() * (1 - 1e-6)));
    }
    nlohmann::json names;
    for (const Body& body : run.world.bodies) {
      names.push_back(body.name);
    }
    names.push_back("camera");
    const nlohmann::json found =
        browser.evaluate("matrices(" + names.dump() + ", " + nlohmann::json(times).dump() + ")");
    EXPECT_TRUE(browser.complaints().empty()) << browser.complaints().front();
    const CameraPath path(run, clock, run.stage.picture.aspect());
    Off off;
    for (std::size_t i = 0; i < times.size(); ++i) {
      for (std::size_t k = 0; k < names.size(); ++k) {
        const auto elements = found.at(i).at(k).get<std::vector<double>>();
        const Mat4 shown = Eigen::Map<const Mat4>(elements.data());
        if (k < run.world.bodies.size()) {
          const Pose pose = run.boxPoseAt(k, clock.sceneTime(times[i]));
          const Body& body = run.world.bodies[k];
          const Mat4 exact = inThree(pose, body.parts.empty() ? body.halfExtents : Vec3(Vec3::Ones()));
          off.add(shown, exact);
          EXPECT_LT(((shown - exact).topLeftCorner<3, 3>().norm()), 1e-3) << "size or handedness";
        } else {
          const Camera camera = path.at(times[i]);
          off.add(shown, inThree({.position = camera.eye,
                                  .worldFromBody = lookAt(camera.eye, camera.target, camera.up)},
                                 Vec3::Ones()));
        }
      }
    }
    return off;
  }

  TemporaryFolder folder_;
};

std::string sceneText(const std::string& name) {
  return textOf(std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes" / name);
}

TEST_F(ExportGlbInBrowser, poseOfEveryBoxIsWithinTheBoundAtAThousandMoments) {
  for (const char* name : {"careen.json", "hecker-1997.json", "housner.json"}) {
    const Trajectory run = record(setupOf(parseScene(sceneText(name), name)));
    const GlbFile file = encodeGlb(run);
    const Off off = measure(run, file);
    // measured: careen 0.97e-4 m, 0.97e-4 rad; the bound of 1e-4 includes single precision
    EXPECT_LE(off.position, 1e-4) << name;
    EXPECT_LE(off.attitude, 1e-4) << name;
    EXPECT_LE(off.position, 1.03 * file.positionError) << name;
    EXPECT_LE(off.attitude, 1.03 * file.attitudeError) << name;
    EXPECT_GT(off.position, 0.3e-4) << name << ": there are more keys than needed";
    std::cout << name << ": " << off.position << " m, " << off.attitude << " rad, " << file.keys << " keys, "
              << file.bytes.size() << " bytes\n";
  }
}

TEST_F(ExportGlbInBrowser, slowMotionAMovingCameraAndATighterBoundAreHeldToo) {
  const Trajectory run =
      record(setupOf(parseScene(R"({ "careen": 1, "duration": 1.5, "gravity": [0, 0, -9.81],
    "room": { "min": [-2, -2, 0], "max": [2, 2, 3], "open": ["-y", "+z"], "restitution": 0.9 },
    "boxes": [ { "name": "a box", "half_extents": [0.4, 0.2, 0.1], "mass": 1, "position": [0, 0, 2],
                 "angular_velocity": [1, 5, 0] } ],
    "camera": { "eye": [6, -8, 4], "target": [0, 0, 1], "orbit": { "deg_per_s": 20 }, "follow": "a box" },
    "film": { "time": [[0, 0], [0.5, 0.5], [1.5, 0.6], [2, 0.6], [3, 1.5]] } })",
                                "test")));
  const GlbFile file = encodeGlb(run, {.within = 1e-5});
  const Off off = measure(run, file);
  EXPECT_LE(off.position, 1e-5);
  EXPECT_LE(off.attitude, 1e-5);
}

TEST_F(ExportGlbInBrowser, bodiesOfSeveralBoxesFollowTheirFrame) {
  const Trajectory run =
      record(setupOf(parseScene(R"({ "careen": 1, "duration": 1.5, "gravity": [0, 0, -9.81],
    "room": { "min": [-2, -2, 0], "max": [2, 2, 3], "open": ["-y", "+z"], "restitution": 0.9 },
    "boxes": [ { "name": "hammer", "mass": 1, "position": [0, 0, 2], "angular_velocity": [1, 5, 0],
                 "parts": [ { "half_extents": [0.4, 0.05, 0.05] },
                            { "half_extents": [0.1, 0.2, 0.1], "position": [0.4, 0, 0] } ] } ] })",
                                "test")));
  const GlbFile file = encodeGlb(run);
  const Off off = measure(run, file);
  EXPECT_LE(off.position, 1e-4);
  EXPECT_LE(off.attitude, 1e-4);
  EXPECT_GT(off.position, 0.2e-4);
}

}  // namespace
}  // namespace careen
