#include "study/validation_run.h"

#include <string>

#include "core/system/file.h"
#include "study/study.h"
#include "trajectory/trajectory_file.h"

namespace careen {

Validation runValidation(const ValidationTask& task, const ValidationTold& tell,
                         const std::stop_token& stop) {
  const RunSetup setup = setupOfMeasured(task.scene);
  Validation found{.program = task.program,
                   .scene = task.scene.name,
                   .size = sizeOf(setup.world),
                   .tosses = {},
                   .swept = task.swept,
                   .sweep = {},
                   .sceneValue = {}};
  ValidationSettings settings{.start = task.start};
  makeFolder(task.folder / "runs");
  for (const PoseTable& table : task.measured) {
    Trajectory run;
    found.tosses.push_back(validate(setup, table, settings, stop, &run));
    tell.toss(found.tosses.back(), found.size);
    const std::string name = std::filesystem::path(table.name).stem().string();
    saveTrajectory(run, task.folder / "runs" / (name + ".careen"));
  }
  if (task.swept) {
    found.sceneValue = valueOf(setup.world, *task.swept);
    settings.floorRuns = 0;
    for (const double value : task.values) {
      settings.setting = Setting{.parameter = *task.swept, .value = value};
      std::vector<Toss> tosses;
      for (const PoseTable& table : task.measured) {
        tosses.push_back(validate(setup, table, settings, stop));
      }
      found.sweep.push_back({.value = value,
                             .place = spreadOf(tosses, &Toss::meanPlace).mean,
                             .attitude = spreadOf(tosses, &Toss::meanAttitude).mean});
      tell.point(found.sweep.back(), found.size);
    }
    writeFile(task.folder / "sweep.csv", sweepCsv(found.sweep, *task.swept));
  }
  writeFile(task.folder / "results.csv", tossesCsv(found.tosses, found.size));
  writeFile(task.folder / "errors.csv", errorsCsv(found.tosses));
  writeFile(task.folder / "report.json", validationJson(found));
  const std::vector<std::string> plots =
      task.plots ? drawValidation(found, task.folder / "plots") : std::vector<std::string>{};
  writeFile(task.folder / "index.html", validationPage(found, plots));
  return found;
}

}  // namespace careen
