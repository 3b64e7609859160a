#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace careen {

/// Starts another program, found as a shell would find it, with `input` as its standard input and `log` as
/// its standard error; what it prints is dropped. 0, or the error number if it could not be started. It gets
/// a group of its own, for Ctrl-C at the terminal is this program's to deal with, and none of the signals
/// that this program keeps back.
int startProgram(std::vector<std::string> command, int input, int log, pid_t& process);

/// The end of what was written to an open file: there the cause is.
std::string lastWords(int file);

/// Runs a program to its end without input. MachineError with its last words if it cannot be started or
/// fails.
void runProgram(const std::vector<std::string>& command);

}  // namespace careen
