// Truths of the study's cases, in a data folder whose other parts are the project's.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fuzz/fuzz.h"
#include "study/case.h"
#include "support/process.h"

namespace careen {
namespace {

constexpr const char* kName = "fuzzed";

std::filesystem::path makeData(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  fs::create_directories(folder / "assets/truths");
  fs::create_directory_symlink(fs::path(CAREEN_SOURCE_DIR) / "assets/scenes", folder / "assets/scenes");
  setenv("CAREEN_DATA", folder.c_str(), 1);
  return folder / "assets/truths" / (std::string(kName) + ".json");
}

}  // namespace
}  // namespace careen

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  static const TemporaryFolder folder;
  static const std::filesystem::path truth = makeData(folder.path());
  std::ofstream(truth, std::ios::binary) << fuzz::textOf(data, size);
  fuzz::refusesOrReads([] { readCase(kName).simulated(); });
  return 0;
}
