#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "core/error.h"

namespace CLI {
class App;
}

namespace careen {

/// How two things are compared, as the command line says it.
struct CompareOptions {
  std::string threshold = "same-picture";
  std::optional<double> fail, failPercent, hardFail, warn, warnPercent, hardWarn;
  std::optional<double> changedPercent, edgePercent, ssim, windowSsim;
  std::string motion = "same";
  std::optional<double> until;  ///< [s]
  bool flip = false;
  std::optional<int> threads;
  std::vector<std::string> only;  ///< frames by their names; empty: all there are
  std::filesystem::path report;   ///< folder; empty: none

  /// All but --threads, which is another thing to a command that draws.
  void addTo(CLI::App& command);
  /// InputError: what can be found wrong before anything is compared.
  ComparisonSettings settings() const;
};

/// Compares, tells what was found on the standard output, and writes the report if one is asked for.
ExitCode compareAndTell(const std::filesystem::path& expected, const std::filesystem::path& actual,
                        const CompareOptions& options, bool logsFrames, const std::stop_token& stop,
                        Comparison* found = nullptr);

}  // namespace careen
