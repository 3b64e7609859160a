#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stage/picture_settings.h"

namespace careen {

/// Describes the film in a folder of frames; stored there as film.json.
struct FilmManifest {
  std::string program;   ///< name and version of the program that draws it
  std::string renderer;  ///< GL renderer; empty: nothing drawn yet
  /// Names and versions of the other libraries that affect the run or its pictures. Only explains
  /// differences; films made with other versions still count as the same film.
  std::string libraries;
  std::string sceneHash;
  std::string stateHash;  ///< of the final state of the run
  std::string shownAs;    ///< hash of the scene whose camera and light it has; empty: the run's own
  std::string ghost;      ///< state hash of the run that is shown as outlines; empty: none
  std::string beside;     ///< likewise of those that are shown beside it
  std::string plot;       ///< what is plotted below; empty: nothing
  PictureSettings picture;
  std::int64_t frameCount = 0;       ///< of the whole film
  std::vector<std::int64_t> frames;  ///< requested so far, sorted
  /// Hash (core/hash.h) of the bytes of frames drawn so far, as text; older manifests have none.
  std::map<std::int64_t, std::string> hashes;
};

/// The value of `hashes` for a frame's file of these bytes.
std::string frameHash(std::string_view bytes);

/// The value of `libraries` for a film made by this program on this machine.
std::string librariesHere();

inline constexpr const char* kManifestName = "film.json";

/// The folder's manifest, nullopt if it has none. InputError if it cannot be parsed, or lists more frames
/// than kMostFramesNamed: a few bytes may list any number.
std::optional<FilmManifest> readManifest(const std::filesystem::path& folder);
void writeManifest(const std::filesystem::path& folder, const FilmManifest& manifest);

/// What two films differ in, apart from the requested frames; empty if they are the same film. Renderers are
/// compared only if both are known.
std::string differenceOf(const FilmManifest& there, const FilmManifest& asked);

}  // namespace careen
