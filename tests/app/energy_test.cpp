// Tables of energies, and what is told of one impact.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

// 2 kg fall 0.8 m onto four corners at 4 m/s and part with 2 m/s: 12 of 16 J are lost.
const std::string kDrop = R"({ "careen": 1, "duration": 0.5, "gravity": [0, 0, -10],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.5 } ],
  "boxes": [ { "name": "die", "half_extents": [0.5, 0.5, 0.5], "mass": 2, "position": [0, 0, 1.3] } ] })";

class EnergyOfRuns : public testing::Test {
 protected:
  void SetUp() override { folder_.write("drop.json", kDrop); }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  TemporaryFolder folder_;
};

TEST_F(EnergyOfRuns, isATableOfItsOwn) {
  const Ended ended = careen({"simulate", "drop.json", "--energy", "energy.csv", "--every", "0.25"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("drop.careen, energy.csv"), std::string::npos) << ended.out;
  const std::string table = textOf(folder_ / "energy.csv");
  EXPECT_EQ(
      table.substr(0, table.find('\n')),
      "time,translation,rotation,gravity,springs,joint_springs,total,motors,changes,impacts,joint_friction,"
      "damping,drag,remaining,px,py,pz,lx,ly,lz");
  EXPECT_NE(table.find("\n0,0,0,26,0,0,26,0,0,0,0,0,0,0,0,0,0,0,0,0\n"), std::string::npos) << table;
  EXPECT_EQ(careen({"simulate", "drop.json", "--energy", "drop.json"}).exitCode, 2);
  EXPECT_EQ(careen({"simulate", "drop.json", "--every", "0.25"}).exitCode, 2);
}

TEST_F(EnergyOfRuns, oneImpactIsToldInFull) {
  ASSERT_EQ(careen({"simulate", "drop.json", "-o", "run.careen"}).exitCode, 0);
  const Ended ended = careen({"info", "run.careen", "--impact", "2"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  for (const char* const piece :
       {"time         0.4 s\n", "together     with 0, 1, 3, parts of one\n",
        "impact       2 of 4, counted from 0: die struck floor\n", ", normal (0, 0, 1) from floor\n",
        "pair         restitution 0.5, friction 0\n",
        "normal       -4 m/s before, 2 m/s after, impulse 3 N s\n", "without friction\n",
        "box          die\n", "  after      (0, 0, 2) m/s, (0, 0, 0) rad/s, 4 J\n",
        "energy       16 J before, 4 J after, kinetic; lost 12 J\n", "law          several contacts"}) {
    EXPECT_NE(ended.out.find(piece), std::string::npos) << piece << " is not in\n" << ended.out;
  }
}

TEST_F(EnergyOfRuns, anImpactThatIsNotThereIsRefused) {
  ASSERT_EQ(careen({"simulate", "drop.json", "-o", "run.careen"}).exitCode, 0);
  const auto refusal = [&](const std::string& file, const std::string& impact) {
    const Ended ended = careen({"info", file, "--impact=" + impact});
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_EQ(ended.out, "");
    return ended.err;
  };
  EXPECT_NE(
      refusal("run.careen", "4").find("--impact: found impact 4, expected 0 to 3: the run has 4 impacts"),
      std::string::npos);
  EXPECT_NE(refusal("run.careen", "-1").find("found impact -1"), std::string::npos);
  EXPECT_NE(refusal("run.careen", "first").find("--impact"), std::string::npos);
  EXPECT_NE(refusal("drop.json", "0").find("found no run"), std::string::npos);
}

}  // namespace
}  // namespace careen
