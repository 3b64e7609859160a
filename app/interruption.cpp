#include "interruption.h"

#include <pthread.h>
#include <unistd.h>

#include <ctime>
#include <string>
#include <system_error>

#include "core/system/cleanup.h"

namespace careen {
namespace {

// [s] A command may end in its own way for so long; somebody who asked it to stop waits no longer.
constexpr timespec kPatience = {.tv_sec = 0, .tv_nsec = 700'000'000};

const int kWake = SIGRTMIN;  // from the destructor

bool isIgnored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

std::atomic<const char*> interruptionHint = "";

}  // namespace

void setInterruptionHint(const char* hint) { interruptionHint = hint; }

void tellInterruption() {
  const std::string message = std::string("careen: interrupted") + interruptionHint.load() + "\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
}

Interruption::Interruption() {
  sigemptyset(&signals_);
  sigaddset(&signals_, kWake);
  for (const int signal : {SIGINT, SIGTERM}) {
    if (!isIgnored(signal)) {  // a shell ignores them for its background jobs
      sigaddset(&signals_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  try {
    waiter_ = std::thread([this] { wait(); });
  } catch (const std::system_error&) {  // no threads here: signals do what they always did
    pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
  }
}

Interruption::~Interruption() {
  if (!waiter_.joinable()) {
    return;
  }
  over_ = true;
  pthread_kill(waiter_.native_handle(), kWake);
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
  sigtimedwait(&signals_, nullptr, &kPatience);  // until the end, a second signal, or the end of patience
  if (!over_) {
    endNow(signal);
  }
}

void Interruption::endNow(int signal) {
  cleanUpToEnd();
  tellInterruption();
  std::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
  std::raise(signal);
}

}  // namespace careen
