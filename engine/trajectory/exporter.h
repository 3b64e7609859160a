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
/// What a table has rows of.
enum class ExportTable { kPoses, kForces };
struct ExportSettings {
  double within = 1e-4;     ///< [m] of positions, [rad] of attitudes
  double every = 1.0 / 60;  ///< [s]
  ExportTable table = ExportTable::kPoses;
  std::string program = {};  ///< name and version
};

/// Lines that tell the user what was written.
using ExportNotes = std::vector<std::string>;

/// A kind of file that a run is written as: one constant in a source of its own, named in the list of
/// exchange/exporters.h.
struct Exporter {
  std::string_view suffix;
  std::string_view about;  ///< as the command's help says it
  ExportOption option = ExportOption::kNone;
  ExportNotes (*write)(const Trajectory& run, const ExportSettings& settings, const TextSink& sink) = nullptr;
};

}  // namespace careen
