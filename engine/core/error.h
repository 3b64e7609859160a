#pragma once

#include <stdexcept>
#include <string>

namespace careen {

/// Exit code of the process.
enum class ExitCode : int {
  kDone = 0,
  kDifferent = 1,      ///< frames or states differ
  kBadInput = 2,       ///< bad usage or bad input
  kMachineFailed = 3,  ///< no GL, disk full
  kNumbersFailed = 4,  ///< a check in the engine failed
};

/// Every failure the engine reports; `main` alone catches it.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// User input cannot be used; the message says where, what was found and what was expected.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitCode::kBadInput, message) {}
};

/// The machine failed: disk, library, memory.
class MachineError : public Error {
 public:
  explicit MachineError(const std::string& message) : Error(ExitCode::kMachineFailed, message) {}
};

/// The method cannot continue, or a result failed its check.
class NumericalError : public Error {
 public:
  explicit NumericalError(const std::string& message) : Error(ExitCode::kNumbersFailed, message) {}
};

/// The user stopped the run (SIGINT, SIGTERM). This is no fault, hence no Error; unfinished work is undone
/// during unwinding.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace careen
