#include "other_runs.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/names.h"
#include "core/system/file.h"
#include "parsed.h"

namespace careen {
namespace {

// A table is one of the same scene.
Trajectory readOther(const char* option, const std::filesystem::path& path, const SceneOfTable& scene,
                     const Trajectory& run) {
  if (!isRun(path)) {
    static_cast<void>(readFile(path));  // tells if it is not there
    throw InputError(std::string(option) + ": found " + path.string() +
                     ", expected a trajectory file or a table of poses");
  }
  return readRun(path, scene, [&run] { return static_cast<const RunSetup&>(run); });
}

Trajectory readGhost(const std::filesystem::path& path, const SceneOfTable& scene, const Trajectory& run) {
  Trajectory ghost = readOther("--ghost", path, scene, run);
  const auto isInRun = [&run](const Body& body) {
    return !isImmovable(body.mass) &&
           std::any_of(run.world.bodies.begin(), run.world.bodies.end(),
                       [&body](const Body& other) { return other.name == body.name; });
  };
  if (std::none_of(ghost.world.bodies.begin(), ghost.world.bodies.end(), isInRun)) {
    throw InputError("--ghost: found no box in " + path.string() +
                     " that the film shows too, expected a run of the same boxes");
  }
  return ghost;
}

std::vector<std::string> namesOf(const OtherRuns& others, const Run& run) {
  std::vector<std::string> names = {run.source.stem().string()};
  for (const std::string& each : others.beside) {
    names.push_back(std::filesystem::path(each).stem().string());
  }
  if (others.names.empty()) {
    return names;
  }
  std::vector<std::string> given;
  std::istringstream list(others.names);
  for (std::string name; std::getline(list, name, ',');) {
    given.push_back(name);
  }
  if (given.size() != names.size()) {
    throw InputError("--names: found " + std::to_string(given.size()) + ", expected " +
                     std::to_string(names.size()) + ", one for each run");
  }
  return given;
}

}  // namespace

void OtherRuns::addTo(const CommandLine& command) {
  const CommandOption besideThese = command.add(
      "--beside", beside,
      "Other runs (trajectory files or tables of poses), shown beside this one with the same camera, in "
      "step; the film is so many times as wide");
  command.add("--names", names, "Their names, such as 1997,exact (default: those of the files)")
      .needs(besideThese);
  command.add("--plot", plot,
              "A plot below, which grows with the film: energy, speed (of the fastest box) or distance (of "
              "the box that is farthest from where it is in the first run)");
  const CommandOption outlines = command.add(
      "--ghost", ghost,
      "Another run of these boxes (trajectory file or table of poses): drawn as outlines, with the distance");
  outlines.excludes(besideThese);
}

std::vector<Trajectory> OtherRuns::read(Run& run, const SceneOfTable& scene) const {
  std::vector<Trajectory> others;
  if (ghost) {
    others.push_back(readGhost(*ghost, scene, run.trajectory));
  }
  if (beside.empty()) {
    return others;
  }
  const std::vector<std::string> shown = namesOf(*this, run);
  for (const std::string& path : beside) {
    others.push_back(readOther("--beside", path, scene, run.trajectory));
  }
  showFirst(run.trajectory, shown.front());
  for (std::size_t k = 0; k < others.size(); ++k) {
    try {
      showBeside(others[k], run.trajectory, shown[k + 1]);
    } catch (const InputError& error) {
      throw InputError("--beside: " + beside[k] + ": " + error.what());
    }
  }
  return others;
}

ShownBesides OtherRuns::shown(const std::vector<Trajectory>& others) const {
  ShownBesides shown;
  if (plot) {
    shown.plot = parsed("--plot", *plot, [](const std::string& name) {
      return static_cast<PlotQuantity>(indexAmong(name, kPlotQuantities));
    });
  }
  if (shown.plot == PlotQuantity::kDistance && beside.empty()) {
    throw InputError("--plot: found distance, expected --beside, the runs whose distance it is");
  }
  for (const Trajectory& each : others) {
    if (ghost) {
      shown.ghost = &each;
    } else {
      shown.beside.push_back(&each);
    }
  }
  return shown;
}

}  // namespace careen
