#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "stage/run_setup.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Is told, in a sentence, what a user should know of a file: that a table's clock began elsewhere, that a
/// model has what a scene cannot say.
using Notice = std::function<void(const std::string&)>;

/// A scene's text, and its name in messages.
struct SceneText {
  std::string text;
  std::string name;
};

/// Whether the file is a model of MuJoCo, by its name.
bool isMujocoModel(const std::filesystem::path& path);
/// Whether a file of these bytes, its first 1024 at least, is a table of poses.
bool isTable(const std::filesystem::path& path, const std::string& bytes);
/// Whether it is a run: a trajectory, or a table of poses.
bool isRun(const std::filesystem::path& path, const std::string& bytes);
/// Likewise, of a file that is there to be read again: what has come through a pipe is gone then.
bool isTable(const std::filesystem::path& path);
bool isRun(const std::filesystem::path& path);

/// The scene that a file has: its bytes, or, of a model of MuJoCo (.xml), the scene that it is.
SceneText sceneTextOf(const std::filesystem::path& path, const std::string& bytes, const Notice& notice);

/// What a run of this scene starts from, by method exact, which models all of it.
RunSetup setupOfScene(const std::filesystem::path& scene, const Notice& notice);

/// How a file that is a run is read.
struct RunReading {
  /// Of a table of poses: its boxes' sizes and masses, its walls. Of a trajectory: how it is shown.
  std::optional<std::filesystem::path> scene = {};
  bool shiftsTime = false;  ///< a table's first row is at 0 s
  Notice notice = [](const std::string&) {};
};

/// Reads a trajectory file of any version: what an incomplete one lacks is made from the scene text in it. Or
/// a table of poses, with its scene, or else with the setup that `setup` gives; a trajectory is then shown as
/// it is. InputError for a table without either.
Trajectory readRun(const std::filesystem::path& path, const std::string& bytes, const RunReading& reading,
                   const std::function<RunSetup()>& setup = {});
Trajectory readRun(const std::filesystem::path& path, const RunReading& reading,
                   const std::function<RunSetup()>& setup = {});

}  // namespace careen
