#include "core/system/dialogue.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/system/process.h"

namespace careen {
namespace {

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Dialogue::Dialogue(const std::vector<std::string>& command) : name_(command.front()) {
  // A socket, not a pipe: send() can suppress SIGPIPE when the program has ended.
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw MachineError("no socket to " + name_ + ": " + std::strerror(errno));
  }
  ours_ = ends[0];
  log_ = memfd_create("log", MFD_CLOEXEC);
  pid_t process = 0;
  const int error = startProgram(command, {.input = ends[1], .log = log_, .output = ends[1]}, process);
  close(ends[1]);
  if (error != 0) {
    end();
    throw MachineError("cannot start " + name_ + ": " + std::strerror(error));
  }
  process_ = process;
  clock_getcpuclockid(process, &clock_);
  cleanup_.emplace([process] { kill(-process, SIGKILL); });
}

Dialogue::~Dialogue() { end(); }

std::string Dialogue::ask(const std::string& line, const std::stop_token& stop) {
  try {
    const std::stop_callback ends(stop, [process = process_.load()] {
      if (process != 0) {
        kill(-process, SIGKILL);
      }
    });
    send(line + '\n');
    return receive();
  } catch (const MachineError&) {
    end();
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    throw;
  }
}

double Dialogue::coreSeconds() const {
  timespec time{};
  return process_ != 0 && clock_gettime(clock_, &time) == 0
             ? static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)
             : taken_.load();
}

void Dialogue::send(const std::string& line) {
  for (std::string_view left = line; !left.empty();) {
    const ssize_t count = ::send(ours_, left.data(), left.size(), MSG_NOSIGNAL);
    if (count >= 0) {
      left.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      fail();
    }
  }
}

std::string Dialogue::receive() {
  std::array<char, 4096> bytes{};
  std::size_t end = received_.find('\n');
  while (end == std::string::npos) {
    const ssize_t count = recv(ours_, bytes.data(), bytes.size(), 0);
    if (count > 0) {
      received_.append(bytes.data(), static_cast<std::size_t>(count));
      end = received_.find('\n');
    } else if (count == 0 || errno != EINTR) {
      fail();
    }
  }
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

void Dialogue::fail() const {
  const std::string tail = log_ >= 0 ? tailOf(log_) : "";
  throw MachineError(name_ + " ended without an answer" + (tail.empty() ? "" : ": " + tail));
}

void Dialogue::end() {
  if (process_ != 0) {
    cleanup_.reset();
    kill(-process_, SIGKILL);
    rusage usage{};
    int status = 0;
    while (wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    taken_ = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    process_ = 0;
  }
  for (int* const file : {&ours_, &log_}) {
    if (*file >= 0) {
      close(std::exchange(*file, -1));
    }
  }
}

}  // namespace careen
