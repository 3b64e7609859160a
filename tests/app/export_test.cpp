// Runs as files of other programs, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/glb.h"
#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kTossScene = R"({
  "careen": 1, "name": "toss", "duration": 0.8, "gravity": [0, 0, -9.81],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.2, "restitution": 0.3 } ],
  "boxes": [ { "name": "die", "half_extents": [0.05, 0.05, 0.05], "mass": 0.3,
               "position": [0, 0, 0.3], "friction": 0.2, "restitution": 0.3, "velocity": [1, 0, 0.5],
               "angular_velocity": [1, 5, 3] } ] })";

class Export : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kTossScene);
    ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen", "--poses", "expected.csv"}).exitCode, 0);
  }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  std::string refusal(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "export");
    const std::vector<std::string> before = folder_.files();
    const Ended ended = careen(std::move(arguments));
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_EQ(folder_.files(), before);
    return ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(Export, writesTheFormatThatTheSuffixNames) {
  const Ended ended = careen({"export", "run.careen", "--out", "film.glb"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Glb glb(textOf(folder_ / "film.glb"));
  EXPECT_EQ(glb.json.at("asset").at("extras").at("within"), 1e-4);
  EXPECT_TRUE(glb.json.at("asset").at("generator").get<std::string>().starts_with("careen "));
  ASSERT_EQ(careen({"export", "run.careen", "--out", "poses.csv"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "poses.csv"), textOf(folder_ / "expected.csv"));
  ASSERT_EQ(careen({"export", "run.careen", "--out", "run.npz", "--every", "0.1"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "run.npz").substr(0, 2), "PK");
}

// What has come through a pipe cannot be read again.
TEST_F(Export, scenesAndRunsComeThroughPipes) {
  for (const char* const file : {"scene.json", "run.careen"}) {
    const std::string command =
        std::string("cat ") + file + " | '" + program() + "' export /dev/stdin --out piped.csv";
    const Ended ended = Process({"bash", "-c", command}, folder_.path()).wait();
    ASSERT_EQ(ended.exitCode, 0) << file << ": " << ended.err;
    EXPECT_EQ(textOf(folder_ / "piped.csv"), textOf(folder_ / "expected.csv")) << file;
    std::filesystem::remove(folder_ / "piped.csv");
  }
}

// The same rows from the run as while it is simulated; only tables and plots take them.
TEST_F(Export, writesForcesOfContact) {
  ASSERT_EQ(
      careen({"simulate", "scene.json", "-o", "again.careen", "--forces", "told.csv", "--every", "0.01"})
          .exitCode,
      0);
  ASSERT_EQ(careen({"export", "run.careen", "--out", "forces.csv", "--forces", "--every", "0.01"}).exitCode,
            0);
  EXPECT_EQ(textOf(folder_ / "forces.csv"), textOf(folder_ / "told.csv"));
  EXPECT_TRUE(
      textOf(folder_ / "forces.csv").starts_with("time,a,b,x,y,z,nx,ny,nz,fx,fy,fz,normal,friction,left\n"));
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "again.careen", "--forces", "told.npz"}).exitCode, 0);
  ASSERT_EQ(careen({"export", "run.careen", "--out", "forces.npz", "--forces"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "forces.npz"), textOf(folder_ / "told.npz"));
  EXPECT_EQ(textOf(folder_ / "forces.npz").substr(0, 2), "PK");
  ASSERT_EQ(careen({"export", "run.careen", "--out", "forces.svg", "--forces"}).exitCode, 0);
  EXPECT_NE(textOf(folder_ / "forces.svg").find("die on floor"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "forces.png"));
  EXPECT_NE(
      refusal({"run.careen", "--out", "film.glb", "--forces"}).find("--forces: found the file film.glb"),
      std::string::npos);
}

TEST_F(Export, tellsWhatMjcfCannotSay) {
  const Ended ended = careen({"export", "run.careen", "--out", "scene.xml"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("left out     restitution, up to 0.3"), std::string::npos) << ended.out;
  EXPECT_NE(textOf(folder_ / "scene.xml").find("<body name=\"die\""), std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.xml", "--every", "1"}).find("--every"), std::string::npos);
}

const std::string kModel = R"(<mujoco model="model">
  <option timestep="0.01"/>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <body name="die" pos="0 0 0.3"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body>
  </worldbody>
</mujoco>
)";

TEST_F(Export, takesModelsOfMujocoWhereverScenesAre) {
  folder_.write("model.xml", kModel);
  const Ended ended = careen({"export", "model.xml", "--out", "model.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("written      model.json"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("careen: model.xml: MJCF has no restitution: 0\n"), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("careen: model.xml: ignored: option timestep\n"), std::string::npos) << ended.err;
  const auto hashOf = [this](const std::string& file) {
    const Ended run = careen({"simulate", file, "-o", "of.careen", "--duration", "1", "--verbose"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    const std::size_t at = run.out.find("state hash");
    EXPECT_NE(at, std::string::npos) << run.out;
    return run.out.substr(at, 29);
  };
  EXPECT_EQ(hashOf("model.xml"), hashOf("model.json"));
  EXPECT_NE(careen({"info", "model.xml"}).out.find("scene        model, 1 box, 10 s by exact"),
            std::string::npos);
  EXPECT_EQ(careen({"export", "model.xml", "--out", "model.glb"}).exitCode, 0);
  // A table of poses has its scene in it as well.
  EXPECT_EQ(careen({"export", "expected.csv", "--scene", "model.xml", "--out", "b.glb"}).exitCode, 0);
}

TEST_F(Export, refusesModelsThatAreNoScenes) {
  const auto refused = [this](const std::string& text, const std::string& message) {
    folder_.write("model.xml", text);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"export", "model.xml", "--out", "m.json"},
          {"simulate", "model.xml", "-o", "m.careen"},
          {"info", "model.xml"}}) {
      const std::vector<std::string> before = folder_.files();
      const Ended ended = careen(command);
      EXPECT_EQ(ended.exitCode, 2) << ended.out;
      EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
      EXPECT_EQ(folder_.files(), before);
    }
  };
  std::string ball = kModel;
  ball.replace(ball.find("box"), 3, "sphere");
  refused(ball, "model.xml:5:54: found a <geom> of type \"sphere\", expected type=\"box\" or type=\"plane\"");
  refused(kModel.substr(0, 200), "model.xml:5:");
  refused("", "model.xml:1:1: found no document element found");
  refused(std::string("PK\3\4\0\0", 6), "model.xml:1:5: found a zero byte, expected XML text");
  refused("time,box,x\n", "model.xml:");
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) {
    deep += "<body>";
  }
  refused("<mujoco><worldbody>" + deep, "expected well-formed XML");
  refused(std::string(100'000'000, '<'), "found 100000000 bytes of XML, expected at most 67108864");
  // Of a scene from another place the message says so.
  std::string low = kModel;
  low.replace(low.find("0 0 0.3"), 7, "0 0 -1.");
  folder_.write("model.xml", low);
  const Ended ended = careen({"simulate", "model.xml", "-o", "m.careen"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("model.xml (its scene):"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("behind wall \"floor\""), std::string::npos) << ended.err;
  EXPECT_NE(refusal({"run.careen", "--out", "m.json"}).find("run.careen, expected a model of MuJoCo, .xml"),
            std::string::npos);
  EXPECT_NE(refusal({"model.xml", "--out", "m.json", "--every", "1"}).find("--every"), std::string::npos);
  EXPECT_NE(refusal({"model.xml", "--out", "m.json", "--within", "1"}).find("--within"), std::string::npos);
  EXPECT_NE(refusal({"model.xml", "--out", "model.xml"}).find("--out"), std::string::npos);
}

TEST_F(Export, takesScenesAndTablesToo) {
  EXPECT_EQ(careen({"export", "scene.json", "--out", "a.glb"}).exitCode, 0);
  EXPECT_EQ(careen({"export", "expected.csv", "--scene", "scene.json", "--out", "b.glb"}).exitCode, 0);
  ASSERT_EQ(careen({"export", "run.careen", "--out", "c.glb"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "a.glb"), textOf(folder_ / "c.glb"));
  EXPECT_NE(refusal({"expected.csv", "--out", "b2.glb"}).find("expected --scene"), std::string::npos);
}

// In the film a tenth of a second takes a whole one, and what follows is not shown.
TEST_F(Export, showsTheWholeRunInTheScenesTimeWhereAsked) {
  folder_.write("slow.json", std::string(R"({ "careen": 1, "duration": 0.6, "gravity": [0, 0, -9.81],
    "boxes": [ { "half_extents": [0.2, 0.1, 0.1], "mass": 1, "position": [0, 0, 2] } ],
    "film": { "time": [[0, 0], [1, 0.1]] } })"));
  ASSERT_EQ(careen({"simulate", "slow.json", "-o", "slow.careen"}).exitCode, 0);
  const auto lastKey = [this](std::vector<std::string> with) {
    with.insert(with.begin(), {"export", "slow.careen", "--out", "slow.glb"});
    EXPECT_EQ(careen(with).exitCode, 0);
    const Glb glb(textOf(folder_ / "slow.glb"));
    const nlohmann::json& channel = glb.json.at("animations").at(0).at("samplers").at(0);
    return glb.floats(channel.at("input").get<std::size_t>()).back();
  };
  EXPECT_FLOAT_EQ(lastKey({}), 1);
  EXPECT_FLOAT_EQ(lastKey({"--real-time"}), 0.6F);
  EXPECT_NE(
      refusal({"run.careen", "--out", "f.csv", "--real-time"}).find("--real-time: found the file f.csv"),
      std::string::npos);
}

TEST_F(Export, refusesWhatItCannotDo) {
  EXPECT_NE(
      refusal({"run.careen", "--out", "film.usd"}).find("'film.usd', expected a file that ends in .glb"),
      std::string::npos);
  EXPECT_NE(
      refusal({"run.careen", "--out", "f.glb", "--within", "0"}).find("--within: found 0, expected 1e-07"),
      std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.glb", "--within", "nan"}).find("--within: found nan"),
            std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.glb", "--every", "1"})
                .find("--every: found the file f.glb, which has no rows"),
            std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.csv", "--within", "1"}).find("--within: found the file f.csv"),
            std::string::npos);
  EXPECT_NE(refusal({"missing.careen", "--out", "f.glb"}).find("missing.careen"), std::string::npos);
  EXPECT_NE(refusal({"scene.json", "--out", "scene.json"}).find("--out"), std::string::npos);
  EXPECT_EQ(textOf(folder_ / "scene.json"), kTossScene);
  folder_.write("cut.careen", textOf(folder_ / "run.careen").substr(0, 900));
  EXPECT_NE(refusal({"cut.careen", "--out", "f.glb"}).find("cut.careen"), std::string::npos);
}

TEST_F(Export, aFullDiskLeavesTheOldFileWhole) {
  folder_.write("film.glb", "old");
  // Nobody can write into a folder that is not there, nor into /dev/full.
  const Ended ended = careen({"export", "run.careen", "--out", "nowhere/film.glb"});
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  const std::string limited =
      "ulimit -f 8; exec " + program() + " export run.careen --out film.glb --within 1e-6";
  const Ended full = Process({"bash", "-c", limited}, folder_.path()).wait();
  EXPECT_NE(full.exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "film.glb"), "old");
  folder_.write("model.xml", kModel);
  folder_.write("scene.json", "old");
  const std::string none = "ulimit -f 0; exec " + program() + " export model.xml --out scene.json";
  EXPECT_NE(Process({"bash", "-c", none}, folder_.path()).wait().exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "scene.json"), "old");
  EXPECT_EQ(careen({"export", "model.xml", "--out", "nowhere/scene.json"}).exitCode, 3);
}

}  // namespace
}  // namespace careen
