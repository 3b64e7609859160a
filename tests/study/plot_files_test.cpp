#include "study/plot_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

TEST(PlotFiles, areAllBuiltIntoTheProgram) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAREEN_SOURCE_DIR "/assets/plots")) {
    EXPECT_EQ(embeddedPlotFile(entry.path().filename().string()), textOf(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 4);
  EXPECT_EQ(embeddedPlotFile("none.gp"), "");
}

TEST(PlotFiles, comeFromDiskOnlyWhereTheEnvironmentSaysSo) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "assets/plots");
  folder.write("assets/plots/style.gp", "changed\n");
  {
    const EnvironmentVariable data("CAREEN_DATA", folder.path().string());
    EXPECT_EQ(plotFile("style.gp"), "changed\n");
    EXPECT_EQ(plotFile("matrix.gp"), embeddedPlotFile("matrix.gp"));
    EXPECT_THROW(plotFile("none.gp"), MachineError);
  }
  const EnvironmentVariable none("CAREEN_DATA", std::nullopt);
  EXPECT_EQ(plotFile("style.gp"), embeddedPlotFile("style.gp"));
}

}  // namespace
}  // namespace careen
