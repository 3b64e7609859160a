#include "core/system/team.h"

#include <utility>

namespace careen {
namespace {

constexpr int kPauses = 64;    // some 5 µs
constexpr int kYields = 1024;  // some 0.5 ms, then it sleeps

}  // namespace

void Team::pause([[maybe_unused]] int looks) {
#if defined(__x86_64__)
  if (looks < kPauses) {
    __builtin_ia32_pause();
    return;
  }
#endif
  std::this_thread::yield();
}

Team::~Team() {
  ends_ = true;
  ++round_;
  round_.notify_all();
}

void Team::runTogether(const void* work, Call call, int parts) {
  if (threads_.empty()) {
    for (std::size_t i = 1; i < left_.size(); ++i) {
      threads_.emplace_back([this, i] { help(i); });
    }
  }
  work_.store(work, std::memory_order_relaxed);
  call_.store(call, std::memory_order_relaxed);
  done_.store(0, std::memory_order_relaxed);
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  const auto all = static_cast<std::size_t>(parts);
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const std::size_t first = all * i / left_.size();
    const std::size_t end = all * (i + 1) / left_.size();
    left_[i].parts.store(std::uint64_t{round} << 32U | first << 16U | end, std::memory_order_release);
  }
  round_ = round;  // a full fence: that there is nobody to wake must not be found before
  round_.notify_all();
  doParts(0);
  for (int looks = 0; done_.load(std::memory_order_acquire) != parts; ++looks) {
    pause(looks);
  }
  if (error_) {
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

void Team::doParts(std::size_t thread) noexcept {
  doPartsOf(thread, true);
  for (std::size_t i = 1; i < left_.size(); ++i) {
    doPartsOf((thread + i) % left_.size(), false);
  }
}

void Team::doPartsOf(std::size_t owner, bool fromFirst) noexcept {
  std::atomic<std::uint64_t>& left = left_[owner].parts;
  std::uint64_t seen = left.load(std::memory_order_acquire);
  while (true) {
    const void* const work = work_.load(std::memory_order_relaxed);
    const Call call = call_.load(std::memory_order_relaxed);
    const std::uint64_t first = seen >> 16U & 0xffffU;
    const std::uint64_t end = seen & 0xffffU;
    if (first == end) {
      return;
    }
    const std::uint64_t rest = fromFirst ? seen + (1U << 16U) : seen - 1;
    if (!left.compare_exchange_weak(seen, rest, std::memory_order_acq_rel, std::memory_order_acquire)) {
      continue;
    }
    seen = rest;
    const int part = static_cast<int>(fromFirst ? first : end - 1);
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

void Team::help(std::size_t thread) {
  std::uint32_t done = 0;
  while (true) {
    std::uint32_t round = round_.load(std::memory_order_acquire);
    for (int looks = 0; round == done && looks < kPauses + kYields; ++looks) {
      pause(looks);
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
    doParts(thread);
  }
}

}  // namespace careen
