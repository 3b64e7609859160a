#include "core/system/atomic_folder.h"

#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

}  // namespace

AtomicFolder::AtomicFolder(fs::path place)
    : place_(std::move(place)), partial_(partialPath(place_)), cleanup_([this] { remove(); }) {
  remove();  // of a killed process that had this number
  std::error_code error;
  fs::create_directories(partial_, error);
  if (error) {
    throw MachineError(place_.string() + ": cannot be made a folder: " + error.message());
  }
}

AtomicFolder::~AtomicFolder() {
  if (!committed_) {
    remove();
  }
}

void AtomicFolder::commit() {
  std::error_code error;
  fs::rename(partial_, place_, error);
  if (error == std::errc::directory_not_empty || error == std::errc::file_exists) {
    return;
  }
  if (error) {
    throw MachineError(place_.string() + ": cannot be put in place: " + error.message());
  }
  committed_ = true;
}

void AtomicFolder::remove() const {
  std::error_code none;
  fs::remove_all(partial_, none);
}

void removePartials(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.ends_with(kPartialSuffix)) {
      found.push_back(entry.path());
    }
  }
  for (const fs::path& path : found) {
    fs::remove_all(path, none);
  }
}

}  // namespace careen
