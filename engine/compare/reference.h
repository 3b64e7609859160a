#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <stop_token>
#include <string>

#include "compare/comparison.h"
#include "film/manifest.h"

namespace careen {

/// A film that another one is compared with.
struct Reference {
  std::filesystem::path folder;
  FilmManifest film;
};

/// InputError if there is no film, or none of its frames.
Reference readReference(const std::filesystem::path& folder);

/// Names of the files of a film's frames.
std::set<std::string> frameNamesOf(const FilmManifest& film);

/// Is told the result, before anything is made of it.
using ComparisonTold = std::function<void(const Comparison&)>;

/// Compares a film with the reference. Keeps of it only the frames that differ, a film.json that lists only
/// those, and a report (compare/report.h); only junit.xml if the film is the same or could not be compared.
struct ComparedWithReference {
  Comparison comparison;
  std::size_t kept = 0;  ///< frames
};
ComparedWithReference compareWithReference(const Reference& reference, const std::filesystem::path& film,
                                           const ComparisonSettings& settings, const ComparisonTold& tell,
                                           const std::stop_token& stop = {});

}  // namespace careen
