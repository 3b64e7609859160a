#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trajectory/archive.h"
#include "trajectory/bit_string.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Steps of a crowd's member in few bits, none of them lost. Their coefficients are multiples of a power of
/// two, see MergedSteps, and so are integers here; and a step begins about where the one before ended, with
/// its velocity, so that only two of its four powers say something new. Places and attitudes of each power
/// have as many bits as the largest of them needs.
class StepCoder {
 public:
  static constexpr std::size_t kNumbers = 28;
  using Numbers = std::array<std::int64_t, kNumbers>;

 protected:
  explicit StepCoder(int exponent) : exponent_(exponent) {}
  Numbers expected(double duration) const;
  void follow(double start, double duration, const Numbers& numbers);

  int exponent_;          // of the power of two
  double end_ = -1;       // [s] of the last step
  double duration_ = 0;   // [s] likewise, 0: there is none
  Numbers numbers_ = {};  // likewise
};

/// Takes a track's segments in order.
class StepPacker : public StepCoder {
 public:
  explicit StepPacker(const Segments& segments);
  /// Whether it is packed now; else it is to be stored as it is.
  bool add(const Segment& segment);
  /// Lengths, and starts that are not the end of the step before.
  const std::string& times() { return times_.bytes(); }
  std::string bits() const { return bits_.bytes(); }

 private:
  std::optional<Numbers> numbersOf(const CrowdStep& step) const;

  ArchiveWriter times_;
  BitWriter bits_;
};

/// Gives them back.
class StepUnpacker : public StepCoder {
 public:
  StepUnpacker(std::string_view times, std::string_view bits);
  enum class Next { kPacked, kAsItIs, kDamaged };
  Next next(Segment& segment);
  bool atEnd() const { return times_.empty() && bits_.atEnd(); }

 private:
  double time();

  std::string_view times_;
  BitReader bits_;
};

/// A track in files since format version 9; segments that are not packed as trajectory_format.h has them.
template <class Archive>
void visitPacked(Archive& archive, Visited<Archive, Track> track) {
  std::uint64_t count = track.segments.size();
  archive.visit(count);
  std::string times;
  std::string bits;
  if constexpr (Archive::kReads) {
    archive.visit(times);
    archive.visit(bits);
    StepUnpacker steps(times, bits);
    std::vector<Segment>& segments = track.segments.open();
    segments.reserve(std::min<std::uint64_t>(count, times.size() / sizeof(double)));
    for (std::uint64_t k = 0; k < count; ++k) {
      Segment& segment = segments.emplace_back();
      const StepUnpacker::Next next = steps.next(segment);
      if (next == StepUnpacker::Next::kAsItIs) {
        visit(archive, segment);
      } else if (next == StepUnpacker::Next::kDamaged) {
        archive.fail("is damaged: steps of a body cannot be unpacked");
      }
    }
    if (!steps.atEnd()) {
      archive.fail("has more steps of a body than pieces of motion");
    }
  } else {
    StepPacker steps(track.segments);
    std::vector<std::size_t> others;
    for (std::size_t k = 0; k < count; ++k) {
      if (!steps.add(track.segments[k])) {
        others.push_back(k);
      }
    }
    archive.visit(steps.times());
    archive.visit(steps.bits());
    for (const std::size_t k : others) {
      visit(archive, track.segments[k]);
    }
  }
}

}  // namespace careen
