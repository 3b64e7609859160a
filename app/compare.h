#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "core/error.h"
#include "run_options.h"

namespace careen {

class CommandLine;

/// Options of a comparison, as given on the command line.
struct CompareOptions {
  std::string threshold = "same-picture";
  std::vector<std::string> allowed;  ///< numbers in place of the threshold's: "fail=0.1" and so on
  std::string motion = "same";
  std::optional<double> until;       ///< [s]
  std::vector<std::string> ignored;  ///< rectangles and masks
  bool flip = false;
  std::optional<int> threads;
  std::set<std::string> only;  ///< frames by name; empty: all

  /// Adds all options but --threads, which has another meaning for a command that draws.
  void addTo(const CommandLine& command);
  /// InputError for everything that can be found wrong before the comparison.
  ComparisonSettings settings() const;
};

/// Prints the result in words and, if `logsFrames`, as one line of JSON per frame. Words go to standard
/// output, or to standard error if the JSON goes to standard output.
void tell(const Comparison& comparison, bool logsFrames);

ExitCode exitCodeOf(const Comparison& comparison);

}  // namespace careen
