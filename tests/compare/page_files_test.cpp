#include "compare/page_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

TEST(PageFiles, areAllBuiltIntoTheProgram) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAREEN_SOURCE_DIR "/assets/compare")) {
    if (entry.path().extension() != ".json") {  // the schema is data
      EXPECT_EQ(embeddedPageFile(entry.path().filename().string()), textOf(entry.path())) << entry.path();
      ++files;
    }
  }
  EXPECT_GT(files, 6);
  EXPECT_EQ(embeddedPageFile("none.js"), "");
}

TEST(PageFiles, comeFromDiskOnlyWhereTheEnvironmentSaysSo) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "assets/compare");
  folder.write("assets/compare/page.js", "changed\n");
  {
    const EnvironmentVariable data("CAREEN_DATA", folder.path().string());
    EXPECT_EQ(pageFile("page.js"), "changed\n");
    EXPECT_EQ(pageFile("run.js"), embeddedPageFile("run.js"));
    EXPECT_THROW(pageFile("none.js"), MachineError);
  }
  const EnvironmentVariable none("CAREEN_DATA", std::nullopt);
  EXPECT_EQ(pageFile("page.js"), embeddedPageFile("page.js"));
}

}  // namespace
}  // namespace careen
