#include <malloc.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "advice.h"
#include "commands.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/standard_streams.h"
#include "interruption.h"

namespace careen {
namespace {

int exitWith(ExitCode code) { return static_cast<int>(code); }

// Messages hold names from files and the command line, which could steer a terminal.
void tell(const char* message) { std::cerr << "careen: " << printableMessage(message) << '\n'; }

// What could not be printed is lost, as on a full disk; the command has not done its work then.
int afterPrinting(int result) {
  errno = 0;
  if (std::cout.flush()) {
    return result;
  }
  const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  tell(("standard output cannot be written" + reason).c_str());
  return result < 0 ? result : exitWith(ExitCode::kMachineFailed);
}

// Ends by the signal, so that the caller sees it, also where the signal was ignored.
int endBy(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return 128 + signal;
}

#ifdef CAREEN_RENDER
// With vectors of less than 256 bits Mesa overwrites memory on processors that have 512.
void refuseNarrowVectors() {
  const char* const name = "LP_NATIVE_VECTOR_WIDTH";
  const char* const width = std::getenv(name);
  if (width != nullptr && std::atoi(width) < 256) {
    std::cerr << "careen: the environment's " << name << " of less than 256 is ignored: Mesa fails with it\n";
    unsetenv(name);
  }
}
#endif

// A negative result is a signal; the process then ends by it, so that the caller sees it.
int runCommandLine(int argc, char** argv, Interruption& interruption) {
  const CommandLine commandLine("Films rigid boxes that tumble and collide with walls.", "careen",
                                "careen " CAREEN_VERSION);
#ifdef CAREEN_RENDER
  addRender(commandLine);
#endif
  addSimulate(commandLine);
  addStudy(commandLine);
  addDice(commandLine);
  addCompare(commandLine);
  addAudit(commandLine);
  addExport(commandLine);
  addHelp(commandLine);
  addInfo(commandLine);
#ifdef CAREEN_RENDER
  addPage(commandLine);
  addSweep(commandLine, drawFilmOfRun);
#else
  addSweep(commandLine);
#endif
  addTruth(commandLine);
  addValidate(commandLine);
  addVerify(commandLine);
#ifdef CAREEN_RENDER
  addView(commandLine);
#endif
  addWhen(commandLine);
  commandLine.footer(
      "First steps: 'careen render' films the default scene into out/careen, 'careen help tutorial' goes on "
      "from\n"
      "there, and 'careen help' lists the manual.\n\n"
      "Exit codes: 0 done, 1 frames or states differ, 2 bad usage or bad input, 3 the machine failed,\n"
      "4 the result breaks a promise. 'careen COMMAND --help' tells a command's options.");
  const CommandLine::Parsed parsed = commandLine.parse(argc, argv);
  if (!parsed.command) {
    return exitWith(parsed.exitCode);
  }
  try {
    return exitWith(parsed.command(interruption.token()));
  } catch (const Interrupted&) {
    tellInterruption();
    return -interruption.signal();
  } catch (const Error& error) {
    tell(error.what());
    if (const std::string advice = adviceOn(error.what()); !advice.empty()) {
      tell(advice.c_str());
    }
    return exitWith(error.code());
  }
}

// Keeps freed memory: pictures of 1 to 10 MB are allocated all the time, and returning them to the system
// and asking for them again costs a quarter of the time of comparing frames.
void keepMemory() {
  constexpr int kOnlyLarger = 64 << 20;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, kOnlyLarger);
  mallopt(M_TRIM_THRESHOLD, kOnlyLarger);
}

std::terminate_handler usualEnd = nullptr;

// A library may allocate where it promises not to throw, as CLI11 2.6 does for every option: there is no way
// back to main() then.
[[noreturn]] void endWithoutReturn() {
  try {
    if (const std::exception_ptr cause = std::current_exception()) {
      std::rethrow_exception(cause);
    }
  } catch (const std::bad_alloc&) {
    std::cerr << "careen: out of memory\n";
    std::_Exit(exitWith(ExitCode::kMachineFailed));
  } catch (...) {  // a fault of ours
  }
  usualEnd();
  std::abort();
}

}  // namespace
}  // namespace careen

int main(int argc, char** argv) {
  careen::usualEnd = std::set_terminate(careen::endWithoutReturn);
  careen::openStandardStreams();
  careen::keepMemory();
#ifdef CAREEN_RENDER
  careen::refuseNarrowVectors();
#endif
  int result = 0;
  try {
    careen::Interruption interruption;
    result = careen::runCommandLine(argc, argv, interruption);
  } catch (const std::bad_alloc&) {
    std::cerr << "careen: out of memory\n";
    return careen::exitWith(careen::ExitCode::kMachineFailed);
  } catch (const std::exception& error) {
    careen::tell(error.what());
    return careen::exitWith(careen::ExitCode::kMachineFailed);
  }
  result = careen::afterPrinting(result);
  return result < 0 ? careen::endBy(-result) : result;
}
