#include "exchange/export_glb.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/glb.h"
#include "support/meshes.h"

namespace careen {
namespace {

// Every kind of thing that a film shows, and names that readers could take for each other.
const char* const kAll = R"({ "careen": 1, "name": "all", "duration": 1, "gravity": [0, 0, -9.81],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 3], "open": ["-y", "+z"], "restitution": 0.9 },
  "boxes": [
    { "name": "a.b", "half_extents": [0.4, 0.2, 0.1], "mass": 2, "position": [0, 0, 1], "color": "#ff0000",
      "velocity": [1, 0, 0], "angular_velocity": [1, 5, 0] },
    { "name": "ab", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [1.5, 1, 0.5], "color": "#ff0000" } ],
  "springs": [ { "from": ["a.b", [0.4, 0.2, 0.1]], "to": [0, 0, 3], "stiffness": 3 } ],
  "film": { "time": [[0, 0], [1, 0.5], [2, 0.5], [2.5, 1]] } })";

Trajectory runOf(const std::string& text) { return record(setupOf(parseScene(text, "test"))); }

TEST(ExportGlb, hasBoxesWallsSpringsAndACamera) {
  const GlbFile file = encodeGlb(runOf(kAll), {.program = "the test"});
  const Glb glb(file.bytes);
  const nlohmann::json& nodes = glb.json.at("nodes");
  ASSERT_EQ(nodes.size(), 1 + 2 + 4 + 1 + 1U);
  EXPECT_EQ(nodes.at(1).at("name"), "a.b");
  EXPECT_EQ(nodes.at(2).at("name"), "ab-2") << "three.js takes a.b for ab";
  EXPECT_EQ(nodes.at(2).at("extras").at("name"), "ab");
  EXPECT_EQ(nodes.at(1).at("mesh"), nodes.at(2).at("mesh")) << "of one colour";
  EXPECT_FLOAT_EQ(nodes.at(1).at("scale").at(1).get<float>(), 0.2F);
  EXPECT_EQ(nodes.at(7).at("name"), "spring 0");
  const nlohmann::json& line = glb.json.at("meshes").at(nodes.at(7).at("mesh").get<std::size_t>());
  EXPECT_EQ(line.at("primitives").at(0).at("mode"), 1);
  const nlohmann::json& camera = glb.json.at("cameras").at(0).at("perspective");
  EXPECT_NEAR(camera.at("yfov").get<double>(), 40 * M_PI / 180, 1e-12);
  EXPECT_NEAR(camera.at("aspectRatio").get<double>(), 16. / 9, 1e-12);
  EXPECT_GT(camera.at("znear").get<double>(), 0);
  EXPECT_NEAR(camera.at("zfar").get<double>() / camera.at("znear").get<double>(), 50 / 0.004,
              1e-6 * 50 / 0.004);
  const nlohmann::json& paint =
      glb.json.at("materials").at(0).at("pbrMetallicRoughness").at("baseColorFactor");
  EXPECT_EQ(paint, nlohmann::json({1, 0, 0, 1}));
  EXPECT_EQ(glb.json.at("asset").at("generator"), "the test");
  const nlohmann::json& extras = glb.json.at("asset").at("extras");
  EXPECT_EQ(extras.at("within"), 1e-4);
  EXPECT_EQ(extras.at("position_error_m"), file.positionError);
  EXPECT_GT(file.positionError, 0.7e-4);
  EXPECT_LE(file.positionError, 1e-4);
  EXPECT_LE(file.attitudeError, 1e-4);
}

// The middle of a loaded box that spins circles its centre of mass: 64 turns a second, so that it is where it
// was at each eighth of the film.
TEST(ExportGlb, followsTheMiddleOfALoadedBox) {
  const Trajectory run = runOf(R"({ "careen": 1, "duration": 1,
    "boxes": [ { "half_extents": [0.1, 0.1, 0.1], "mass": 1, "center": [0.05, 0, 0],
                 "angular_velocity": [0, 0, 402.12385965949352], "velocity": [0, -20.106192982974676, 0] } ] })");
  const GlbFile file = encodeGlb(run, {.within = 1e-3});
  EXPECT_GT(file.positionError, 0.5e-3);
  EXPECT_LE(file.positionError, 1e-3);
  EXPECT_GT(file.keys, 500U);
}

// Each triangle has corners of its own; the node is not scaled, as the mesh has its size.
TEST(ExportGlb, hasTheMeshThatIsDrawnInPlaceOfABox) {
  Trajectory run = runOf(kAll);
  const TriangleMesh mesh = boxMesh(Vec3(0.4, 0.2, 0.05), Vec3(0, 0, 0.05));
  run.stage.parts = {{.body = 0, .mesh = mesh}};
  const Glb glb(encodeGlb(run).bytes);
  const nlohmann::json& node = glb.json.at("nodes").at(1);
  EXPECT_EQ(node.at("scale"), nlohmann::json({1, 1, 1}));
  const nlohmann::json& primitives =
      glb.json.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives");
  ASSERT_EQ(primitives.size(), 1U);
  const nlohmann::json& attributes = primitives.at(0).at("attributes");
  const std::vector<float> positions = glb.floats(attributes.at("POSITION").get<std::size_t>());
  const std::vector<float> normals = glb.floats(attributes.at("NORMAL").get<std::size_t>());
  ASSERT_EQ(positions.size(), 12U * 9);
  for (std::size_t k = 0; k < positions.size(); k += 3) {
    // Outward: the corner lies that way from the middle.
    EXPECT_GT(normals[k] * positions[k] + normals[k + 1] * positions[k + 1] +
                  normals[k + 2] * (positions[k + 2] - 0.05F),
              0.04F);
  }
  EXPECT_NE(glb.json.at("nodes").at(2).at("mesh"), node.at("mesh"));
}

// One node at the frame's origin; its mesh has the twelve triangles of each part, where that is.
TEST(ExportGlb, bodyOfSeveralBoxesIsOneMesh) {
  const Trajectory run = runOf(R"({ "careen": 1, "duration": 1, "boxes": [
    { "name": "hammer", "mass": 2, "position": [1, 2, 3], "angular_velocity": [0, 3, 1],
      "parts": [ { "half_extents": [0.5, 0.1, 0.1] },
                 { "half_extents": [0.1, 0.3, 0.2], "position": [0.5, 0, 0.4], "orientation": { "axis": [0, 0, 1], "angle_deg": 90 } } ] },
    { "name": "b", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [9, 0, 0] } ] })");
  const GlbFile file = encodeGlb(run);
  EXPECT_LE(file.positionError, 1e-4);
  const Glb glb(file.bytes);
  const nlohmann::json& node = glb.json.at("nodes").at(1);
  EXPECT_EQ(node.at("name"), "hammer");
  EXPECT_EQ(node.at("scale"), nlohmann::json({1, 1, 1}));
  EXPECT_FLOAT_EQ(node.at("translation").at(2).get<float>(), 3);
  EXPECT_EQ(glb.json.at("nodes").at(2).at("name"), "b");
  const nlohmann::json& primitives =
      glb.json.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives");
  ASSERT_EQ(primitives.size(), 1U);
  const nlohmann::json& attributes = primitives.at(0).at("attributes");
  const std::vector<float> positions = glb.floats(attributes.at("POSITION").get<std::size_t>());
  const std::vector<float> normals = glb.floats(attributes.at("NORMAL").get<std::size_t>());
  ASSERT_EQ(positions.size(), 2U * 12 * 9);
  double volume = 0;  // by signed tetrahedra: of both, as if they did not overlap
  for (std::size_t k = 0; k < positions.size(); k += 9) {
    std::array<Vec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const float* const at = positions.data() + k + 3 * c;
      corners[c] = Vec3(at[0], at[1], at[2]);
      // By a turn of 90° the second reaches 0.3 along x and 0.1 along y.
      const bool isHead = k >= 12 * 9;
      const Vec3 half = isHead ? Vec3(0.3, 0.1, 0.2) : Vec3(0.5, 0.1, 0.1);
      const Vec3 own = corners[c] - (isHead ? Vec3(0.5, 0, 0.4) : Vec3(0, 0, 0));
      EXPECT_LT((own.cwiseAbs() - half).norm(), 1e-6);
      EXPECT_GT(own.dot(Vec3(normals[k], normals[k + 1], normals[k + 2])), 0.09);
    }
    volume += corners[0].dot(corners[1].cross(corners[2])) / 6;
  }
  EXPECT_NEAR(volume, 8 * (0.5 * 0.1 * 0.1 + 0.1 * 0.3 * 0.2), 1e-6);
}

// A bob on a rope of 2 m, at rest aside, and a rod that lets go.
TEST(ExportGlb, hasRodsAndRopesThatHoldToTheEnd) {
  const Glb glb(encodeGlb(runOf(R"({ "careen": 1, "duration": 1, "gravity": [0, 0, -9.81],
    "boxes": [ { "name": "bob", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [1.2, 0, 1.4] },
               { "name": "weight", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [3, 0, 1] } ],
    "joints": [ { "name": "string", "type": "rope", "between": ["world", "bob"], "points": [[0, 0, 3], [0, 0, 0]], "length": 2 },
                { "name": "hook", "type": "rod", "between": ["world", "weight"], "points": [[3, 0, 3], [0, 0, 0]],
                  "until": 0.5 } ] })"))
                    .bytes);
  const nlohmann::json& nodes = glb.json.at("nodes");
  std::vector<std::string> lines;
  for (const nlohmann::json& node : nodes) {
    const std::string name = node.at("name");
    if (name == "string" || name == "hook") {
      lines.push_back(name);
      EXPECT_NEAR(node.at("translation").at(0).get<double>(), 1.2, 1e-4) << "from the bob";
      EXPECT_NEAR(node.at("translation").at(2).get<double>(), 1.4, 1e-4);
      EXPECT_NEAR(node.at("scale").at(2).get<double>(), 2, 1e-4);
      const nlohmann::json& mesh = glb.json.at("meshes").at(node.at("mesh").get<std::size_t>());
      EXPECT_EQ(mesh.at("primitives").at(0).at("mode"), 1);
    }
  }
  EXPECT_EQ(lines, std::vector<std::string>{"string"});
}

TEST(ExportGlb, animatesOnlyWhatMovesInTimeOfTheFilm) {
  const Glb glb(encodeGlb(runOf(kAll)).bytes);
  const nlohmann::json& animation = glb.json.at("animations").at(0);
  ASSERT_EQ(animation.at("channels").size(), 2 + 3U);  // box: place, attitude; spring: and length
  for (const nlohmann::json& channel : animation.at("channels")) {
    EXPECT_NE(channel.at("target").at("node"), 2) << "the fixed box";
    const nlohmann::json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
    EXPECT_EQ(sampler.at("interpolation"), "LINEAR");
    const std::vector<float> times = glb.floats(sampler.at("input"));
    EXPECT_EQ(times.front(), 0);
    EXPECT_EQ(times.back(), 2.5F) << "the film is 2.5 s long, the run 1 s";
    for (std::size_t i = 1; i < times.size(); ++i) {
      ASSERT_LT(times[i - 1], times[i]);
      EXPECT_FALSE(times[i] > 1.00001F && times[i] < 1.99999F) << "a key while all stands still";
    }
  }
}

TEST(ExportGlb, refusesABoundThatSinglePrecisionCannotHold) {
  const Trajectory run = runOf(kAll);
  EXPECT_THROW(encodeGlb(run, {.within = 1e-8}), InputError);
  EXPECT_THROW(encodeGlb(run, {.within = std::nan("")}), InputError);
  EXPECT_GT(encodeGlb(run, {.within = 1e-6}).keys, 5 * encodeGlb(run, {.within = 1e-4}).keys);
}

}  // namespace
}  // namespace careen
