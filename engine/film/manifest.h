#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stage/picture_settings.h"

namespace careen {

/// What a folder of frames is a film of; kept beside them as film.json.
struct FilmManifest {
  std::string program;   ///< name and version of what draws it
  std::string renderer;  ///< GL's; empty: nothing was drawn yet
  /// Names and versions of the other libraries that have a say in the run or its pictures. It explains a
  /// difference; a film made with others is no other film.
  std::string libraries;
  std::string sceneHash;
  std::string stateHash;  ///< of the run's end
  PictureSettings picture;
  std::int64_t frameCount = 0;       ///< of the whole film
  std::vector<std::int64_t> frames;  ///< those asked for so far, in order
};

/// What `libraries` is to be for a film made by this program on this machine.
std::string librariesHere();

inline constexpr const char* kManifestName = "film.json";

/// The folder's manifest, nothing if it has none. InputError if it is there and cannot be understood.
std::optional<FilmManifest> readManifest(const std::filesystem::path& folder);
void writeManifest(const std::filesystem::path& folder, const FilmManifest& manifest);

/// In what two films differ, frames asked for aside: empty if they are the same film. Renderers differ only
/// where both are known.
std::string differenceOf(const FilmManifest& there, const FilmManifest& asked);

}  // namespace careen
