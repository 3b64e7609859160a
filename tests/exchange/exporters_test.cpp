#include "exchange/exporters.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/system/file.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"

namespace careen {
namespace {

std::string exported(const Exporter& exporter, const Trajectory& run, const ExportSettings& settings) {
  std::string bytes;
  exporter.write(run, settings, [&bytes](std::string_view piece) { bytes += piece; });
  return bytes;
}

// Each takes part in what it says that it takes, and in nothing else.
TEST(Exporters, dependOnTheOptionTheyTake) {
  const Trajectory run = record(setupOf(parseScene(
      R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1, 2, 3], "mass": 1,
          "angular_velocity": [3, 2, 1]}]})",
      "s")));
  const ExportSettings usual{.within = 1e-4, .every = 0.1, .program = "the test"};
  ExportSettings rough = usual;
  rough.within = 1e-2;
  ExportSettings dense = usual;
  dense.every = 0.01;
  for (const Exporter* const each : kExporters) {
    const std::string bytes = exported(*each, run, usual);
    EXPECT_FALSE(bytes.empty()) << each->suffix;
    EXPECT_EQ(exported(*each, run, rough).size() < bytes.size(), each->option == ExportOption::kWithin)
        << each->suffix;
    EXPECT_EQ(exported(*each, run, dense).size() > bytes.size(), each->option == ExportOption::kEvery)
        << each->suffix;
  }
}

TEST(Exporters, haveSuffixesOfTheirOwnWhichTheManualNames) {
  const std::string manual = readFile(CAREEN_SOURCE_DIR "/assets/manual/export.md");
  std::set<std::string_view> suffixes;
  for (const Exporter* const each : kExporters) {
    EXPECT_TRUE(each->suffix.starts_with('.')) << each->suffix;
    EXPECT_TRUE(suffixes.insert(each->suffix).second) << each->suffix;
    EXPECT_NE(manual.find(std::string(each->suffix) + "`"), std::string::npos) << each->suffix;
  }
}

}  // namespace
}  // namespace careen
