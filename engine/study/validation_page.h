#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/validation.h"

namespace careen {

/// All that `careen validate` found.
struct Validation {
  std::string program;  ///< name and version of the program that found it
  std::string scene;    ///< its name
  double size = 1;      ///< [m] see sizeOf()
  std::vector<Toss> tosses;
  std::optional<Parameter> swept;
  std::vector<SweepPoint> sweep;
  std::optional<double> sceneValue;  ///< of the swept parameter
};

/// In words, one line each: means and spreads over all tosses, faces, the sweep's minimum and the scene's
/// value.
std::vector<std::string> summaryOf(const Validation& validation);

/// report.json
std::string validationJson(const Validation& validation);

/// Draws errors over time and the sweep into `folder`; the SVG of each, in order. MachineError if gnuplot
/// fails.
std::vector<std::string> drawValidation(const Validation& validation, const std::filesystem::path& folder);

/// A self-contained page with the plots.
std::string validationPage(const Validation& validation, const std::vector<std::string>& plots);

}  // namespace careen
