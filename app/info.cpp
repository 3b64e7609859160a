#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/system/file.h"
#include "report.h"
#include "run.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "sweep/family.h"

namespace careen {
namespace {

// "joint        knee: hinge between lid and crate, from -0.5 to 2.25 rad"
template <class Named>
void printJoints(const std::vector<Joint>& joints, const std::vector<Named>& boxes) {
  constexpr std::size_t kMost = 32;
  const auto nameOf = [&](const JointEnd& end) {
    return end.body ? printableName(boxes[static_cast<std::size_t>(*end.body)].name) : "the world";
  };
  for (std::size_t i = 0; i < joints.size() && i < kMost; ++i) {
    const Joint& joint = joints[i];
    std::cout << "joint        " << printableName(joint.name) << ": "
              << kJointKindNames.at(static_cast<std::size_t>(joint.kind)) << " between " << nameOf(joint.from)
              << " and " << nameOf(joint.to);
    if (joint.lowest > -Joint::kFree || joint.highest < Joint::kFree) {
      std::cout << ", from " << brief(joint.lowest) << " to " << brief(joint.highest)
                << (joint.kind == Joint::Kind::kHinge ? " rad" : " m");
    }
    if (joint.length > 0) {
      std::cout << ", " << brief(joint.length) << " m long";
    }
    const bool turns = joint.kind == Joint::Kind::kHinge;
    if (joint.grip > 0 && joint.keptRate == 0) {
      std::cout << ", friction " << brief(joint.grip) << (turns ? " N m" : " N");
    } else if (joint.grip > 0) {
      std::cout << ", driven at " << brief(joint.keptRate) << (turns ? " rad/s" : " m/s") << " by up to "
                << brief(joint.grip) << (turns ? " N m" : " N");
    }
    if (joint.until < Joint::kFree) {
      std::cout << ", until " << brief(joint.until) << " s";
    }
    std::cout << '\n';
  }
  if (joints.size() > kMost) {
    std::cout << "             and " << joints.size() - kMost << " more\n";
  }
}

void printScene(const Scene& scene) {
  const Plan items = plan(scene);
  printPlan(std::cout, scene.name, scene.boxes.size(), scene.settings, items);
  printJoints(scene.joints, scene.boxes);
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
  printJoints(run.trajectory.world.joints, run.trajectory.world.bodies);
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
