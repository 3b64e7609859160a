#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

namespace careen {

/// One end of a line between two processes. Messages arrive whole and in order.
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
  /// For poll: readable when there is a message, or nobody at the other end.
  int descriptor() const { return socket_; }
  /// To the other end it is as if this one were gone.
  void hangUp() const;

 private:
  bool sendBytes(std::span<const std::byte> bytes) const;
  bool receiveBytes(std::span<std::byte> bytes) const;

  int socket_;
};

/// How a worker ended.
struct WorkerEnd {
  std::string fault;       ///< empty if it came to its end, else such as "killed by signal 9 (Killed)"
  double coreSeconds = 0;  ///< [s] that it took of all cores
};

/// A process forked to do part of the work: it begins with all that this one has in memory, at no cost. It
/// keeps SIGINT and SIGTERM back, for to end it orderly is up to this process, and is killed when this one
/// dies. No thread may hold a lock that the work takes.
class Worker {
 public:
  /// The other process ends when `work`, which must not throw, returns. MachineError if the system makes
  /// none.
  explicit Worker(const std::function<void(const Channel&)>& work);
  /// Hangs up and waits for its end.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  Worker(Worker&&) = delete;
  Worker& operator=(Worker&&) = delete;

  const Channel& channel() const { return *channel_; }
  /// Hangs up and waits for its end.
  const WorkerEnd& end();

 private:
  std::unique_ptr<Channel> channel_;
  pid_t process_ = 0;  // 0: ended
  WorkerEnd end_;
};

}  // namespace careen
