// An installed program uses its own copies of scenes, in any folder; its code is built in.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/process.h"

namespace careen {
namespace {

TEST(Install, programFindsItsOwnScenes) {
  const TemporaryFolder folder;
  const Ended installed =
      Process({CAREEN_CMAKE, "--install", CAREEN_BUILD_DIR, "--prefix", folder / "there"}, folder.path())
          .wait();
  ASSERT_EQ(installed.exitCode, 0) << installed.err;
  for (const char* const code : {"shaders", "assets/plots", "assets/compare/page.js"}) {
    EXPECT_FALSE(std::filesystem::exists(folder / "there/share/careen" / code)) << code;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "there/share/careen/assets/compare/report.schema.json"));

  const std::filesystem::path scene = folder / "there/share/careen/assets/scenes/careen.json";
  std::string text = textOf(scene);
  const std::string name = R"("name": "careen")";
  ASSERT_NE(text.find(name), std::string::npos);
  text.replace(text.find(name), name.size(), R"("name": "the installed one")");
  std::ofstream(scene) << text;

  const Ended ended = Process({folder / "there/bin/careen", "info"}, folder.path()).wait();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("the installed one"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace careen
