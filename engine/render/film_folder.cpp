#include "render/film_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <regex>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "image/frame_writer.h"
#include "image/png.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

bool hasPng(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) { return entry.path().extension() == ".png"; });
}

void removeMatching(const fs::path& folder, const std::regex& name) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (std::regex_match(entry.path().filename().string(), name)) {
      found.push_back(entry.path());
    }
  }
  for (const fs::path& path : found) {
    fs::remove(path);
  }
}

}  // namespace

FilmFolder::FilmFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  made_ = fs::create_directories(path_, error);
  if (error) {
    throw MachineError(path_.string() + ": cannot be made a folder: " + error.message());
  }
  lock();
  manifest_ = readManifest(path_);
  if (!manifest_ && hasPng(path_)) {
    throw InputError(path_.string() + ": holds PNG files that are no film of careen's; name another folder");
  }
  removePartials();
}

FilmFolder::~FilmFolder() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
  if (made_) {
    std::error_code notEmpty;
    fs::remove(path_, notEmpty);
  }
}

// Given up by the system when the process ends, however it ends. Some file systems have no locks; there, two
// processes in one folder go unnoticed.
void FilmFolder::lock() {
  descriptor_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(std::exchange(descriptor_, -1));
    throw InputError(path_.string() + ": another careen is writing a film there");
  }
}

std::vector<std::int64_t> FilmFolder::missing(const FilmManifest& asked) const {
  std::vector<std::int64_t> frames;
  std::copy_if(asked.frames.begin(), asked.frames.end(), std::back_inserter(frames), [&](std::int64_t frame) {
    return !looksWhole(path_ / frameFileName(frame), asked.width, asked.height);
  });
  return frames;
}

void FilmFolder::begin(const FilmManifest& asked, bool resume) {
  FilmManifest manifest = asked;
  if (manifest_ && resume) {
    std::vector<std::int64_t> frames;
    std::set_union(manifest_->frames.begin(), manifest_->frames.end(), asked.frames.begin(),
                   asked.frames.end(), std::back_inserter(frames));
    manifest.frames = std::move(frames);
  } else if (manifest_) {
    removeFrames();
  }
  writeManifest(path_, manifest);
  manifest_ = std::move(manifest);
}

// What a run left that was killed outright.
void FilmFolder::removePartials() const {
  static const std::regex kPartial(R"(\.(\d{6,}\.png|film\.json)\.\d+\.partial)");
  static_assert(kPartialEnding == ".partial");
  removeMatching(path_, kPartial);
}

void FilmFolder::removeFrames() const {
  static const std::regex kFrame(R"(\d{6,}\.png)");
  removeMatching(path_, kFrame);
}

}  // namespace careen
