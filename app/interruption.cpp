#include "interruption.h"

#include <pthread.h>

namespace careen {

Interruption::Interruption() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  waiter_ = std::thread([this] { wait(); });
}

Interruption::~Interruption() {
  over_ = true;
  pthread_kill(waiter_.native_handle(), SIGINT);
  waiter_.join();
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
}

// sigwait instead of a handler: any code may run here, almost none in a signal handler.
void Interruption::wait() {
  int signal = 0;
  sigwait(&signals_, &signal);
  if (over_) {
    return;
  }
  signal_ = signal;
  source_.request_stop();
  sigwait(&signals_, &signal);
  if (over_) {
    return;
  }
  std::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
  std::raise(signal);
}

}  // namespace careen
