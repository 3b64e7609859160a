#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "core/characters.h"
#include "core/system/file.h"
#include "report.h"
#include "run.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "sweep/family.h"

namespace careen {
namespace {

void printScene(const Scene& scene) {
  const Plan items = plan(scene);
  printPlan(std::cout, scene.name, scene.boxes.size(), scene.settings, items);
  printCrowds(std::cout, scene.settings, items);
}

void printFamily(const Family& family) {
  const Scene first = family.member(0).scene;
  std::cout << "family       " << printableName(first.name) << ", seed " << family.seed() << ", up to "
            << family.tries() << " tries for a start without overlap; run 0 has " << first.boxes.size()
            << (first.boxes.size() == 1 ? " box\n" : " boxes\n");
  for (const Varying& each : family.varying()) {
    std::cout << "varies       " << printableName(each.path) << ": " << each.range << '\n';
  }
  printScene(first);
}

ExitCode infoCommand(std::filesystem::path path, const SceneOfTable& ofTable, const std::stop_token& stop) {
  if (path.empty()) {
    path = defaultScene();
  }
  const std::string bytes = readFile(path);
  if (ofTable.given() == nullptr && !isRun(path)) {
    if (!isMujocoModel(path) && looksLikeFamily(bytes)) {
      printFamily(Family(bytes, path.string()));
      return ExitCode::kDone;
    }
    const auto [text, name] = sceneTextOf(path, bytes);
    const Scene scene = parseScene(text, name);
    printScene(scene);
    return ExitCode::kDone;
  }
  Run run = loadRun(path, {}, ofTable, stop);
  auditRun(run, {.keepGoing = true}, stop);  // what is broken is told below
  printPlan(std::cout, run.trajectory);
  printError(std::cout, run);
  std::size_t segments = 0;
  for (const Track& track : run.trajectory.tracks) {
    segments += track.segments.size();
  }
  std::cout << (run.trajectory.given ? "table        " : "trajectory   ") << bytes.size() << " bytes, "
            << segments << " segments\n"
            << "scene hash   " << run.trajectory.sceneHash() << '\n';
  return run.audit.breaches.empty() || run.trajectory.given ? ExitCode::kDone : ExitCode::kNumbersFailed;
}

}  // namespace

void addInfo(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("info", "What a scene's run models, what it leaves out, and why");
  struct Arguments {
    std::filesystem::path path;
    SceneOfTable scene;
  };
  const auto arguments = std::make_shared<Arguments>();
  command.add("file", arguments->path,
              "Scene (or model of MuJoCo, .xml), trajectory file or table of poses; the default scene if "
              "none is named");
  arguments->scene.addTo(command);
  command.runs([arguments](const std::stop_token& stop) {
    return infoCommand(arguments->path, arguments->scene, stop);
  });
}

}  // namespace careen
