#include "core/system/atomic_folder.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

std::error_code exchange(const fs::path& one, const fs::path& other) {
#ifdef RENAME_EXCHANGE
  if (renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0) {
    return {};
  }
  std::error_code error(errno, std::system_category());
  if (error != std::errc::invalid_argument && error != std::errc::function_not_supported) {
    return error;
  }
  // This file system cannot.
#else
  std::error_code error;
#endif
  const fs::path aside = partialPath(one);
  fs::rename(other, aside, error);
  if (error) {
    return error;
  }
  fs::rename(one, other, error);
  std::error_code none;
  fs::rename(aside, error ? other : one, none);
  return error;
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path place)
    : place_(std::move(place)), partial_(partialPath(place_)), cleanup_([this] { remove(); }) {
  std::error_code error;
  fs::remove_all(partial_, error);  // of a killed process that had this number
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

void AtomicFolder::replace() {
  const std::lock_guard lock(mutex_);
  if (removed_) {
    throw Interrupted();
  }
  if (const std::error_code error = exchange(partial_, place_)) {
    throw MachineError(place_.string() + ": cannot be replaced: " + error.message());
  }
}

void AtomicFolder::remove() {
  const std::lock_guard lock(mutex_);
  removed_ = true;
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
