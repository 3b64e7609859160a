#include "film/folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/system/file.h"
#include "image/png.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

bool hasPng(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) { return entry.path().extension() == ".png"; });
}

bool isNumber(std::string_view text, std::size_t fewestDigits) {
  return text.size() >= fewestDigits && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool isFrame(std::string_view name) {
  constexpr std::string_view kEnding = ".png";
  return name.ends_with(kEnding) && isNumber(name.substr(0, name.size() - kEnding.size()), 6);
}

// ".000012.png.4711.partial": AtomicFile's name for an unfinished file.
bool isPartial(std::string_view name) {
  if (!name.starts_with('.') || !name.ends_with(kPartialSuffix)) {
    return false;
  }
  name = name.substr(1, name.size() - 1 - kPartialSuffix.size());
  const std::size_t dot = name.rfind('.');
  return dot != std::string_view::npos && isNumber(name.substr(dot + 1), 1) &&
         (isFrame(name.substr(0, dot)) || name.substr(0, dot) == kManifestName);
}

void removeAll(const fs::path& folder, bool (*isMeant)(std::string_view)) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (isMeant(entry.path().filename().string())) {
      found.push_back(entry.path());
    }
  }
  for (const fs::path& path : found) {
    fs::remove(path);
  }
}

// Somebody else's files may have such names.
void removeComparison(const fs::path& folder) {
  if (holdsComparison(folder)) {
    for (const char* const name : {"index.html", "report.json", "junit.xml"}) {
      fs::remove(folder / name);
    }
  }
}

}  // namespace

std::string frameFileName(std::int64_t frame) {
  constexpr std::size_t kDigits = 6;
  const std::string number = std::to_string(frame);
  return std::string(kDigits - std::min(kDigits, number.size()), '0') + number + ".png";
}

bool holdsComparison(const fs::path& folder) {
  constexpr std::string_view kWritten = "<testsuites name=\"careen compare\"";
  std::string begun(200, '\0');
  std::ifstream(folder / "junit.xml", std::ios::binary).read(begun.data(), std::ssize(begun));
  return begun.find(kWritten) != std::string::npos;
}

FilmFolder::FilmFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  made_ = fs::create_directories(path_, error);
  if (error) {
    throw MachineError(path_.string() + ": cannot be made a folder: " + error.message());
  }
  cleanup_.emplace([this] {
    removePartials();
    removeIfEmpty();
  });
  lock_.emplace(path_);
  manifest_ = readManifest(path_);
  if (!manifest_ && hasPng(path_)) {
    throw InputError(path_.string() + ": holds PNG files that are no film of careen's; name another folder");
  }
}

FilmFolder::~FilmFolder() {
  cleanup_.reset();
  removePartials();
  lock_.reset();  // removes the lock file, which is in the folder
  removeIfEmpty();
}

// Our own and those of killed runs.
void FilmFolder::removePartials() const {
  try {
    removeAll(path_, isPartial);
  } catch (const std::exception&) {  // left for the next film to remove
  }
}

void FilmFolder::removeIfEmpty() const {
  if (made_) {
    std::error_code notEmpty;
    fs::remove(path_, notEmpty);
  }
}

std::vector<std::int64_t> FilmFolder::missing(const FilmManifest& asked) const {
  std::vector<std::int64_t> frames;
  std::copy_if(asked.frames.begin(), asked.frames.end(), std::back_inserter(frames), [&](std::int64_t frame) {
    const fs::path path = path_ / frameFileName(frame);
    return !isWholePng(path, asked.picture.width, asked.picture.height) || !isAsDrawn(path, frame);
  });
  return frames;
}

bool FilmFolder::isAsDrawn(const fs::path& path, std::int64_t frame) const {
  if (!manifest_) {
    return true;
  }
  const auto hash = manifest_->hashes.find(frame);
  return hash == manifest_->hashes.end() || hash->second == frameHash(readFile(path));
}

void FilmFolder::keep(const std::map<std::int64_t, std::string>& hashes) {
  for (const auto& [frame, hash] : hashes) {
    manifest_->hashes[frame] = hash;
  }
  // A run that was killed told nobody of its last frames.
  for (const std::int64_t frame : manifest_->frames) {
    const fs::path path = path_ / frameFileName(frame);
    if (!manifest_->hashes.contains(frame) &&
        isWholePng(path, manifest_->picture.width, manifest_->picture.height)) {
      manifest_->hashes[frame] = frameHash(readFile(path));
    }
  }
  writeManifest(path_, *manifest_);
}

void FilmFolder::begin(const FilmManifest& asked, bool keep) {
  FilmManifest manifest = asked;
  if (manifest_ && keep) {
    if (manifest.renderer.empty()) {
      manifest.renderer = manifest_->renderer;
    }
    std::vector<std::int64_t> frames;
    std::set_union(manifest_->frames.begin(), manifest_->frames.end(), asked.frames.begin(),
                   asked.frames.end(), std::back_inserter(frames));
    manifest.frames = std::move(frames);
    manifest.hashes = manifest_->hashes;
  } else if (manifest_) {
    for (const std::int64_t frame : manifest_->frames) {  // and no other file of such a name
      fs::remove(path_ / frameFileName(frame));
    }
  }
  removeComparison(path_);
  writeManifest(path_, manifest);
  manifest_ = std::move(manifest);
}

}  // namespace careen
