#include "core/system/resource.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "core/error.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

struct Place {
  fs::path folder;
  std::string reason;
};

Place findPlace() {
  // The environment is written only before the first thread starts (LP_NUM_THREADS), so reading it is safe.
  const char* const configured = std::getenv("CAREEN_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (configured != nullptr && *configured != '\0') {
    return {configured, "the environment's CAREEN_DATA"};
  }
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  fs::path installed = program.parent_path().parent_path() / "share" / "careen";
  if (!program.empty() && fs::is_directory(installed, none)) {
    return {installed, "where the program is installed"};
  }
  return {CAREEN_SOURCE_DIR, "the source tree it was built from; set CAREEN_DATA if it has moved"};
}

}  // namespace

fs::path resourceFolder() { return findPlace().folder; }

fs::path findResource(const fs::path& relative) {
  const Place place = findPlace();
  fs::path path = place.folder / relative;
  std::error_code none;
  if (!fs::exists(path, none)) {
    throw MachineError(path.string() + ": not found; looked in " + place.folder.string() + " (" +
                       place.reason + ")");
  }
  return path;
}

}  // namespace careen
