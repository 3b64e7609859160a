#include "film/faults.h"

#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/system/file.h"
#include "film/folder.h"
#include "image/png.h"

namespace careen {
namespace {

// Returns an empty string if the frame is valid.
std::string faultOf(const std::filesystem::path& path, std::int64_t frame, const FilmManifest& film) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) {
    return "is missing";
  }
  try {
    const std::string bytes = readFile(path);
    const Picture picture = decodePng(bytes, path.string());
    if (picture.width != film.picture.width || picture.height != film.picture.height) {
      return "is " + std::to_string(picture.width) + "x" + std::to_string(picture.height) + ", expected " +
             std::to_string(film.picture.width) + "x" + std::to_string(film.picture.height);
    }
    const auto hash = film.hashes.find(frame);
    if (hash != film.hashes.end() && hash->second != frameHash(bytes)) {
      return "is another picture than was drawn";
    }
  } catch (const InputError& error) {
    const std::string words = error.what();
    return words.substr(path.string().size() + 2);  // the text after "path: "
  }
  return {};
}

}  // namespace

std::vector<FrameFault> findFaults(const std::filesystem::path& folder, const FilmManifest& manifest) {
  std::vector<FrameFault> faults;
  for (const std::int64_t frame : manifest.frames) {
    std::string what = faultOf(folder / frameFileName(frame), frame, manifest);
    if (!what.empty()) {
      faults.push_back({.frame = frame, .what = std::move(what)});
    }
  }
  return faults;
}

}  // namespace careen
