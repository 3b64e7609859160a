#include "sweep/sweep_folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/system/atomic_folder.h"
#include "core/system/file.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSweepFile = "sweep.json";

bool isThere(const fs::path& path) {
  std::error_code none;
  return fs::exists(path, none);
}

bool isNumbered(std::string_view name, std::string_view suffix, std::size_t fewestDigits) {
  if (!name.ends_with(suffix) || name.size() < suffix.size() + fewestDigits) {
    return false;
  }
  return name.substr(0, name.size() - suffix.size()).find_first_not_of("0123456789") ==
         std::string_view::npos;
}

// A file of a film or of its labels.
bool isOfFilm(const std::string& name) {
  return name == "film.json" || name == "truth.json" || isNumbered(name, ".png", 6) ||
         isNumbered(name, ".npz", 6);
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    entries.push_back(entry.path());
  }
  return entries;
}

bool holdsOtherFiles(const fs::path& folder) {
  const std::vector<fs::path> entries = entriesOf(folder);
  return std::any_of(entries.begin(), entries.end(),
                     [](const fs::path& entry) { return entry.filename() != FolderLock::kFileName; });
}

// Trajectories and films of an earlier sweep's runs. What somebody else put there is never removed.
void removeRuns(const fs::path& runs) {
  std::vector<fs::path> found;
  for (const fs::path& entry : entriesOf(runs)) {
    const std::string name = entry.filename().string();
    std::error_code none;
    if (isNumbered(name, ".careen", 7)) {
      found.push_back(entry);
    } else if (isNumbered(name, "", 7) && fs::is_directory(entry, none)) {
      for (const fs::path& file : entriesOf(entry)) {
        if (!isOfFilm(file.filename().string())) {
          throw InputError(file.string() + ": is no file of a sweep's run, expected no others there");
        }
        found.push_back(file);
      }
      found.push_back(entry);
    }
  }
  for (const fs::path& path : found) {
    std::error_code none;
    fs::remove(path, none);
  }
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw MachineError(folder.string() + ": cannot be created: " + error.message());
  }
}

// The names of what two manifests differ in; "" if they are the same.
std::string differenceBetween(const std::string& there, const std::string& asked) {
  if (there == asked) {
    return "";
  }
  const auto one = nlohmann::json::parse(there, nullptr, false);
  const auto other = nlohmann::json::parse(asked, nullptr, false);
  if (!one.is_object()) {
    return "its text";
  }
  std::vector<std::string> names;
  for (const auto& [manifest, against] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    for (const auto& [name, value] : manifest->items()) {
      const bool isSame = against->contains(name) && (*against)[name] == value;
      if (!isSame && std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "its text" : text;
}

}  // namespace

SweepFolder::SweepFolder(fs::path path, const std::string& manifest, SweepOpening opening)
    : path_(std::move(path)), opening_(opening) {
  refuseAnother(manifest);
  made_ = !isThere(path_);
  makeFolder(path_);
  cleanup_.emplace([this] {
    tidy();
    removeIfEmpty();
  });
  lock_.emplace(path_, opening == SweepOpening::kShared ? LockKind::kShared : LockKind::kExclusive);
  try {
    open(manifest);
  } catch (...) {
    tidy();
    throw;
  }
}

SweepFolder::~SweepFolder() {
  cleanup_.reset();
  tidy();
  lock_.reset();
  removeIfEmpty();
}

bool SweepFolder::isFinished(const fs::path& path, const std::string& manifest) {
  return isThere(path / "table.csv") && isThere(path / kSweepFile) && readFile(path / kSweepFile) == manifest;
}

void SweepFolder::refuseAnother(const std::string& manifest) const {
  const fs::path file = path_ / kSweepFile;
  if (isThere(file)) {
    const std::string difference =
        opening_ == SweepOpening::kAnew ? "" : differenceBetween(readFile(file), manifest);
    if (!difference.empty()) {
      throw InputError(path_.string() + ": holds another sweep (sweep.json differs in: " + difference +
                       "), expected the same one or another --out");
    }
  } else if (opening_ == SweepOpening::kAnew && holdsOtherFiles(path_)) {
    throw InputError(path_.string() + ": holds other files, expected an empty folder or that of a sweep");
  }
}

void SweepFolder::open(const std::string& manifest) {
  refuseAnother(manifest);  // it may have come while this one waited for the lock
  const fs::path file = path_ / kSweepFile;
  if (opening_ == SweepOpening::kAnew) {
    removeEarlier();
  }
  makeFolder(rows());
  makeFolder(runs());
  if (opening_ == SweepOpening::kAnew || !isThere(file)) {
    writeFile(file, manifest);
  }
}

void SweepFolder::removeEarlier() const {
  removeRuns(runs());
  std::error_code none;
  for (const fs::path& entry : entriesOf(rows())) {
    if (entry.extension() == ".csv") {
      fs::remove(entry, none);
    }
  }
  fs::remove(table(".csv"), none);
  fs::remove(table(".npz"), none);
}

void SweepFolder::tidy() const {
  if (opening_ == SweepOpening::kShared) {  // others may be writing
    return;
  }
  std::error_code none;
  removePartials(rows());
  removePartials(runs());
  removePartials(path_);
  fs::remove(rows(), none);  // if it is empty
  fs::remove(runs(), none);
  if (!isThere(rows()) && !isThere(runs()) && !isThere(table(".csv"))) {
    fs::remove(path_ / kSweepFile, none);
  }
}

void SweepFolder::removeIfEmpty() const {
  if (made_ && opening_ != SweepOpening::kShared) {
    std::error_code notEmpty;
    fs::remove(path_, notEmpty);
  }
}

}  // namespace careen
