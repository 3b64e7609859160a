#include "scene/scene_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <regex>
#include <string>

#include "core/math/rotation.h"
#include "core/system/file.h"
#include "physics/world/method.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

const std::filesystem::path kSource = CAREEN_SOURCE_DIR;

TEST(SceneReader, readsEveryKey) {
  const Scene scene = parseScene(kEveryKey, "f");
  EXPECT_EQ(scene.text, kEveryKey);
  EXPECT_EQ(scene.name, "every key");
  EXPECT_EQ(scene.settings.duration, 2.5);
  EXPECT_EQ(scene.gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(scene.room->min, Vec3(-3, -2, 0));
  EXPECT_EQ(scene.room->max, Vec3(3, 2, 4));
  EXPECT_EQ(scene.room->open, (std::array<bool, 6>{false, false, true, false, false, true}));
  EXPECT_EQ(scene.room->material.restitution, 0.5);
  EXPECT_EQ(scene.room->material.friction, 0.25);
  EXPECT_EQ(scene.drag->linear, 0.5);
  EXPECT_EQ(scene.drag->angular, 0.25);
  EXPECT_EQ(scene.settings.method, Method::kListing1);
  EXPECT_EQ(scene.settings.dt, 0.001);
  EXPECT_EQ(scene.settings.tolerance, 1e-9);
  EXPECT_EQ(scene.camera->eye, Vec3(6, -8, 4));
  EXPECT_EQ(scene.camera->target, Vec3(0, 0, 1));
  EXPECT_EQ(scene.camera->up, Vec3(0, 0, 1));  // made a unit vector
  EXPECT_EQ(scene.camera->fovDegrees, 35);
  EXPECT_EQ(scene.picture.width, 640);
  EXPECT_EQ(scene.picture.height, 360);
  EXPECT_EQ(scene.picture.rate.text(), "24000/1001");
  EXPECT_EQ(scene.picture.antialiasing, Antialiasing::kMultisampled);
  EXPECT_EQ(scene.picture.look, Look::kClay);
  EXPECT_EQ(scene.cameraMove.orbitDegrees, 20);
  EXPECT_EQ(scene.cameraMove.followed, 0U);
  ASSERT_EQ(scene.timeMap.keys.size(), 3U);
  EXPECT_EQ(scene.timeMap.keys[2].film, 3);
  EXPECT_EQ(scene.timeMap.keys[2].scene, 2.25);
  EXPECT_EQ(scene.picture.shutter.text(), "90:4");
  EXPECT_EQ(scene.picture.overlays.text(), "time,energy");
}

TEST(SceneReader, readsWalls) {
  const Scene scene = parseScene(kEveryKey, "f");
  ASSERT_EQ(scene.walls.size(), 2U);
  const Wall& ramp = scene.walls[0];
  EXPECT_EQ(ramp.name, "ramp");
  EXPECT_LT((ramp.normal - Vec3(1, 0, 2) / std::sqrt(5)).norm(), 2e-16);  // measured 0
  EXPECT_NEAR(ramp.offset, -1 / std::sqrt(5), 2e-16);                     // measured 6e-17
  EXPECT_EQ(ramp.material.restitution, 1);
  EXPECT_EQ(ramp.material.friction, 0.125);
  EXPECT_EQ(scene.walls[1].name, "wall-1");
  EXPECT_EQ(scene.walls[1].normal, Vec3(0, 0, -1));
  EXPECT_EQ(scene.walls[1].offset, -4);
  EXPECT_EQ(scene.walls[1].material.restitution, 0);
}

// A belt, a turntable about the wall's point, and a fixed box that is both, about its own axis.
TEST(SceneReader, readsHowSurfacesMove) {
  const Scene scene = parseScene(R"({ "careen": 1, "duration": 1,
    "walls": [ { "point": [1, 2, 0], "normal": [0, 0, 2], "surface_velocity": [3, 0, 0] },
               { "point": [1, 2, 9], "normal": [0, 0, -1], "surface_spin": 2 } ],
    "boxes": [ { "half_extents": [1, 1, 1], "position": [0, 5, 4], "fixed": true, "surface_velocity": [0, 0, 1],
                 "surface_spin": 0.5 } ] })",
                                 "f");
  EXPECT_EQ(scene.walls[0].material.surface.velocity, Vec3(3, 0, 0));
  EXPECT_EQ(scene.walls[0].material.surface.spin, Vec3::Zero());
  const SurfaceMotion& table = scene.walls[1].material.surface;
  EXPECT_EQ(table.spin, Vec3(0, 0, -2));
  EXPECT_EQ(table.along(Vec3::UnitZ(), Vec3(1, 2, 9)), Vec3::Zero());
  EXPECT_EQ(table.along(Vec3::UnitZ(), Vec3(2, 2, 9)), Vec3(0, -2, 0));
  const SurfaceMotion& box = scene.boxes[0].material.surface;
  EXPECT_EQ(box.velocity + box.spin.cross(Vec3(0, 5, 7)), Vec3(0, 0, 1));
  EXPECT_EQ(box.spin, Vec3(0, 0, 0.5));
}

TEST(SceneReader, readsBoxes) {
  const Scene scene = parseScene(kEveryKey, "f");
  ASSERT_EQ(scene.boxes.size(), 3U);
  const SceneBox& crate = scene.boxes[0];
  EXPECT_EQ(crate.name, "crate");
  EXPECT_EQ(crate.halfExtents, Vec3(0.5, 0.25, 0.125));
  EXPECT_EQ(crate.mass, 2);
  EXPECT_EQ(crate.pose.position, Vec3(1, 0.5, 2));
  EXPECT_EQ(crate.pose.worldFromBody * Vec3::UnitX(), Vec3::UnitY());  // 90° about z
  EXPECT_EQ(crate.velocity, Vec3(6, 1.5, 0));
  EXPECT_EQ(crate.angularVelocity, Vec3(3, 7, -2));
  EXPECT_EQ(crate.material.restitution, 0.75);
  EXPECT_EQ(crate.material.friction, 0.5);
  EXPECT_FALSE(crate.fixed);
  EXPECT_EQ(crate.color.red, 0xc8);
  EXPECT_EQ(crate.color.green, 0x55);
  EXPECT_EQ(crate.color.blue, 0x3d);
  EXPECT_EQ(scene.boxes[1].name, "box-1");
  EXPECT_EQ(scene.boxes[1].mass, 8);  // density 8 kg/m³, 1 m³
  EXPECT_EQ(*scene.boxes[1].inertia, Mat3(Vec3(1, 2, 2.25).asDiagonal()));
  EXPECT_EQ(scene.boxes[1].pose.worldFromBody, Mat3::Identity());  // of the quaternion 2
  EXPECT_TRUE(scene.boxes[2].fixed);
}

// 120° about (1, 1, 1) takes x to y, y to z and z to x; its quaternion is (1, 1, 1, 1)/2, or any multiple of
// it.
TEST(SceneReader, quaternionsAreNormalised) {
  for (const char* q :
       {"[1, 1, 1, 1]", "[0.5, 0.5, 0.5, 0.5]", "[-3, -3, -3, -3]", "[1e-200, 1e-200, 1e-200, 1e-200]"}) {
    const Scene scene = parseScene(everyKeyBut("[2, 0, 0, 0]", q), "f");
    const Mat3& rotation = scene.boxes[1].pose.worldFromBody;
    Mat3 expected;
    expected << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    EXPECT_LT((rotation - expected).norm(), 1e-15) << q;  // measured 0
  }
  const Scene axis =
      parseScene(everyKeyBut("[2, 0, 0, 0]", R"({"axis": [1e-200, 1e-200, 1e-200], "angle_deg": 120})"), "f");
  EXPECT_LT((axis.boxes[1].pose.worldFromBody * Vec3::UnitX() - Vec3::UnitY()).norm(),
            1e-15);  // measured 3e-16
}

TEST(SceneReader, boxesWithoutAColourTakeSixInTurnAndFixedOnesAreGrey) {
  std::string boxes;
  for (int i = 0; i < 8; ++i) {
    boxes += R"({ "half_extents": [1, 1, 1], "position": [)" + std::to_string(3 * i) + ", 0, 0], " +
             (i == 7 ? R"("fixed": true })" : R"("mass": 1 }, )");
  }
  const Scene scene = parseScene(R"({ "careen": 1, "duration": 1, "boxes": [ )" + boxes + " ] }", "f");
  const auto isLike = [&scene](std::size_t a, std::size_t b) {
    const Color& one = scene.boxes[a].color;
    const Color& other = scene.boxes[b].color;
    return one.red == other.red && one.green == other.green && one.blue == other.blue;
  };
  EXPECT_TRUE(isLike(0, 6));
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_FALSE(isLike(i, i + 1)) << i;
  }
  EXPECT_EQ(scene.boxes[7].color.red, 200);
  EXPECT_EQ(scene.boxes[7].color.green, 200);
}

TEST(SceneReader, readsSprings) {
  const Scene scene = parseScene(kEveryKey, "f");
  EXPECT_EQ(scene.springs[0].from.point, Vec3(0.5, 0.25, 0.125));
  EXPECT_EQ(scene.springs[0].to.point, Vec3(-1.5, 0, 3));
  EXPECT_EQ(scene.springs[0].stiffness, 0.75);
  EXPECT_EQ(scene.springs[0].damping, 0.5);
  EXPECT_EQ(scene.springs[0].restLength, 1);
  EXPECT_EQ(scene.springs[1].damping, 0);
  EXPECT_EQ(scene.springs[1].restLength, 0);
}

TEST(SceneReader, fillsInWhatASceneDoesNotSay) {
  const Scene scene =
      parseScene(R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1, 2, 3], "mass": 4}]})", "f");
  EXPECT_EQ(scene.name, "untitled");
  EXPECT_EQ(scene.gravity, Vec3::Zero());
  EXPECT_FALSE(scene.room || scene.drag || scene.camera || scene.cameraMove.followed);
  EXPECT_TRUE(scene.cameraMove.keys.empty() && scene.timeMap.keys.empty());
  EXPECT_EQ(scene.picture.shutter.degrees, 0);
  EXPECT_TRUE(scene.walls.empty() && scene.springs.empty());
  EXPECT_EQ(scene.settings.method, Method::kExact);
  EXPECT_EQ(scene.settings.dt, 1.0 / 240);
  EXPECT_EQ(scene.settings.tolerance, 1e-6);
  EXPECT_EQ(scene.picture.width, 1280);
  EXPECT_EQ(scene.picture.height, 720);
  EXPECT_EQ(scene.picture.rate.text(), "30");
  EXPECT_EQ(scene.picture.antialiasing, Antialiasing::kEdges);
  EXPECT_EQ(scene.picture.look, Look::kStudio);
  const SceneBox& box = scene.boxes.at(0);
  EXPECT_EQ(box.name, "box-0");
  EXPECT_EQ(box.pose.position, Vec3::Zero());
  EXPECT_EQ(box.pose.worldFromBody, Mat3::Identity());
  EXPECT_EQ(box.material.restitution, 0);
  EXPECT_EQ(box.material.friction, 0);
}

TEST(SceneReader, smallestSceneOfTheReadmeParses) {
  const std::string readme = readFile(kSource / "README.md");
  const std::string fence = "```jsonc fall.json\n";
  const std::size_t start = readme.find(fence);
  ASSERT_NE(start, std::string::npos);
  const std::size_t end = readme.find("```", start + fence.size());
  ASSERT_NE(end, std::string::npos);
  const Scene scene =
      parseScene(readme.substr(start + fence.size(), end - start - fence.size()), "README.md");
  EXPECT_EQ(scene.boxes.size(), 2U);
}

TEST(SceneReader, shippedScenesParse) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "assets" / "scenes")) {
    if (!entry.is_regular_file()) {
      continue;
    }
    const Scene scene = readScene(entry.path());
    EXPECT_EQ(scene.name, entry.path().stem()) << "scenes are called as their files are";
    EXPECT_TRUE(scene.camera || entry.path().parent_path().filename() == "hard") << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 2);
}

TEST(SceneReader, defaultSceneIsOneBoxInFourSeconds) {
  const Scene scene = readScene(kSource / "assets" / "scenes" / "careen.json");
  EXPECT_EQ(scene.boxes.size(), 1U);
  EXPECT_EQ(scene.picture.rate.frameCount(scene.settings.duration), 120);
}

TEST(SceneReader, sampleOf1997HasItsFigures) {
  const Scene scene = readScene(kSource / "assets" / "scenes" / "hecker-1997.json");
  EXPECT_EQ(scene.room->max - scene.room->min, Vec3(8, 8, 8));
  EXPECT_EQ(scene.room->max + scene.room->min, Vec3::Zero());
  EXPECT_EQ(scene.gravity.norm(), 10);
  EXPECT_EQ(scene.drag->linear, 0.04);
  EXPECT_EQ(scene.drag->angular, 0.01);
  ASSERT_EQ(scene.boxes.size(), 6U);
  for (const SceneBox& box : scene.boxes) {
    EXPECT_EQ(box.pose.position, Vec3::Zero());
    EXPECT_TRUE((box.halfExtents.array() >= 0.1).all() && (box.halfExtents.array() <= 0.3).all());
    EXPECT_EQ(box.mass, 0.4 * 8 * box.halfExtents.prod());
    EXPECT_EQ(box.material.restitution, 1);
    EXPECT_EQ(box.material.friction, 0);
  }
  // World – 0 – 1 – … – 5 – world, corner to corner.
  ASSERT_EQ(scene.springs.size(), 7U);
  for (int i = 0; i < 7; ++i) {
    const Spring& spring = scene.springs[static_cast<std::size_t>(i)];
    const bool atWorld = i == 0 || i == 6;
    EXPECT_EQ(spring.from.body, i == 0 ? std::nullopt : std::optional(i - 1));
    EXPECT_EQ(spring.to.body, i == 6 ? std::nullopt : std::optional(i));
    EXPECT_EQ(spring.stiffness, atWorld ? 0.7 : 0.6);
    EXPECT_EQ(spring.damping, 0.1);
    EXPECT_EQ(spring.restLength, 0);
    for (const SpringEnd& end : {spring.from, spring.to}) {
      if (end.body) {
        const Vec3& half = scene.boxes[static_cast<std::size_t>(*end.body)].halfExtents;
        EXPECT_EQ(end.point.cwiseAbs(), half) << i;
      } else {
        EXPECT_EQ(end.point.cwiseAbs(), Vec3(1.5, 0, 0));
      }
    }
  }
}

TEST(SceneReader, missingFileIsNamed) {
  EXPECT_EQ(inputErrorOf([] { readScene("no/such/scene.json"); }),
            "no/such/scene.json: cannot be read: No such file or directory");
}

// An InputError with a place in every message, or a scene; anything else ends the test.
bool parses(const std::string& text) {
  static const std::regex kMessage("f:[1-9][0-9]*:[1-9][0-9]*: found .+, expected .+");
  const std::string message = inputErrorOf([&text] { parseScene(text, "f"); });
  EXPECT_TRUE(message == "no error" || std::regex_match(message, kMessage)) << message;
  return message == "no error";
}

TEST(SceneReader, truncatedFilesAreToldAtEveryByte) {
  for (const std::string& text : {readFile(kSource / "assets" / "scenes" / "careen.json"), kEveryKey}) {
    const std::size_t lastBrace = text.rfind('}');
    for (std::size_t length = 0; length < text.size(); ++length) {
      EXPECT_EQ(parses(text.substr(0, length)), length > lastBrace) << length;
    }
  }
}

TEST(SceneReader, damagedFilesAreToldOrRead) {
  std::mt19937 random(1);
  const auto below = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::string bytes = "{}[],:\"\\/*0123456789.eE+-truefalsn \n\r\t\x01\x7f\x80\xc3\xff";
  int rejected = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text = kEveryKey;
    for (std::size_t damage = 1 + below(3); damage > 0; --damage) {
      const std::size_t at = below(text.size());
      const std::size_t kind = below(4);
      if (kind == 0) {
        text.erase(at, 1 + below(5));
      } else if (kind == 1) {
        text.insert(at, text.substr(below(text.size()), 1 + below(20)));
      } else {
        text[at] = kind == 2 ? bytes[below(bytes.size())] : static_cast<char>(below(256));
      }
    }
    rejected += parses(text) ? 0 : 1;
  }
  RecordProperty("rejected", rejected);
  EXPECT_GT(rejected, 15'000);  // measured 19596
}

}  // namespace
}  // namespace careen
