#pragma once

#include <stdexcept>
#include <string>

namespace careen {

/// What the process says to its caller when it ends.
enum class ExitCode : int {
  kDone = 0,
  kDifferent = 1,      ///< frames or states differ
  kBadInput = 2,       ///< bad usage or bad input
  kMachineFailed = 3,  ///< no GL, disk full
  kNumbersFailed = 4,  ///< a check in the engine did not hold
};

/// Every failure the engine reports; `main` alone catches it.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// What the user gave cannot be used: says where, what was found and what was expected.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitCode::kBadInput, message) {}
};

/// The machine cannot do it: disk, library, memory.
class MachineError : public Error {
 public:
  explicit MachineError(const std::string& message) : Error(ExitCode::kMachineFailed, message) {}
};

/// The method cannot go on, or a result failed its check.
class NumericalError : public Error {
 public:
  explicit NumericalError(const std::string& message) : Error(ExitCode::kNumbersFailed, message) {}
};

/// The user asked for the run to end (SIGINT, SIGTERM). No fault, so no Error: whatever was begun is undone
/// on the way out.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace careen
