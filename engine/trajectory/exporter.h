#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// Receives the text of a file piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// What can be asked of a file that is exported.
enum class ExportOption {
  kNone,
  kWithin,  ///< how far off it may be
  kEvery    ///< time between its rows
};
struct ExportSettings {
  double within = 0;  ///< [m, rad]
  double every = 0;   ///< [s]
  std::string program;
};

/// A kind of file that a run is written as: one constant in a source of its own, named in the list of
/// exchange/exporters.h.
struct Exporter {
  std::string_view suffix;
  std::string_view about;  ///< as the command's help says it
  ExportOption option = ExportOption::kNone;
  /// Returns lines that tell the user what was written.
  std::vector<std::string> (*write)(const Trajectory& run, const ExportSettings& settings,
                                    const TextSink& sink) = nullptr;
};

}  // namespace careen
