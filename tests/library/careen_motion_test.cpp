// Fixed boxes that move by themselves, from code.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "library/careen.h"

namespace careen::v1 {
namespace {

constexpr double kPi = std::numbers::pi;

Box fixedBox(const Motion& motion) {
  return {.name = "moves", .halfExtents = {1, 1, 0.1}, .friction = 0.5, .fixed = true, .motion = motion};
}

// A plate does work by its impulses and its forces. Of 2 kg with μ = .4, met after .5 s at .5 m/s, until 4 s:
// 2 · .5 (.5 + .4 g 3.5) J, of 3 kg with e = .8 and μ = .3, which hops before it, 3 · .5 (.5 + .3 g 3.5) J.
TEST(LibraryMotion, aPusherWorks) {
  const v1::Run run =
      simulate(Scene::read(std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes/hard/pusher.json"));
  const auto workOn = [&](const std::string& box) {
    double impulse = 0;
    double last = 0;
    for (const Impact& impact : run.impacts()) {
      if ((impact.a == box && impact.b == "plate") || (impact.b == box && impact.a == "plate")) {
        impulse += impact.impulse;
        last = impact.time;
      }
    }
    // From then on the force is the same all the time.
    constexpr int kParts = 16;
    for (int k = 0; k < kParts; ++k) {
      for (const Force& push : run.forces(last + (k + 0.5) / kParts * (run.duration() - last))) {
        if (push.a == box || push.b == box) {
          const double along = (push.a == box ? 1 : -1) * push.force[0];
          impulse += push.a == "plate" || push.b == "plate" ? along * (run.duration() - last) / kParts : 0;
        }
      }
    }
    return 0.5 * impulse;
  };
  EXPECT_NEAR(workOn("box-0"), 2 * 0.5 * (0.5 + 0.4 * 9.81 * 3.5), 1e-6);
  // Measured 6.4e-5 J: what is left of the speed of its hops at the last one that is recorded.
  EXPECT_NEAR(workOn("box-4"), 3 * 0.5 * (0.5 + 0.3 * 9.81 * 3.5), 2e-4);
}

// All that a motion has, at a moment at which it is far from 0.
TEST(LibraryMotion, allOfItAddsUp) {
  Scene scene(2.0);
  scene.add(fixedBox({.path = {{0.5, {1, 2, 3}}, {1.5, {1, 2, 5}}},
                      .velocity = {0.25, 0, 0},
                      .angularVelocity = {0, 0, 1},
                      .about = Vector{1, 1, 3},
                      .amplitude = {0, 0, 0.5},
                      .angularAmplitude = {0, 0, 0.25},
                      .frequency = 0.25,
                      .phase = 0.1}));
  const v1::Run run = simulate(scene);
  const double swing = std::sin(0.5 * kPi + 0.1);
  const double angle = 1 + 0.25 * swing;
  const State state = run.state(0, 1);
  EXPECT_NEAR(state.position[0], 1 + 0.25 - std::sin(angle), 1e-14);
  EXPECT_NEAR(state.position[1], 1 + std::cos(angle), 1e-14);
  EXPECT_NEAR(state.position[2], 4 + 0.5 * swing, 1e-14);
  EXPECT_NEAR(state.orientation[3], std::sin(angle / 2), 1e-14);
  EXPECT_NEAR(state.velocity[2], 2 + 0.25 * kPi * std::cos(0.5 * kPi + 0.1), 1e-14);
  EXPECT_EQ(simulate(Scene::parse(scene.text())).hash(), run.hash());
}

// It turns about its middle unless it is told what else to turn about, the origin too.
TEST(LibraryMotion, turnsAboutItsMiddleOrAPoint) {
  Box door = fixedBox({.angularVelocity = {0, 0, kPi}});
  door.position = {1, 0, 0};
  EXPECT_EQ(simulate(Scene(1.0).add(door)).state(0, 1).position[0], 1);
  door.motion->about = Vector{0, 0, 0};
  EXPECT_NEAR(simulate(Scene(1.0).add(door)).state(0, 1).position[0], -1, 1e-14);
}

// A wall has the same: a floor that goes up by 1 m in 2 s, and what stands on it.
TEST(LibraryMotion, wallsMoveToo) {
  Scene scene(2.0);
  Wall floor;
  floor.motion = Motion{.path = {{0, {0, 0, 0}}, {2, {0, 0, 1}}}};
  scene.add(floor);
  scene.add(Box{.name = "load", .halfExtents = {0.1, 0.1, 0.1}, .mass = 1, .position = {0, 0, 0.1}});
  const v1::Run run = simulate(scene);
  EXPECT_NEAR(run.state(0, 1).position[2], 0.6, 1e-14);
  EXPECT_EQ(simulate(Scene::parse(scene.text())).hash(), run.hash());
  floor.motion = Motion{};
  EXPECT_THROW(static_cast<void>(simulate(Scene(1.0).add(floor))), SceneError);
}

// What a scene file may not say is refused alike.
TEST(LibraryMotion, isCheckedAsInFiles) {
  const auto messageOf = [](const Box& box) {
    try {
      static_cast<void>(simulate(Scene(1.0).add(box)));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(messageOf(fixedBox({})).find("no motion"), std::string::npos);
  EXPECT_NE(messageOf(fixedBox({.amplitude = {1, 0, 0}})).find("frequency"), std::string::npos);
  EXPECT_NE(messageOf(fixedBox({.phase = 1})).find("amplitude"), std::string::npos);
  Box elsewhere = fixedBox({.path = {{0, {1, 0, 0}}}});
  EXPECT_EQ(messageOf(elsewhere), "");
  elsewhere.position = {2, 0, 0};
  EXPECT_NE(messageOf(elsewhere).find("path"), std::string::npos);
  Box loose = fixedBox({.velocity = {1, 0, 0}});
  loose.fixed = false;
  EXPECT_NE(messageOf(loose), "");
}

}  // namespace
}  // namespace careen::v1
