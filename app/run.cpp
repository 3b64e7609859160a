#include "run.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/resource.h"
#include "physics/method.h"
#include "scene/scene_reader.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// The scene file says one thing, the command line another: the user should see which one counts.
template <class T>
void announce(const char* what, const T& given, const T& inFile) {
  if (given != inFile) {
    std::cerr << "careen: " << what << " " << given << " from the command line (the scene says " << inFile
              << ")\n";
  }
}

double positive(const char* option, double value) {
  if (!(value > 0 && std::isfinite(value))) {
    throw InputError(std::string(option) + ": found " + std::to_string(value) +
                     ", expected a positive number of seconds");
  }
  return value;
}

void apply(const Overrides& overrides, Scene& scene) {
  if (overrides.method) {
    const std::optional<Method> method = methodNamed(*overrides.method);
    if (!method) {
      std::string known;
      for (const NamedMethod& each : kMethods) {
        known += (known.empty() ? "" : ", ") + std::string(each.name);
      }
      throw InputError("--method: found '" + *overrides.method + "', expected one of: " + known);
    }
    announce("method", methodName(*method), methodName(scene.method));
    scene.method = *method;
  }
  if (overrides.dt && !hasSteps(scene.method)) {
    throw InputError("--dt: found " + std::to_string(*overrides.dt) + ", but method " +
                     std::string(methodName(scene.method)) + " takes no steps; expected no --dt");
  }
  if (overrides.dt) {
    announce("dt", positive("--dt", *overrides.dt), scene.dt);
    scene.dt = *overrides.dt;
  }
  if (overrides.duration) {
    announce("duration", positive("--duration", *overrides.duration), scene.duration);
    scene.duration = *overrides.duration;
  }
}

Run simulateText(const std::filesystem::path& path, const std::string& text, const Overrides& overrides,
                 const std::stop_token& stop) {
  Run run;
  run.source = path;
  run.scene = parseScene(text, path.string());
  apply(overrides, run.scene);
  run.plan = plan(run.scene);
  const Stopwatch stopwatch;
  run.trajectory =
      record(assemble(run.scene, run.plan),
             {.method = run.scene.method, .duration = run.scene.duration, .dt = run.scene.dt}, text, stop);
  run.simulateSeconds = stopwatch.seconds();
  return run;
}

}  // namespace

void Overrides::addTo(CLI::App& command) {
  command.add_option("--method", method, "Method of motion in place of the scene's");
  command.add_option("--dt", dt, "Step in place of the scene's [s]");
  command.add_option("--duration", duration, "Length of the run in place of the scene's [s]");
}

std::filesystem::path defaultScene() { return findResource("assets/scenes/careen.json"); }

Run simulateScene(const std::filesystem::path& path, const Overrides& overrides,
                  const std::stop_token& stop) {
  return simulateText(path, readFile(path), overrides, stop);
}

Run loadRun(const std::filesystem::path& path, const std::stop_token& stop) {
  const std::string bytes = readFile(path);
  if (!looksLikeTrajectory(bytes)) {
    return simulateText(path, bytes, {}, stop);
  }
  Run run;
  run.source = path;
  run.trajectory = decodeTrajectory(bytes, path.string());
  run.scene = parseScene(run.trajectory.sceneText, path.string() + " (its scene)");
  // The run may have been made with another method, step or length than the file says.
  run.scene.method = run.trajectory.settings.method;
  run.scene.dt = run.trajectory.settings.dt;
  run.scene.duration = run.trajectory.settings.duration;
  run.plan = plan(run.scene);
  return run;
}

}  // namespace careen
