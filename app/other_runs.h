#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "render/film/film_pictures.h"
#include "run_options.h"

namespace careen {

/// Other runs that a film shows, as outlines in its pictures or beside them, and a plot of all of them.
struct OtherRuns {
  std::optional<std::filesystem::path> ghost;
  std::vector<std::string> beside;
  std::optional<std::string> plot;  ///< below the film
  std::string names;  ///< of the run and those beside it, separated by commas; empty: of their files

  void addTo(const CommandLine& command);
  /// The ghost, if there is one, and those beside; the latter, and the run itself, are shown alike. Tables of
  /// poses are of the run's scene if none is given. InputError for what is no run, or has none of its boxes.
  std::vector<Trajectory> read(Run& run, const SceneOfTable& scene) const;
  /// What a film shows of what was read. InputError for an unknown plot.
  ShownBesides shown(const std::vector<Trajectory>& others) const;
};

}  // namespace careen
