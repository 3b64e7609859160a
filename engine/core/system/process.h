#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace careen {

/// Open files that become the standard streams of another program.
struct ProgramStreams {
  int input = -1;
  int log = -1;     ///< standard error
  int output = -1;  ///< −1: discarded
};

/// Starts another program, found through PATH. Returns 0, or the error number if it could not be started. The
/// program gets its own process group, because this program handles Ctrl-C, and inherits none of this
/// program's blocked signals. It starts in `folder` if one is named.
int startProgram(std::vector<std::string> command, const ProgramStreams& streams, pid_t& process,
                 const std::filesystem::path& folder = {});

/// The end of an open log file, which holds the cause of a failure.
std::string tailOf(int file);

/// Runs a program to its end without input, in `folder` if one is named. MachineError with the end of its log
/// if it cannot be started or fails.
void runProgram(const std::vector<std::string>& command, const std::filesystem::path& folder = {});

}  // namespace careen
