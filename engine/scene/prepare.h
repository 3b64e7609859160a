#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "physics/start/overlap.h"
#include "scene/scene.h"
#include "stage/run_setup.h"

namespace careen {

/// What a run has in place of the scene's own.
struct RunOverrides {
  std::optional<Method> method = {};
  std::optional<double> dt = {};         ///< [s]
  std::optional<double> tolerance = {};  ///< [m]
  std::optional<double> duration = {};   ///< [s]
  bool allowOverlap = false;             ///< first move boxes apart that overlap at the start
  std::optional<int> threads = {};       ///< of large crowds, instead of one for each core
  std::uint64_t most = kMostRecords;     ///< segments and impacts
  std::string sign = {};                 ///< before the names of the above in messages: "--" of options
};

/// Is told what replaces a value that the scene has otherwise.
using Overridden =
    std::function<void(const char* name, const std::string& given, const std::string& inScene)>;

/// A run that can begin.
struct PreparedRun {
  RunSetup setup;
  Parted parted;  ///< boxes that were moved apart
};

/// Applies the overrides, checks that boxes start apart or moves them, and that the steps are not too many.
/// InputError if an override is no positive number or the method does not use it, boxes overlap and may not,
/// or the number of steps or threads is out of bounds.
PreparedRun prepare(
    Scene scene, const RunOverrides& overrides, const Overridden& tell = [](const auto&...) {});

}  // namespace careen
