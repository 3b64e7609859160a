#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace careen {

/// Starts another program, found through PATH, with `input` as its standard input and `log` as its standard
/// error; its standard output is discarded. Returns 0, or the error number if it could not be started. The
/// program gets its own process group, because this program handles Ctrl-C, and inherits none of this
/// program's blocked signals. It starts in `folder` if one is named.
int startProgram(std::vector<std::string> command, int input, int log, pid_t& process,
                 const std::filesystem::path& folder = {});

/// The end of an open log file, which holds the cause of a failure.
std::string tailOf(int file);

/// Runs a program to its end without input, in `folder` if one is named. MachineError with the end of its log
/// if it cannot be started or fails.
void runProgram(const std::vector<std::string>& command, const std::filesystem::path& folder = {});

}  // namespace careen
