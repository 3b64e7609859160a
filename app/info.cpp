#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "core/system/file.h"
#include "report.h"
#include "run.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

ExitCode infoCommand(std::filesystem::path path, const std::stop_token& stop) {
  if (path.empty()) {
    path = defaultScene();
  }
  const std::string bytes = readFile(path);
  if (!looksLikeTrajectory(bytes)) {
    const Scene scene = parseScene(bytes, path.string());
    printPlan(std::cout, scene.name, scene.boxes.size(), settingsOf(scene), plan(scene));
    return ExitCode::kDone;
  }
  Run run = loadRun(path, {}, stop);
  auditRun(run, {.keepGoing = true}, stop);  // what is broken is told below
  printPlan(std::cout, run.trajectory);
  printError(std::cout, run);
  std::size_t segments = 0;
  for (const Track& track : run.trajectory.tracks) {
    segments += track.segments.size();
  }
  std::cout << "trajectory   " << bytes.size() << " bytes, " << segments << " segments\n"
            << "scene hash   " << run.trajectory.sceneHash() << '\n';
  return run.audit.breaches.empty() ? ExitCode::kDone : ExitCode::kNumbersFailed;
}

}  // namespace

void addInfo(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("info", "What a scene's run models, what it leaves out, and why");
  const auto path = std::make_shared<std::filesystem::path>();
  command.add("file", *path, "Scene or trajectory file; the default scene if none is named");
  command.runs([path](const std::stop_token& stop) { return infoCommand(*path, stop); });
}

}  // namespace careen
