#include "compare/approval.h"

#include <algorithm>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "compare/films.h"
#include "core/error.h"
#include "core/system/file.h"
#include "core/system/folder_lock.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

fs::path placeToReplace(const Reference& reference) {
  const fs::path place = fs::canonical(reference.folder);
  const fs::path here = fs::current_path();
  if (std::mismatch(place.begin(), place.end(), here.begin(), here.end()).first == place.end()) {
    throw InputError("found the current folder in --ref, " + reference.folder.string() +
                     ", which is replaced; expected to be run from another folder");
  }
  return place;
}

bool isLeftover(const std::string& name) {
  return name == FolderLock::kFileName || (name.starts_with('.') && name.ends_with(kPartialSuffix));
}

// As a link where that is possible: the same file, with its times and owner.
void takeEntry(const fs::path& from, const fs::path& to) {
  constexpr fs::copy_options kAll = fs::copy_options::recursive | fs::copy_options::copy_symlinks;
  std::error_code error;
  fs::copy(from, to, kAll | fs::copy_options::create_hard_links, error);
  if (error) {
    fs::remove_all(to, error);
    fs::copy(from, to, kAll, error);
  }
  if (error) {
    throw MachineError(from.string() + ": cannot be taken along: " + error.message());
  }
}

}  // namespace

Approval::Approval(const Reference& reference)
    : reference_(reference), place_(placeToReplace(reference)), film_(place_) {}

void Approval::takeAlong() const {
  const std::set<std::string> replaced = frameNamesOf(reference_.film);
  for (const fs::directory_entry& entry : fs::directory_iterator(place_)) {
    const std::string name = entry.path().filename().string();
    if (!replaced.contains(name) && !isLeftover(name) && !fs::exists(fs::symlink_status(folder() / name))) {
      takeEntry(entry.path(), folder() / name);
    }
  }
  fs::permissions(folder(), fs::status(place_).permissions());
}

Comparison Approval::approve(ComparisonSettings settings, const ComparisonTold& tell,
                             const std::stop_token& stop) {
  const FolderLock lock(place_);
  settings.only = frameNamesOf(reference_.film);
  Comparison comparison = compareFilms(place_, folder(), settings, stop);
  tell(comparison);
  if (comparison.verdict == Verdict::kDifferent) {
    takeAlong();
    film_.replace();
  }
  return comparison;
}

}  // namespace careen
