#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stop_token>
#include <string>

#include "compare/comparison.h"
#include "core/error.h"

namespace CLI {
class App;
}

namespace careen {

/// How two things are compared, as the command line says it.
struct CompareOptions {
  std::string threshold = "same-picture";
  std::map<std::string, double> limits;  ///< in place of the threshold's, by option: "--fail" and so on
  std::string motion = "same";
  std::optional<double> until;  ///< [s]
  bool flip = false;
  std::optional<int> threads;
  std::set<std::string> only;  ///< frames by their names; empty: all there are

  /// All but --threads, which is another thing to a command that draws.
  void addTo(CLI::App& command);
  /// InputError: what can be found wrong before anything is compared.
  ComparisonSettings settings() const;
};

/// Two pictures, two folders of frames, or two runs. InputError if they are not of one kind.
Comparison compare(const std::filesystem::path& expected, const std::filesystem::path& actual,
                   const ComparisonSettings& settings, const std::stop_token& stop);

/// Tells what was found, in words, and in lines of JSON, one for each frame, if so wanted. Words go to the
/// standard output, or to the standard error where JSON has that.
void tell(const Comparison& comparison, bool logsFrames);

ExitCode exitCodeOf(const Comparison& comparison);

}  // namespace careen
