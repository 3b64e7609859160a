#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "core/system/cleanup.h"

namespace careen {

/// One end of a connection between two processes. Messages arrive whole and in order.
class Channel {
 public:
  explicit Channel(int socket) : socket_(socket) {}
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  Channel(Channel&&) = delete;
  Channel& operator=(Channel&&) = delete;

  /// False if the other end is gone.
  template <class Message>
  bool send(const Message& message) const {
    static_assert(std::is_trivially_copyable_v<Message>);
    return sendBytes(std::as_bytes(std::span(&message, 1)));
  }
  /// Waits for a message; false if the other end is gone.
  template <class Message>
  bool receive(Message& message) const {
    static_assert(std::is_trivially_copyable_v<Message>);
    return receiveBytes(std::as_writable_bytes(std::span(&message, 1)));
  }
  /// For poll: readable when there is a message or the other end is gone.
  int descriptor() const { return socket_; }
  /// The other end sees the connection as closed.
  void shutDown() const;

 private:
  bool sendBytes(std::span<const std::byte> bytes) const;
  bool receiveBytes(std::span<std::byte> bytes) const;

  int socket_;
};

/// How a worker ended.
struct WorkerEnd {
  std::string fault;       ///< empty if it finished, else for example "killed by signal 9 (Killed)"
  double coreSeconds = 0;  ///< [s] CPU time that it used
};

/// A forked process that does part of the work: it starts with a copy-on-write view of this process's memory.
/// SIGINT and SIGTERM are blocked in it; this process ends it in order, and it is killed if this process
/// dies. No thread may hold a lock that the work needs.
class Worker {
 public:
  /// The other process ends when `work`, which must not throw, returns. MachineError if the system cannot
  /// create it.
  explicit Worker(const std::function<void(const Channel&)>& work);
  /// Shuts the connection down and waits for the end of the process.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  Worker(Worker&&) = delete;
  Worker& operator=(Worker&&) = delete;

  const Channel& channel() const { return *channel_; }
  /// Shuts the connection down and waits for the end of the process.
  const WorkerEnd& end();

 private:
  std::unique_ptr<Channel> channel_;
  pid_t process_ = 0;  // 0: ended
  WorkerEnd end_;
  std::optional<Cleanup> cleanup_;
};

}  // namespace careen
