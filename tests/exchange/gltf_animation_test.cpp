#include "exchange/gltf_animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/glb.h"

namespace careen {
namespace {

// A box that flies and strikes the floor, a spring, and a film that runs at half speed after a freeze.
Trajectory flightOntoAFloor() {
  return record(setupOf(parseScene(R"({ "careen": 1, "name": "drop", "duration": 1, "gravity": [0, 0, -10],
    "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.8 } ],
    "boxes": [
      { "name": "falls", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [0, 0, 1], "restitution": 0.8 },
      { "name": "stands", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [3, 0, 1] } ],
    "film": { "time": [[0, 0.25], [1, 0.25], [2.5, 1]] } })",
                                   "test")));
}

struct Written {
  nlohmann::ordered_json node = nlohmann::ordered_json::object();
  nlohmann::ordered_json animations;
  std::size_t keys = 0;
  std::vector<float> times;
  std::vector<float> values;
};

// The first channel of what `move` animates, taken apart by other code than wrote it.
template <class Move>
Written written(const Trajectory& run, Move move) {
  GltfBuffer buffer;
  GltfAnimation animation(run, 1e-4, buffer);
  Written result;
  move(animation, result.node);
  result.animations = animation.json();
  result.keys = animation.keys();
  if (!result.animations.is_null()) {
    const Glb glb(buffer.pack({{"asset", {{"version", "2.0"}}}}));
    const auto& sampler = result.animations.at(0).at("samplers").at(0);
    result.times = glb.floats(sampler.at("input"));
    result.values = glb.floats(sampler.at("output"));
  }
  return result;
}

// z = 1 − 5 t² until 0.9 m are fallen, at sqrt(0.18) s; then up at 0.8 of the speed. Film time f shows
// 0.25 + (f − 1)/2.
TEST(GltfAnimation, movesABodyInTimeOfTheFilm) {
  const Trajectory run = flightOntoAFloor();
  const Written found = written(run, [](GltfAnimation& animation, nlohmann::ordered_json& node) {
    animation.moveWithBody(7, node, 0);
  });
  ASSERT_EQ(found.animations.at(0).at("channels").size(), 1U);  // it does not turn
  EXPECT_EQ(found.animations.at(0).at("channels").at(0).at("target").at("node"), 7);
  EXPECT_EQ(found.animations.at(0).at("channels").at(0).at("target").at("path"), "translation");
  EXPECT_EQ(found.keys, found.times.size());
  const double impact = std::sqrt(0.18);
  const double speed = 0.8 * 10 * impact;
  ASSERT_EQ(found.values.size(), 3 * found.times.size());
  bool atImpact = false;
  for (std::size_t i = 0; i < found.times.size(); ++i) {
    const double film = found.times[i];
    const double time = film < 1 ? 0.25 : 0.25 + (film - 1) / 2;
    const double after = time - impact;
    const double height = after < 0 ? 1 - 5 * time * time : 0.1 + speed * after - 5 * after * after;
    EXPECT_NEAR(found.values[3 * i + 2], height, 2e-6) << film;
    atImpact = atImpact || std::fabs(after) < 1e-6;
  }
  EXPECT_TRUE(atImpact);
  EXPECT_NEAR(found.node.at("translation").at(2).get<double>(), 1 - 5 * 0.0625, 1e-7);
  EXPECT_EQ(found.node.at("rotation"), nlohmann::ordered_json({0.0F, 0.0F, 0.0F, 1.0F}));
}

TEST(GltfAnimation, whatStandsStillHasAPlaceAndNoChannels) {
  const Trajectory run = flightOntoAFloor();
  const Written found = written(run, [](GltfAnimation& animation, nlohmann::ordered_json& node) {
    animation.moveWithBody(2, node, 1);
  });
  EXPECT_TRUE(found.animations.is_null());
  EXPECT_EQ(found.keys, 0U);
  EXPECT_EQ(found.node.at("translation"), nlohmann::ordered_json({3.0F, 0.0F, 1.0F}));
}

TEST(GltfAnimation, aSpringIsAStretchedLine) {
  const Trajectory run = flightOntoAFloor();
  const Spring spring{.from = {.body = std::nullopt, .point = Vec3(0, 0, 3)}, .to = {.body = 0}};
  const Written found = written(run, [&](GltfAnimation& animation, nlohmann::ordered_json& node) {
    animation.moveWithLine(4, node, spring.from, spring.to);
  });
  const auto& channels = found.animations.at(0).at("channels");
  ASSERT_EQ(channels.size(), 3U);
  EXPECT_EQ(channels.at(2).at("target").at("path"), "scale");
  EXPECT_NEAR(found.node.at("scale").at(2).get<double>(), 3 - (1 - 5 * 0.0625), 1e-6);
  EXPECT_EQ(found.node.at("translation"), nlohmann::ordered_json({0.0F, 0.0F, 3.0F}));
}

TEST(GltfAnimation, functionsOfFilmTimeMoveACamera) {
  const Trajectory run = flightOntoAFloor();
  const Written found = written(run, [](GltfAnimation& animation, nlohmann::ordered_json& node) {
    animation.moveBy(
        1, node, [](double time) { return Vec3(2 * time, 0, 1); }, [](double) { return Quat::Identity(); });
  });
  ASSERT_GE(found.times.size(), 2U);
  EXPECT_EQ(found.times.back(), 2.5F);
  EXPECT_EQ(found.values[found.values.size() - 3], 5.0F);
}

}  // namespace
}  // namespace careen
