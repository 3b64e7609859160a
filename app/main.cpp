#include <malloc.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "commands.h"
#include "core/error.h"
#include "core/system/standard_streams.h"
#include "interruption.h"

namespace careen {
namespace {

int exitWith(ExitCode code) { return static_cast<int>(code); }

// A negative result is a signal; the process then ends by it, so that the caller sees it.
int runCommandLine(int argc, char** argv, Interruption& interruption) {
  const CommandLine commandLine("Films rigid boxes that tumble and collide with walls.", "careen",
                                "careen " CAREEN_VERSION);
#ifdef CAREEN_RENDER
  addRender(commandLine);
#endif
  addSimulate(commandLine);
  addStudy(commandLine);
  addCompare(commandLine);
  addInfo(commandLine);
  addVerify(commandLine);
#ifdef CAREEN_RENDER
  addView(commandLine);
#endif
  commandLine.footer(
      "Exit codes: 0 done, 1 frames or states differ, 2 bad usage or bad input, 3 the machine failed,\n"
      "4 the numbers failed. 'careen COMMAND --help' tells a command's options.");
  const CommandLine::Parsed parsed = commandLine.parse(argc, argv);
  if (!parsed.command) {
    return exitWith(parsed.exitCode);
  }
  try {
    return exitWith(parsed.command(interruption.token()));
  } catch (const Interrupted&) {
    std::cerr << "careen: interrupted\n";
    return -interruption.signal();
  } catch (const Error& error) {
    std::cerr << "careen: " << error.what() << '\n';
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

}  // namespace
}  // namespace careen

int main(int argc, char** argv) {
  careen::openStandardStreams();
  careen::keepMemory();
  int result = 0;
  try {
    careen::Interruption interruption;
    result = careen::runCommandLine(argc, argv, interruption);
  } catch (const std::bad_alloc&) {
    std::cerr << "careen: out of memory\n";
    return careen::exitWith(careen::ExitCode::kMachineFailed);
  } catch (const std::exception& error) {
    std::cerr << "careen: " << error.what() << '\n';
    return careen::exitWith(careen::ExitCode::kMachineFailed);
  }
  if (result < 0) {
    std::raise(-result);
  }
  return result;
}
