// The version stands in one place, and in whatever reports the program writes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

TEST(Version, standsInEveryOutput) {
  const TemporaryFolder folder;
  const auto careen = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program());
    const Ended ended = Process(arguments, folder.path()).wait();
    EXPECT_TRUE(ended.exitCode == 0 || arguments[1] == "compare") << ended.err;
    return ended.out;
  };
  std::string version = careen({"--version"});
  version = version.substr(0, version.find('\n'));
  ASSERT_TRUE(version.starts_with("careen ")) << version;

  careen({"simulate", "-o", "run.careen", "--report", "simulated.json", "--poses", "toss.csv", "--duration",
          "0.9"});
  careen({"audit", "run.careen", "--report", "audited.json"});
  careen({"export", "run.careen", "--out", "film.glb"});
  careen({"export", "run.careen", "--out", "start.xml"});
  careen(
      {"truth", "run.careen", "--out", "truth", "--channels", "depth", "--frames", "0", "--size", "32x18"});
  careen({"compare", "run.careen", "run.careen", "--out", "compared"});
  careen({"dice", "--throws", "1", "--out", "dice"});
  const std::string scene = CAREEN_SOURCE_DIR "/assets/scenes/careen.json";
  careen({"validate", "toss.csv", "--scene", scene, "--start", "first", "--no-plots"});
  careen({"study", "tumble-generic", "--quick", "--no-plots", "--methods", "exact", "--out", "study"});
  for (const char* const file :
       {"simulated.json", "audited.json", "film.glb", "start.xml", "truth/truth.json", "compared/report.json",
        "compared/index.html", "compared/junit.xml", "dice/dice.md", "validation/report.json",
        "validation/index.html", "study/results.md", "study/index.html"}) {
    EXPECT_NE(textOf(folder / file).find(version), std::string::npos) << file;
  }
  if (careen({"--help"}).find("\n  render") == std::string::npos) {
    return;  // built without GL
  }
  careen({"render", "run.careen", "--out", "film", "--frames", "0", "--size", "32x18"});
  EXPECT_NE(textOf(folder / "film/film.json").find(version), std::string::npos);
}

}  // namespace
}  // namespace careen
