#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "physics/motion/motion.h"

namespace careen {

struct Segment {
  double start = 0;  ///< [s]
  Motion motion;
};

/// Segments of a body in order of time. Those of a run that is computed are packed as they come, steps of
/// crowds in a third of the memory or less, and none of their bits is lost. So they are given out by value;
/// what is changed afterwards has them all as they are.
class Segments {
 public:
  class Iterator;
  using value_type = Segment;
  using const_iterator = Iterator;

  Segments() = default;
  Segments(std::vector<Segment> list) : last_(std::move(list)) {}
  Segments(std::initializer_list<Segment> list) : last_(list) {}

  std::size_t size() const { return kBlock * blocks_.size() + last_.size(); }
  bool empty() const { return size() == 0; }
  Segment operator[](std::size_t index) const;
  Segment front() const { return (*this)[0]; }
  Segment back() const { return (*this)[size() - 1]; }
  inline Iterator begin() const;
  inline Iterator end() const;
  /// How many begin no later than that time [s].
  std::size_t countUntil(double time) const;
  /// All, of a run that is not packed.
  const std::vector<Segment>& unpacked() const { return last_; }

  void add(const Segment& segment) { last_.push_back(segment); }
  /// Adds one, and packs those before once they are enough.
  void addPacked(const Segment& segment);
  /// All as they are, to be changed.
  std::vector<Segment>& open();

 private:
  static constexpr std::size_t kBlock = 8;
  struct Block {
    double start = 0;          // [s]
    std::uint64_t serial = 0;  // no other block in the process has it
    std::size_t times = 0;     // bytes that are times
    std::string bytes;
    std::vector<Segment> plain;  // instead, where they cannot be packed
  };
  void pack();
  static std::vector<Segment> listOf(const Block& block);
  static const std::vector<Segment>& segmentsOf(const Block& block);

  std::vector<Block> blocks_;
  std::vector<Segment> last_;
};

class Segments::Iterator {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = Segment;
  using difference_type = std::ptrdiff_t;
  using reference = Segment;
  struct Pointer {
    Segment segment;
    const Segment* operator->() const { return &segment; }
  };
  using pointer = Pointer;

  Iterator() = default;
  Iterator(const Segments& of, std::size_t at) : of_(&of), at_(static_cast<std::ptrdiff_t>(at)) {}
  Segment operator*() const { return (*of_)[static_cast<std::size_t>(at_)]; }
  Pointer operator->() const { return {**this}; }
  Iterator& operator+=(std::ptrdiff_t by) {
    at_ += by;
    return *this;
  }
  Iterator& operator++() { return *this += 1; }
  Iterator& operator--() { return *this += -1; }
  std::ptrdiff_t operator-(const Iterator& other) const { return at_ - other.at_; }
  bool operator==(const Iterator& other) const { return at_ == other.at_; }

 private:
  const Segments* of_ = nullptr;
  std::ptrdiff_t at_ = 0;
};

inline Segments::Iterator Segments::begin() const { return {*this, 0}; }
inline Segments::Iterator Segments::end() const { return {*this, size()}; }

/// Motion of one body: segments in order of time, the first at 0.
struct Track {
  Segments segments;
};

}  // namespace careen
