#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace careen {

/// Exit status and output of a program.
struct Ended {
  int exitCode = -1;  ///< −1: ended by `signal`
  int signal = 0;
  double coreSeconds = 0;  ///< others on the machine do not lengthen it
  std::string out;
  std::string err;
};

inline std::string textOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A temporary folder for one test, deleted with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "careen-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no temporary folder");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  /// Everything in it, hidden files too, sorted, relative.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_)) {
      names.push_back(std::filesystem::relative(entry.path(), path_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// A running program. Its output goes to files beside `folder`, so that no pipe fills up.
class Process {
 public:
  Process(const std::vector<std::string>& command, const std::filesystem::path& folder) {
    out_ = log_ / "out";
    err_ = log_ / "err";
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) {
      arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;  // which a shell ignores for its background jobs, and so for tests that run in one
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawnp(&pid_, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      throw std::runtime_error("cannot start " + command[0]);
    }
  }

  pid_t id() const { return pid_; }
  void send(int signal) const { kill(pid_, signal); }
  /// careen masks the signals that it answers at its start. Before, they would just end it.
  void waitUntilItMasks(int signal) const {
    const auto status = "/proc/" + std::to_string(pid_) + "/status";
    const auto isMasked = [&] {
      const std::string text = textOf(status);
      const std::size_t mask = text.find("SigBlk:\t");
      return mask != std::string::npos &&
             (std::stoull(text.substr(mask + 8), nullptr, 16) >> (signal - 1) & 1) != 0;
    };
    for (int tries = 0; tries < 6000 && !isMasked(); ++tries) {
      usleep(5'000);
    }
  }
  void sendOnceMasked(int signal) const {
    waitUntilItMasks(signal);
    send(signal);
  }
  /// Output so far.
  std::string outSoFar() const { return textOf(out_); }
  std::string errSoFar() const { return textOf(err_); }
  Ended wait() {
    int status = 0;
    rusage usage{};
    while (wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    Ended ended;
    ended.coreSeconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                        1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    ended.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    ended.out = textOf(out_);
    ended.err = textOf(err_);
    return ended;
  }

 private:
  TemporaryFolder log_;
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = 0;
};

}  // namespace careen
