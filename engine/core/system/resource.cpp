#include "core/system/resource.h"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/system/file.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

struct Place {
  fs::path folder;
  std::string reason;
};

// $CAREEN_DATA; empty if unset.
fs::path configuredFolder() {
  // The environment is written only before the first thread starts (LP_NUM_THREADS), so reading it is safe.
  const char* const configured = std::getenv("CAREEN_DATA");  // NOLINT(concurrency-mt-unsafe)
  return configured == nullptr ? "" : configured;
}

Place findPlace() {
  if (fs::path configured = configuredFolder(); !configured.empty()) {
    return {std::move(configured), "the environment's CAREEN_DATA"};
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

fs::path codeFolder() {
  fs::path folder = configuredFolder();
  std::error_code none;
  if (!folder.empty() && !fs::is_directory(folder, none)) {
    throw MachineError("CAREEN_DATA: found " + folder.string() + ", expected a folder");
  }
  return folder;
}

std::string codeText(const fs::path& folder, const fs::path& relative, std::string_view builtIn) {
  std::error_code none;
  // A file that exists but cannot be read is told, not passed over.
  if (!folder.empty() && fs::status(folder / relative, none).type() != fs::file_type::not_found) {
    try {
      return readFile(folder / relative);
    } catch (const InputError& error) {
      throw MachineError(error.what());
    }
  }
  if (builtIn.empty()) {
    throw MachineError((folder / relative).string() + ": no such file, nor one built into the program");
  }
  return std::string(builtIn);
}

}  // namespace careen
