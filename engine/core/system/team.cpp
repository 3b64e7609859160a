#include "core/system/team.h"

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

void Team::runTogether(const Piece& piece) {
  piece_ = piece;
  if (threads_.empty()) {
    errors_.resize(static_cast<std::size_t>(size_));
    for (int i = 1; i < size_; ++i) {
      threads_.emplace_back([this, i] { help(i); });
    }
  }
  busy_.store(size_ - 1, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  doParts(0);
  for (int looks = 0; busy_.load(std::memory_order_acquire) != 0; ++looks) {
    pauseAfter(looks);
  }
  std::exception_ptr first;
  for (std::exception_ptr& error : errors_) {
    first = first ? first : error;
    error = nullptr;
  }
  if (first) {
    std::rethrow_exception(first);
  }
}

void Team::doParts(int first) noexcept {
  try {
    for (int part = first; part < piece_.parts; part += size_) {
      piece_.call(piece_.work, part);
    }
  } catch (...) {
    errors_[static_cast<std::size_t>(first)] = std::current_exception();
  }
}

void Team::help(int first) {
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
    doParts(first);
    busy_.fetch_sub(1, std::memory_order_release);
  }
}

}  // namespace careen
