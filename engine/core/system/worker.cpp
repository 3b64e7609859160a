#include "core/system/worker.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>

#include "core/error.h"

namespace careen {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string faultOf(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return "killed by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  }
  return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

[[noreturn]] void workAndExit(const std::function<void(const Channel&)>& work, int socket, pid_t parent) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) {  // it died before prctl took effect
    _exit(1);
  }
  try {
    const Channel channel(socket);
    work(channel);
  } catch (...) {
    std::terminate();
  }
  _exit(0);  // skips the parent's exit handlers
}

}  // namespace

Channel::~Channel() { close(socket_); }

void Channel::shutDown() const { shutdown(socket_, SHUT_RDWR); }

bool Channel::sendBytes(std::span<const std::byte> bytes) const {
  while (true) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0 || errno != EINTR) {
      return count >= 0;
    }
  }
}

bool Channel::receiveBytes(std::span<std::byte> bytes) const {
  while (true) {
    const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
    if (count >= 0 || errno != EINTR) {
      return count == static_cast<ssize_t>(bytes.size());
    }
  }
}

Worker::Worker(const std::function<void(const Channel&)>& work) {
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw MachineError(std::string("no socket to a worker process: ") + std::strerror(errno));
  }
  channel_ = std::make_unique<Channel>(ends[0]);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    workAndExit(work, ends[1], parent);
  }
  const int error = errno;
  close(ends[1]);
  if (process_ < 0) {
    throw MachineError(std::string("no worker process can be made: ") + std::strerror(error));
  }
  cleanup_.emplace([this] {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);  // it may be writing
  });
}

Worker::~Worker() { end(); }

const WorkerEnd& Worker::end() {
  channel_->shutDown();
  int status = 0;
  rusage usage{};
  while (process_ != 0) {
    if (wait4(process_, &status, 0, &usage) == process_) {
      end_ = {.fault = faultOf(status), .coreSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime)};
      process_ = 0;
    } else if (errno != EINTR) {
      end_.fault = std::string("lost: ") + std::strerror(errno);
      process_ = 0;
    }
  }
  cleanup_.reset();
  return end_;
}

}  // namespace careen
