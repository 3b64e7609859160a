#include "reference.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "compare/report.h"
#include "core/system/file.h"
#include "film/folder.h"
#include "film/frame_range.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

// Returns how many frames differ. Deletes only what was made for the comparison: the folder may hold other
// files.
std::size_t keepFramesThatDiffer(const fs::path& folder, const Comparison& comparison) {
  std::set<std::string> different;
  for (const FrameComparison& frame : comparison.frames) {
    if (frame.verdict == Verdict::kDifferent) {
      different.insert(frame.name);
    }
  }
  FilmManifest film = readManifest(folder).value();
  const auto isSame = [&](std::int64_t frame) { return !different.contains(frameFileName(frame)); };
  for (const std::int64_t frame : film.frames) {
    if (isSame(frame)) {
      fs::remove(folder / frameFileName(frame));
    }
  }
  std::erase_if(film.frames, isSame);
  std::erase_if(film.hashes, [&](const auto& each) { return isSame(each.first); });
  if (comparison.verdict == Verdict::kDifferent) {
    writeManifest(folder, film);
  } else {
    fs::remove(folder / kManifestName);
  }
  return film.frames.size();
}

// Whoever waits for a verdict in junit.xml learns there of an error, too.
Comparison comparedOrTold(const Reference& reference, const FilmSettings& film,
                          const ComparisonSettings& settings, const std::stop_token& stop) {
  try {
    return compare(reference.folder, film.folder, settings, {}, stop);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    Comparison failed;
    failed.expected = reference.folder;
    failed.actual = film.folder;
    failed.program = settings.program;
    writeFile(film.folder / kJunitName, reportJunitOfError(failed, error.what()));
    throw;
  }
}

}  // namespace

Reference readReference(const fs::path& folder) {
  std::error_code none;
  const char* const expected = ", expected a folder with a film of careen's";
  if (!fs::is_directory(folder, none)) {
    throw InputError("--ref: " + folder.string() +
                     (fs::exists(folder, none) ? " is no folder" : " is not there") + expected);
  }
  std::optional<FilmManifest> film = readManifest(folder);
  if (!film) {
    throw InputError("--ref: " + folder.string() + " has no " + kManifestName + expected);
  }
  if (std::none_of(film->frames.begin(), film->frames.end(),
                   [&](std::int64_t frame) { return fs::exists(folder / frameFileName(frame), none); })) {
    throw InputError("--ref: " + folder.string() + " has none of the frames that its " + kManifestName +
                     " lists" + expected);
  }
  return {.folder = folder, .film = std::move(*film)};
}

void takeFromReference(const Reference& reference, PictureOptions& picture, std::string& frames,
                       CompareOptions& compare) {
  const FilmManifest& film = reference.film;
  const auto take = [](std::optional<std::string>& open, const std::string& value) {
    if (!open) {
      open = value;
    }
  };
  take(picture.size, std::to_string(film.picture.width) + "x" + std::to_string(film.picture.height));
  take(picture.rate, film.picture.rate.text());
  take(picture.look, nameOf(film.picture.look));
  take(picture.antialiasing, nameOf(film.picture.antialiasing));
  take(picture.shutter, film.picture.shutter.degrees > 0 ? film.picture.shutter.text() : "0");
  take(picture.overlays, film.picture.overlays.text());
  take(picture.light, film.picture.light.text());
  picture.alpha = picture.alpha || film.picture.alpha;
  if (frames.empty()) {
    frames = rangesText(film.frames);
    return;
  }
  for (const std::int64_t frame : framesOf(parseFrameRanges(frames), film.frameCount)) {
    compare.only.insert(frameFileName(frame));
  }
}

ExitCode compareWithReference(const Reference& reference, const FilmSettings& film,
                              const CompareOptions& options, bool logsFrames, const std::stop_token& stop) {
  const Comparison comparison = comparedOrTold(reference, film, options.settings(), stop);
  tell(comparison, logsFrames);
  if (comparison.verdict == Verdict::kDifferent) {
    writeReport(film.folder, comparison);  // while all pictures are still there
  } else {
    writeFile(film.folder / kJunitName, reportJunit(comparison));
  }
  const std::size_t kept = keepFramesThatDiffer(film.folder, comparison);
  std::ostream& out = logsFrames ? std::cerr : std::cout;
  const fs::path folder = fs::absolute(film.folder).lexically_normal();
  if (comparison.verdict == Verdict::kDifferent) {
    out << "kept         " << kept << (kept == 1 ? " frame" : " frames") << " that differ"
        << (kept == 1 ? "s: " : ": ") << folder.string() << '\n';
  } else {
    out << "kept         no frame; the result is in " << (folder / kJunitName).string() << '\n';
  }
  return exitCodeOf(comparison);
}

}  // namespace careen
