#include "core/system/resource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "core/error.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

class Resource : public testing::Test {
 private:
  EnvironmentVariable none_{"CAREEN_DATA", std::nullopt};
};

TEST_F(Resource, comesFromTheSourceTreeWhenNotInstalled) {
  EXPECT_EQ(resourceFolder(), fs::path(CAREEN_SOURCE_DIR));
  EXPECT_TRUE(fs::is_regular_file(findResource("assets/scenes/careen.json")));
}

TEST_F(Resource, isAFolder) {
  std::cout << "it is " << resourceFolder().string() << '\n';  // for the test below
  EXPECT_TRUE(fs::is_directory(resourceFolder()));
}

// This program, copied into the layout of an installation.
TEST_F(Resource, comesFromBesideTheProgramWhenInstalled) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  fs::create_directories(folder / "share/careen");
  fs::copy_file("/proc/self/exe", folder / "bin/program");
  const Ended ended =
      Process({folder / "bin/program", "--gtest_filter=Resource.isAFolder"}, folder.path()).wait();
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_NE(ended.out.find("it is " + (folder / "share/careen").string()), std::string::npos) << ended.out;
}

TEST_F(Resource, comesFromWhereTheEnvironmentSays) {
  const EnvironmentVariable data("CAREEN_DATA", "/nowhere");
  EXPECT_EQ(resourceFolder(), "/nowhere");
  const EnvironmentVariable empty("CAREEN_DATA", "");  // an empty value counts as unset
  EXPECT_EQ(resourceFolder(), fs::path(CAREEN_SOURCE_DIR));
}

TEST_F(Resource, missingOnesAreToldWithThePlaceLookedAt) {
  const EnvironmentVariable data("CAREEN_DATA", "/nowhere");
  try {
    findResource("shaders/box.vert");
    FAIL() << "the file does not exist";
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/shaders/box.vert: not found; looked in /nowhere (the environment's CAREEN_DATA)");
  }
}

}  // namespace
}  // namespace careen
