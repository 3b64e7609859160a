#pragma once

#include <filesystem>
#include <stop_token>

#include "compare.h"
#include "core/error.h"
#include "film/manifest.h"
#include "picture_options.h"
#include "render/film/film.h"

namespace careen {

/// The reference film, named by `render --ref`.
struct Reference {
  std::filesystem::path folder;
  FilmManifest film;
};

/// InputError if there is no film, or none of its frames.
Reference readReference(const std::filesystem::path& folder);

/// Takes what the command line left open from the reference instead of the scene: size, rate, look,
/// antialiasing, shutter, overlays, and which frames. If frames are given, they are compared with those of
/// the same numbers.
void takeFromReference(const Reference& reference, PictureOptions& picture, std::string& frames,
                       CompareOptions& compare);

/// Compares the film just made with the reference and prints the result. Keeps of the film only the frames
/// that differ, a film.json that lists only those, and a report (compare/report.h); only junit.xml if the
/// film is the same or could not be compared.
ExitCode compareWithReference(const Reference& reference, const FilmSettings& film,
                              const CompareOptions& options, bool logsFrames, const std::stop_token& stop);

}  // namespace careen
