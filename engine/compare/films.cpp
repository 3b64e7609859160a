#include "compare/films.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "film/manifest.h"

namespace careen {
namespace {

// What the films' manifests say, if both folders have one.
struct Films {
  std::vector<Fact> facts;
  std::optional<bool> sameMotion;
  bool any = false;  ///< one of the folders has a manifest
};

Films filmsIn(const std::filesystem::path& expected, const std::filesystem::path& actual) {
  Films films;
  const std::optional<FilmManifest> one = readManifest(expected);
  const std::optional<FilmManifest> other = readManifest(actual);
  films.any = one || other;
  if (one && other) {
    films.sameMotion = one->stateHash == other->stateHash;
    films.facts = {{"scene hash", one->sceneHash, other->sceneHash},
                   {"state hash", one->stateHash, other->stateHash},
                   {"program", one->program, other->program},
                   {"renderer", one->renderer, other->renderer},
                   {"libraries", one->libraries, other->libraries},
                   {"frames per second", one->picture.rate.text(), other->picture.rate.text()},
                   {"frames of the film", std::to_string(one->frameCount), std::to_string(other->frameCount)},
                   {"look", nameOf(one->picture.look), nameOf(other->picture.look)},
                   {"antialiasing", nameOf(one->picture.antialiasing), nameOf(other->picture.antialiasing)},
                   {"shutter", one->picture.shutter.text(), other->picture.shutter.text()},
                   {"overlays", one->picture.overlays.text(), other->picture.overlays.text()},
                   {"alpha", one->picture.alpha ? "yes" : "no", other->picture.alpha ? "yes" : "no"},
                   {"light", one->picture.light.text(), other->picture.light.text()}};
  }
  return films;
}

}  // namespace

Comparison compareFilms(const std::filesystem::path& expected, const std::filesystem::path& actual,
                        const ComparisonSettings& settings, const std::stop_token& stop) {
  Films films = filmsIn(expected, actual);
  ComparisonSettings ofFolders = settings;
  ofFolders.subfolders = !films.any;  // labels and reports may lie in a film's sub-folders
  Comparison comparison = compareFolders(expected, actual, ofFolders, films.sameMotion, {}, stop);
  comparison.facts = std::move(films.facts);
  return comparison;
}

}  // namespace careen
