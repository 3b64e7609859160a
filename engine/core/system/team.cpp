#include "core/system/team.h"

#include <utility>

namespace careen {
namespace {

// What a thread does between two looks at whether there is news: pieces follow each other so fast that to
// sleep would take longer, but another thread may need the core.
constexpr int kPauses = 64;    // some 5 µs
constexpr int kYields = 1024;  // some 0.5 ms, then it sleeps

void pauseAfter(int looks) {
#if defined(__x86_64__)
  if (looks < kPauses) {
    __builtin_ia32_pause();
    return;
  }
#endif
  std::this_thread::yield();
}

}  // namespace

Team::~Team() {
  ends_ = true;
  ++round_;
  round_.notify_all();
}

void Team::runTogether(const void* work, Call call, int parts) {
  if (threads_.empty()) {
    for (int i = 1; i < size_; ++i) {
      threads_.emplace_back([this] { help(); });
    }
  }
  work_.store(work, std::memory_order_relaxed);
  call_.store(call, std::memory_order_relaxed);
  parts_.store(parts, std::memory_order_relaxed);
  done_.store(0, std::memory_order_relaxed);
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  next_.store(std::uint64_t{round} << 32U, std::memory_order_release);
  round_.store(round, std::memory_order_release);
  round_.notify_all();
  doParts();
  for (int looks = 0; done_.load(std::memory_order_acquire) != parts; ++looks) {
    pauseAfter(looks);
  }
  if (error_) {
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

void Team::doParts() noexcept {
  std::uint64_t next = next_.load(std::memory_order_acquire);
  while (true) {
    const void* const work = work_.load(std::memory_order_relaxed);
    const Call call = call_.load(std::memory_order_relaxed);
    const int part = static_cast<int>(next & 0xffffffffU);
    if (part >= parts_.load(std::memory_order_relaxed)) {
      return;
    }
    if (!next_.compare_exchange_weak(next, next + 1, std::memory_order_acq_rel, std::memory_order_acquire)) {
      continue;
    }
    ++next;
    try {
      call(work, part);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_ || part < errorIn_) {
        error_ = std::current_exception();
        errorIn_ = part;
      }
    }
    done_.fetch_add(1, std::memory_order_release);
  }
}

void Team::help() {
  std::uint32_t done = 0;
  while (true) {
    std::uint32_t round = round_.load(std::memory_order_acquire);
    for (int looks = 0; round == done && looks < kPauses + kYields; ++looks) {
      pauseAfter(looks);
      round = round_.load(std::memory_order_acquire);
    }
    if (round == done) {
      round_.wait(done, std::memory_order_acquire);
      continue;
    }
    if (ends_) {
      return;
    }
    done = round;
    doParts();
  }
}

}  // namespace careen
