#pragma once

#include <functional>
#include <stop_token>

#include "core/error.h"

namespace CLI {
class App;
}

namespace careen {

/// The command chosen on the command line; runs until done or asked to stop.
using Command = std::function<ExitCode(const std::stop_token&)>;

// Each adds one command with its options to the command line; parsing sets `chosen`.
void addRender(CLI::App& commandLine, Command& chosen);
void addSimulate(CLI::App& commandLine, Command& chosen);
void addCompare(CLI::App& commandLine, Command& chosen);
void addInfo(CLI::App& commandLine, Command& chosen);
void addStudy(CLI::App& commandLine, Command& chosen);
void addVerify(CLI::App& commandLine, Command& chosen);
void addView(CLI::App& commandLine, Command& chosen);

}  // namespace careen
