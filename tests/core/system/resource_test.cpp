#include "core/system/resource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "core/error.h"
#include "support/copied_program.h"
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
  EXPECT_EQ(findResource("assets"), fs::path(CAREEN_SOURCE_DIR) / "assets");
  EXPECT_TRUE(fs::is_regular_file(findResource("assets/scenes/careen.json")));
}

TEST_F(Resource, isAFolder) {
  std::cout << "it is " << findResource("assets").string() << '\n';  // for the test below
  EXPECT_TRUE(fs::is_directory(findResource("assets")));
  EXPECT_EQ(codeFolder(), "");
}

// This program, copied into the layout of an installation: its data lies there, its code does not.
TEST_F(Resource, comesFromBesideTheProgramWhenInstalled) {
  const CopiedProgram program("/proc/self/exe");
  fs::create_directories(program.data() / "assets");
  const Ended ended =
      Process({program.path(), "--gtest_filter=Resource.isAFolder"}, program.path().parent_path()).wait();
  EXPECT_EQ(ended.exitCode, 0) << ended.out;
  EXPECT_NE(ended.out.find("it is " + (program.data() / "assets").string()), std::string::npos) << ended.out;
}

TEST_F(Resource, comesFromWhereTheEnvironmentSays) {
  const TemporaryFolder folder;
  folder.write("some.json", "{}");
  const EnvironmentVariable data("CAREEN_DATA", folder.path().string());
  EXPECT_EQ(findResource("some.json"), folder / "some.json");
  EXPECT_EQ(codeFolder(), folder.path());
  const EnvironmentVariable empty("CAREEN_DATA", "");  // an empty value counts as unset
  EXPECT_EQ(findResource("assets"), fs::path(CAREEN_SOURCE_DIR) / "assets");
  EXPECT_EQ(codeFolder(), "");
}

TEST_F(Resource, missingOnesAreToldWithThePlaceLookedAt) {
  const EnvironmentVariable data("CAREEN_DATA", "/nowhere");
  try {
    findResource("assets/some.json");
    FAIL() << "the file does not exist";
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/assets/some.json: not found; looked in /nowhere (the environment's CAREEN_DATA)");
  }
  EXPECT_THROW(codeFolder(), MachineError);
}

TEST_F(Resource, codeIsTheFileOfAGivenFolderElseBuiltIn) {
  const TemporaryFolder folder;
  folder.write("a.frag", "edited");
  EXPECT_EQ(codeText(folder.path(), "a.frag", "built in"), "edited");
  EXPECT_EQ(codeText(folder.path(), "b.frag", "built in"), "built in");
  EXPECT_THROW(codeText(folder.path(), "b.frag", ""), MachineError);
  fs::create_directories(folder / "c.frag");  // exists but cannot be read
  EXPECT_THROW(codeText(folder.path(), "c.frag", "built in"), MachineError);
}

TEST_F(Resource, codeIsNotReadFromTheWorkingFolder) {
  const TemporaryFolder folder;
  folder.write("a.frag", "planted");
  const fs::path here = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_EQ(codeText("", "a.frag", "built in"), "built in");
  fs::current_path(here);
}

}  // namespace
}  // namespace careen
