#include "runs/source.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/system/file.h"
#include "exchange/import_mjcf.h"
#include "physics/world/method.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "scene/shown_as.h"
#include "trajectory/given_run.h"
#include "trajectory/pose_table.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// Enough of a file to tell what it is.
std::string beginningOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string begin(1024, '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  return begin;
}

// A clock that began elsewhere, such as that of Unix, would be taken for a scene that lasts so long.
PoseTable readTable(const std::string& bytes, const std::string& name, const RunReading& reading,
                    double duration) {
  PoseTable table = readPoseTable(bytes, name);
  if (reading.shiftsTime) {
    table.beginAtZero();
    return table;
  }
  const double first = table.firstTime();
  if (first > duration) {
    throw InputError(name + ": found a first row at " + inFull(first) +
                     " s, expected one within the scene's " + inFull(duration) +
                     " s; --shift-time counts from the first row");
  }
  const auto last = std::max_element(table.rows.begin(), table.rows.end(),
                                     [](const PoseRow& a, const PoseRow& b) { return a.time < b.time; });
  if (first > last->time - first) {
    reading.notice(name + ": its first row is at " + inFull(first) +
                   " s; until then the boxes go there from where the scene has them; --shift-time counts "
                   "from the first row");
  }
  return table;
}

}  // namespace

bool isMujocoModel(const std::filesystem::path& path) { return path.extension() == ".xml"; }

bool isTable(const std::filesystem::path& path, const std::string& bytes) {
  return !isMujocoModel(path) && !looksLikeTrajectory(bytes) && looksLikePoseTable(bytes, path.string());
}

bool isRun(const std::filesystem::path& path, const std::string& bytes) {
  return looksLikeTrajectory(bytes) || isTable(path, bytes);
}

bool isTable(const std::filesystem::path& path) { return isTable(path, beginningOf(path)); }

bool isRun(const std::filesystem::path& path) { return isRun(path, beginningOf(path)); }

SceneText sceneTextOf(const std::filesystem::path& path, const std::string& bytes, const Notice& notice) {
  if (!isMujocoModel(path)) {
    return {.text = bytes, .name = path.string()};
  }
  ImportedScene imported = importMjcf(bytes, path.string());
  for (const std::string& each : imported.notes) {
    notice(path.string() + ": " + each);
  }
  return {.text = std::move(imported.text), .name = path.string() + " (its scene)"};
}

RunSetup setupOfScene(const std::filesystem::path& scene, const Notice& notice) {
  const auto [text, name] = sceneTextOf(scene, readFile(scene), notice);
  Scene read = parseScene(text, name, Starts::kMayOverlap);
  read.settings.method = Method::kExact;
  return setupOf(read);
}

Trajectory readRun(const std::filesystem::path& path, const RunReading& reading,
                   const std::function<RunSetup()>& setup) {
  return readRun(path, readFile(path), reading, setup);
}

Trajectory readRun(const std::filesystem::path& path, const std::string& bytes, const RunReading& reading,
                   const std::function<RunSetup()>& setup) {
  if (isTable(path, bytes)) {
    if (!reading.scene && !setup) {
      throw InputError(path.string() +
                       ": is a table of poses, without sizes and walls; expected --scene with the scene");
    }
    RunSetup start = reading.scene ? setupOfScene(*reading.scene, reading.notice) : setup();
    const PoseTable table = readTable(bytes, path.string(), reading, start.settings.duration);
    return givenRun(std::move(start), table);
  }
  Trajectory run = decodeTrajectory(bytes, path.string());
  if (reading.scene && !setup) {
    const auto [text, name] = sceneTextOf(*reading.scene, readFile(*reading.scene), reading.notice);
    showAs(run, text, name);
  }
  return run;
}

}  // namespace careen
