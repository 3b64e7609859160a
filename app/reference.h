#pragma once

#include <filesystem>
#include <stop_token>

#include "compare.h"
#include "core/error.h"
#include "film/manifest.h"
#include "picture_options.h"
#include "render/film/film.h"

namespace careen {

/// The film that another is to be like: what `render --ref` names.
struct Reference {
  std::filesystem::path folder;
  FilmManifest film;
};

/// InputError if there is no film, or not one of its frames.
Reference readReference(const std::filesystem::path& folder);

/// What the command line left open is to be as in the reference, not as in the scene: size, rate, look,
/// antialiasing, shutter, overlays, and which frames. Given frames are compared with those of the same
/// numbers.
void takeFromReference(const Reference& reference, PictureOptions& picture, std::string& frames,
                       CompareOptions& compare);

/// Compares the film just made with the reference and tells what was found. Of the film the frames that
/// differ stay, its film.json, which then tells of those, and a report (compare/report.h); nothing if it is
/// the same.
ExitCode compareWithReference(const Reference& reference, const FilmSettings& film,
                              const CompareOptions& options, bool logsFrames, const std::stop_token& stop);

}  // namespace careen
