#include "compare/reference.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "compare/films.h"
#include "compare/report.h"
#include "core/error.h"
#include "core/system/file.h"
#include "film/folder.h"

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
Comparison comparedOrTold(const Reference& reference, const fs::path& film,
                          const ComparisonSettings& settings, const std::stop_token& stop) {
  try {
    return compareFilms(reference.folder, film, settings, stop);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    Comparison failed;
    failed.expected = reference.folder;
    failed.actual = film;
    failed.program = settings.program;
    writeFile(film / kJunitName, reportJunitOfError(failed, error.what()));
    throw;
  }
}

}  // namespace

Reference readReference(const fs::path& folder) {
  std::error_code none;
  const char* const expected = ", expected a folder with a film of careen's";
  if (!fs::is_directory(folder, none)) {
    throw InputError(folder.string() + (fs::exists(folder, none) ? " is no folder" : " is not there") +
                     expected);
  }
  std::optional<FilmManifest> film = readManifest(folder);
  if (!film) {
    throw InputError(folder.string() + " has no " + kManifestName + expected);
  }
  if (std::none_of(film->frames.begin(), film->frames.end(),
                   [&](std::int64_t frame) { return fs::exists(folder / frameFileName(frame), none); })) {
    throw InputError(folder.string() + " has none of the frames that its " + kManifestName + " lists" +
                     expected);
  }
  return {.folder = folder, .film = std::move(*film)};
}

std::set<std::string> frameNamesOf(const FilmManifest& film) {
  std::set<std::string> names;
  for (const std::int64_t frame : film.frames) {
    names.insert(frameFileName(frame));
  }
  return names;
}

ComparedWithReference compareWithReference(const Reference& reference, const fs::path& film,
                                           const ComparisonSettings& settings, const ComparisonTold& tell,
                                           const std::stop_token& stop) {
  Comparison comparison = comparedOrTold(reference, film, settings, stop);
  tell(comparison);
  if (comparison.verdict == Verdict::kDifferent) {
    writeReport(film, comparison);  // while all pictures are still there
  } else {
    writeFile(film / kJunitName, reportJunit(comparison));
  }
  const std::size_t kept = keepFramesThatDiffer(film, comparison);
  return {.comparison = std::move(comparison), .kept = kept};
}

}  // namespace careen
