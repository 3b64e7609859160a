#include "study/node_peers.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "core/system/process.h"
#include "core/system/scratch_folder.h"
#include "study/program_peer.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

// As if these programs alone were installed: sh scripts.
class ProgramsInPath {
 public:
  explicit ProgramsInPath(const std::vector<std::string>& names) : before_(std::getenv("PATH")) {
    for (const std::string& name : names) {
      const fs::path program = folder_ / name.c_str();
      writeFile(program, "#!/bin/sh\nexit 0\n");
      fs::permissions(program, fs::perms::owner_all);
    }
    setenv("PATH", folder_.path().c_str(), 1);
  }
  ~ProgramsInPath() { setenv("PATH", before_.c_str(), 1); }
  ProgramsInPath(const ProgramsInPath&) = delete;
  ProgramsInPath& operator=(const ProgramsInPath&) = delete;
  ProgramsInPath(ProgramsInPath&&) = delete;
  ProgramsInPath& operator=(ProgramsInPath&&) = delete;

 private:
  ScratchFolder folder_;
  std::string before_;
};

void install(const ScratchFolder& folder, const std::string& package, const std::string& version) {
  const fs::path path = folder.path() / "node_modules" / package;
  fs::create_directories(path);
  writeFile(path / "package.json", R"({"version": ")" + version + R"("})");
}

TEST(NodePeers, areLeftOutWithoutTheirPackages) {
  const ProgramsInPath node({"node"});
  const ScratchFolder folder;
  const NodePeers peers = nodePeersIn(folder.path());
  EXPECT_TRUE(peers.all.empty());
  EXPECT_EQ(peers.leftOut,
            "mujoco-3, jolt, rapier: left out, found no packages of theirs; 'npm install --prefix " +
                folder.path().string() + "' fetches them");
}

TEST(NodePeers, areThoseThatAreInstalledByDefaultAndAtTheirBest) {
  const ProgramsInPath node({"node"});
  const ScratchFolder folder;
  install(folder, "jolt-physics", "1.2.3");
  const NodePeers peers = nodePeersIn(folder.path());
  ASSERT_EQ(peers.all.size(), 2U);
  EXPECT_EQ(peers.all[0]->name(), "jolt");
  EXPECT_EQ(peers.all[1]->name(), "jolt-best");
  for (const auto& peer : peers.all) {
    EXPECT_NE(peer->settings().find("1.2.3 as WebAssembly"), std::string::npos) << peer->settings();
  }
  EXPECT_TRUE(peers.all[0]->settings().ends_with("default settings"));
  EXPECT_TRUE(peers.leftOut.starts_with("mujoco-3, rapier: left out")) << peers.leftOut;
}

TEST(NodePeers, areLeftOutWithoutNode) {
  const ProgramsInPath nothing({});
  const ScratchFolder folder;
  for (const char* const package : {"jolt-physics", "@mujoco/mujoco", "@dimforge/rapier3d-compat"}) {
    install(folder, package, "1.2.3");
  }
  const NodePeers peers = nodePeersIn(folder.path());
  EXPECT_TRUE(peers.all.empty());
  EXPECT_EQ(peers.leftOut, "mujoco-3, jolt, rapier: left out, cannot start node: No such file or directory");
}

/// The runner with an engine of ours: a box moves on straight, at its best at twice its speed, and its x is
/// the number of steps. It turns with the orientation that it began with, of length 2.
class Runner : public testing::Test {
 protected:
  void SetUp() override {
    try {
      runProgram({"node", "--version"});
    } catch (const MachineError&) {
      GTEST_SKIP() << "node is not installed";
    }
    const fs::path source = fs::path(CAREEN_SOURCE_DIR) / "tests/peers";
    for (const char* const file : {"runner.mjs", "vectors.mjs", "package.json"}) {
      fs::copy(source / file, folder_.path() / file);
    }
    writeFile(folder_ / "straight.mjs", R"(
      export const load = async () => (world, isBest) => {
        let steps = 0, time = 0;
        return {
          step(h) { ++steps; time += h; },
          state(index) {
            const box = world.boxes[index];
            const y = box.position[1] + (isBest ? 2 : 1) * time * box.velocity[1];
            return {position: [steps, y, time < 5 ? 0 : NaN], orientation: box.orientation.map((x) => 2 * x),
                    velocity: box.velocity, angularVelocity: box.angular_velocity};
          },
          end() {}};
      };)");
  }
  ProgramPeer straight(const char* settings) const {
    return {"straight", "", {"node", (folder_ / "runner.mjs").string(), "straight", settings}};
  }
  ScratchFolder folder_;
};

// From 0 to 1 s five steps of 0.2 s, to 1.25 s two. The box's middle is 1 m along its own x axis, which
// points along y: it moves at ω × r = 3 z × y = −3 x beside v, and the states, of the centre of mass, are
// those of the engine.
TEST_F(Runner, takesEqualStepsAndTellsTheStatesOfTheEngine) {
  World world;
  world.bodies = {makeBox({.position = Vec3(7, 7, 7), .name = "held"}), makeBox({.halfExtents = Vec3(2, 1, 1),
                                                                                 .position = Vec3(0, 3, 0),
                                                                                 .velocity = Vec3(0, 4, 0),
                                                                                 .name = "a \"b\", c"})};
  world.bodies[0].mass = immovable();
  Body& body = world.bodies[1];
  body.boxCenter = Vec3(1, 0, 0);
  body.initial.pose.worldFromBody = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix();
  body.initial.angularMomentum = angularMomentum(body.mass, body.initial.pose.worldFromBody, Vec3(0, 0, 3));
  for (const bool isBest : {false, true}) {
    const ProgramPeer peer = straight(isBest ? "best" : "default");
    const auto states = peer.run(world, 0.24, std::vector<double>{0, 1, 1.25}, {});
    ASSERT_EQ(states.size(), 3U);
    const std::vector<double> times = {0, 1, 1.25};
    const std::vector<double> steps = {0, 5, 7};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(states[k][0].pose.position, Vec3(7, 7, 7));
      const BodyState& state = states[k][1];
      EXPECT_LT((state.pose.position - Vec3(steps[k], 3 + (isBest ? 2 : 1) * 4 * times[k], 0)).norm(), 1e-14);
      EXPECT_LT((state.pose.worldFromBody - body.initial.pose.worldFromBody).norm(), 1e-14);
      EXPECT_LT((state.velocity - Vec3(0, 4, 0)).norm(), 1e-14);
      EXPECT_LT((angularVelocity(body.mass, state) - Vec3(0, 0, 3)).norm(), 1e-14);
    }
    EXPECT_GT(peer.secondsTaken(), 0);
    EXPECT_LT(peer.secondsTaken(), 1);  // without the start
  }
}

TEST_F(Runner, saysWhenABodyIsLost) {
  World world;
  world.bodies = {makeBox({.name = "comet"})};
  try {
    straight("default").run(world, 1, std::vector<double>{1, 6}, {});
    ADD_FAILURE() << "went on";
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "straight: the state of comet is not finite by t = 6 s");
  }
}

}  // namespace
}  // namespace careen
