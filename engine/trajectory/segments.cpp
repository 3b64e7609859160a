#include "trajectory/segments.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <string_view>

#include "trajectory/packed_steps.h"

namespace careen {
namespace {

// Of blocks that a thread has unpacked last: one for each track, of neighbouring ones.
constexpr std::uint64_t kSlots = 1 << 14;

bool beginsAfter(double time, const Segment& segment) { return time < segment.start; }

}  // namespace

Segment Segments::operator[](std::size_t index) const {
  const std::size_t block = index / kBlock;
  return block < blocks_.size() ? segmentsOf(blocks_[block])[index % kBlock]
                                : last_[index - kBlock * blocks_.size()];
}

std::size_t Segments::countUntil(double time) const {
  const auto count = [time](const std::vector<Segment>& list) {
    return static_cast<std::size_t>(std::upper_bound(list.begin(), list.end(), time, beginsAfter) -
                                    list.begin());
  };
  if (!last_.empty() && last_.front().start <= time) {
    return kBlock * blocks_.size() + count(last_);
  }
  const auto next = std::upper_bound(blocks_.begin(), blocks_.end(), time,
                                     [](double t, const Block& block) { return t < block.start; });
  const auto before = static_cast<std::size_t>(next - blocks_.begin());
  return before == 0 ? 0 : kBlock * (before - 1) + count(segmentsOf(blocks_[before - 1]));
}

void Segments::addPacked(const Segment& segment) {
  if (last_.size() == kBlock) {
    pack();
  }
  add(segment);
}

std::vector<Segment>& Segments::open() {
  if (!blocks_.empty()) {
    std::vector<Segment> all(begin(), end());
    blocks_.clear();
    last_ = std::move(all);
  }
  return last_;
}

void Segments::pack() {
  static std::atomic<std::uint64_t> serial = 0;
  Block& block = blocks_.emplace_back();
  block.start = last_.front().start;
  block.serial = ++serial * kSlots + std::hash<const Segments*>{}(this) / sizeof(Segments) % kSlots;
  StepPacker steps(last_);
  if (std::all_of(last_.begin(), last_.end(), [&](const Segment& each) { return steps.add(each); })) {
    block.times = steps.times().size();
    block.bytes = steps.times() + steps.bits();
    block.bytes.shrink_to_fit();
    last_.clear();
  } else {
    block.plain = std::move(last_);
    last_ = {};
  }
}

std::vector<Segment> Segments::listOf(const Block& block) {
  const std::string_view bytes = block.bytes;
  StepUnpacker steps(bytes.substr(0, block.times), bytes.substr(block.times));
  std::vector<Segment> list(kBlock);
  for (Segment& segment : list) {
    steps.next(segment);
  }
  return list;
}

// Who asks for one asks for the next, or for those of other bodies at that time.
const std::vector<Segment>& Segments::segmentsOf(const Block& block) {
  struct Slot {
    std::uint64_t serial = 0;
    std::vector<Segment> list;
  };
  if (!block.plain.empty()) {
    return block.plain;
  }
  thread_local std::vector<Slot> slots(kSlots);
  Slot& slot = slots[block.serial % kSlots];
  if (slot.serial != block.serial) {
    slot.list = listOf(block);
    slot.serial = block.serial;
  }
  return slot.list;
}

}  // namespace careen
