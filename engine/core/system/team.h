#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace careen {

/// Makes it `value` where that is more. Several threads may at once: in any order, the same comes of it.
inline void raiseTo(double& most, double value) {
  const std::atomic_ref shared(most);
  for (double before = shared.load(); value > before && !shared.compare_exchange_weak(before, value);) {
  }
}

/// Threads that do parts of one piece of work, again and again, thousands of times a second. Their number
/// must not show in what comes of it: parts touch nothing in common.
class Team {
 public:
  /// So many threads, the caller's one of them; the others start with the first work for them.
  explicit Team(int threads) : size_(threads), left_(static_cast<std::size_t>(threads)) {}
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  Team(Team&&) = delete;
  Team& operator=(Team&&) = delete;

  int size() const { return size_; }

  /// What a thread does between two looks at whether there is news, of which it has had that many: work
  /// follows so fast that to sleep would take longer, but another thread may need the core.
  static void pause(int looks);

  /// Calls work(part) for parts 0 to `parts` − 1, at most kMostParts, and returns when all are done. Each
  /// thread has parts of its own, of any two pieces about the same share of them, so what it writes stays in
  /// its cache; who is done with them takes from the others' last ones: threads that have no core to begin a
  /// part on are not waited for. Rethrows the error of the first part that threw, then. Not to be called by
  /// `work`.
  template <class Work>
  void run(int parts, const Work& work) {
    if (size_ <= 1 || parts <= 1) {
      for (int part = 0; part < parts; ++part) {
        work(part);
      }
      return;
    }
    runTogether(
        &work, [](const void* of, int part) { (*static_cast<const Work*>(of))(part); }, parts);
  }

  /// Into how many ranges share() divides 0 to `count`: more than threads, as some take longer than others;
  /// one, if it is short.
  int ranges(std::size_t count) const { return size_ <= 1 || count < kFew ? 1 : kRanges * size_; }
  /// Calls work(first, last) for these ranges.
  template <class Work>
  void share(std::size_t count, const Work& work) {
    const auto parts = static_cast<std::size_t>(ranges(count));
    run(ranges(count), [&](int part) {
      const auto k = static_cast<std::size_t>(part);
      work(count * k / parts, count * (k + 1) / parts);
    });
  }
  /// The same; returns the largest of 0 and what work(first, last) gives.
  template <class Work>
  double largest(std::size_t count, const Work& work) {
    double largest = 0;
    share(count, [&](std::size_t first, std::size_t last) { raiseTo(largest, work(first, last)); });
    return largest;
  }

 private:
  static constexpr int kMostParts = 0xffff;
  static constexpr std::size_t kFew = 256;  // that it costs more to share than to do
  static constexpr int kRanges = 4;
  using Call = void (*)(const void* work, int part);
  struct alignas(64) Left {  // of a thread's parts: round << 32 | first << 16 | end
    std::atomic<std::uint64_t> parts = 0;
  };
  void runTogether(const void* work, Call call, int parts);
  void doParts(std::size_t thread) noexcept;
  void doPartsOf(std::size_t owner, bool fromFirst) noexcept;
  void help(std::size_t thread);

  int size_;
  // The present piece of work. What is read of it is of one piece if a part of it can be taken after that.
  std::atomic<const void*> work_ = nullptr;
  std::atomic<Call> call_ = nullptr;
  std::vector<Left> left_;                // by thread
  std::atomic<std::uint32_t> round_ = 0;  // pieces given out
  std::atomic<int> done_ = 0;             // parts
  std::mutex mutex_;                      // of the error
  std::exception_ptr error_;
  int errorIn_ = 0;  // part
  std::atomic<bool> ends_ = false;
  std::vector<std::jthread> threads_;  // the last member: they use the others
};

}  // namespace careen
