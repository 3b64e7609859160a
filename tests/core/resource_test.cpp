#include "core/resource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

// A CAREEN_DATA of the test's own, put back afterwards.
class Resource : public testing::Test {
 public:
  Resource() {
    if (const char* const told = std::getenv("CAREEN_DATA")) {
      before_ = told;
    }
    unsetenv("CAREEN_DATA");
  }
  ~Resource() override {
    before_.empty() ? unsetenv("CAREEN_DATA") : setenv("CAREEN_DATA", before_.c_str(), 1);
  }
  Resource(const Resource&) = delete;
  Resource& operator=(const Resource&) = delete;
  Resource(Resource&&) = delete;
  Resource& operator=(Resource&&) = delete;

 private:
  std::string before_;
};

TEST_F(Resource, comesFromTheSourceTreeWhenNotInstalled) {
  EXPECT_EQ(resourceFolder(), fs::path(CAREEN_SOURCE_DIR));
  EXPECT_TRUE(fs::is_regular_file(findResource("assets/scenes/careen.json")));
}

TEST_F(Resource, isAFolder) {
  std::cout << "it is " << resourceFolder().string() << '\n';  // for the test below
  EXPECT_TRUE(fs::is_directory(resourceFolder()));
}

// This program, copied to where an installed one lies.
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
  setenv("CAREEN_DATA", "/nowhere", 1);
  EXPECT_EQ(resourceFolder(), "/nowhere");
  setenv("CAREEN_DATA", "", 1);  // as good as not set
  EXPECT_EQ(resourceFolder(), fs::path(CAREEN_SOURCE_DIR));
}

TEST_F(Resource, missingOnesAreToldWithThePlaceLookedAt) {
  setenv("CAREEN_DATA", "/nowhere", 1);
  try {
    findResource("shaders/box.vert");
    FAIL() << "nothing is there";
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/shaders/box.vert: not found; looked in /nowhere (the environment's CAREEN_DATA)");
  }
}

}  // namespace
}  // namespace careen
