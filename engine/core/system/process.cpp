#include "core/system/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

#include "core/error.h"
#include "core/system/cleanup.h"

namespace careen {

int startProgram(std::vector<std::string> command, const ProgramStreams& streams, pid_t& process,
                 const std::filesystem::path& folder) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& argument : command) {
    arguments.push_back(argument.data());
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, streams.input, STDIN_FILENO);
  if (streams.output >= 0) {
    posix_spawn_file_actions_adddup2(&files, streams.output, STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  posix_spawn_file_actions_adddup2(&files, streams.log, STDERR_FILENO);
  if (!folder.empty()) {
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

std::string tailOf(int file) {
  constexpr off_t kMost = 1500;
  const off_t size = lseek(file, 0, SEEK_END);
  std::array<char, kMost> text{};
  const ssize_t got = pread(file, text.data(), text.size(), std::max<off_t>(0, size - kMost));
  std::string_view tail(text.data(), static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  tail = tail.substr(0, tail.find_last_not_of(" \n") + 1);
  return std::string(tail);
}

void runProgram(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int log = memfd_create("log", MFD_CLOEXEC);
  pid_t process = 0;
  const int error = startProgram(command, {.input = nothing, .log = log}, process, folder);
  int status = 0;
  if (error == 0) {
    const Cleanup cleanup([process] { kill(-process, SIGKILL); });
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
  }
  const std::string tail = tailOf(log);
  close(nothing);
  close(log);
  if (error != 0) {
    throw MachineError("cannot start " + command.front() + ": " + std::strerror(error));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw MachineError(command.front() + " failed" + (tail.empty() ? "" : ": " + tail));
  }
}

}  // namespace careen
