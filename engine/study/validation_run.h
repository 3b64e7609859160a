#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "scene/scene.h"
#include "study/validation_page.h"

namespace careen {

/// Measured tosses, and what is made of them.
struct ValidationTask {
  Scene scene;
  std::vector<PoseTable> measured;  ///< one for each toss; their files' names differ
  MeasuredStart start = MeasuredStart::kFitted;
  std::optional<Parameter> swept;  ///< none: only with the scene's values
  std::vector<double> values;      ///< of it, ascending
  std::filesystem::path folder;    ///< gets tables, page, plots and runs
  bool plots = true;               ///< by gnuplot
  std::string program;             ///< name and version
};

/// Is told what is finished.
struct ValidationTold {
  std::function<void(const Toss&, double size)> toss;
  std::function<void(const SweepPoint&, double size)> point;
};

/// Simulates every toss with the scene's values, keeps these runs, and then all of them with each value of
/// what is swept. Throws as validate() does.
Validation runValidation(const ValidationTask& task, const ValidationTold& tell,
                         const std::stop_token& stop = {});

}  // namespace careen
