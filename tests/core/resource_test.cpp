#include "core/resource.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

// A CAREEN_DATA of the test's own, put back afterwards.
class Resource : public testing::Test {
 protected:
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

TEST_F(Resource, comesFromBesideTheProgramWhenInstalled) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path share = program.parent_path().parent_path() / "share" / "careen";
  ASSERT_FALSE(fs::exists(share.parent_path()));
  fs::create_directories(share);
  const fs::path found = resourceFolder();
  fs::remove_all(share.parent_path());
  EXPECT_EQ(found, share);
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
