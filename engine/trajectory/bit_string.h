#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace careen {

/// Numbers of up to 64 bits, one after another, the lowest bit first.
class BitWriter {
 public:
  /// The value has no more bits than that.
  void put(std::uint64_t value, int width) {
    held_ |= value << count_;
    if (count_ + width < kHeld) {
      count_ += width;
      return;
    }
    append(bytes_, kHeld);
    held_ = count_ == 0 ? 0 : value >> (kHeld - count_);
    count_ += width - kHeld;
  }
  std::string bytes() const {
    std::string all = bytes_;
    append(all, count_);
    return all;
  }

 private:
  static constexpr int kHeld = 64;
  void append(std::string& bytes, int bits) const {
    for (int done = 0; done < bits; done += 8) {
      bytes.push_back(static_cast<char>(held_ >> done));
    }
  }

  std::string bytes_;
  std::uint64_t held_ = 0;
  int count_ = 0;  // of bits that are held, less than all
};

class BitReader {
 public:
  explicit BitReader(std::string_view bytes) : bytes_(bytes) {}

  /// What is beyond the end is 0.
  std::uint64_t get(int width) {
    std::uint64_t value = 0;
    const std::size_t first = at_ / 8;
    const int skipped = static_cast<int>(at_ % 8);
    const int count = (skipped + width + 7) / 8;
    constexpr std::size_t kWord = sizeof(value);
    if (std::endian::native == std::endian::little && first + kWord < bytes_.size()) {
      std::memcpy(&value, bytes_.data() + first, kWord);
      value >>= skipped;
      if (count > static_cast<int>(kWord)) {
        value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[first + kWord]))
                 << (64 - skipped);
      }
      at_ += static_cast<std::size_t>(width);
      return width < 64 ? value & ((std::uint64_t{1} << width) - 1) : value;
    }
    for (int k = 0; k < count && first + static_cast<std::size_t>(k) < bytes_.size(); ++k) {
      const std::uint64_t byte = static_cast<unsigned char>(bytes_[first + static_cast<std::size_t>(k)]);
      value |= k == 0 ? byte >> skipped : byte << (8 * k - skipped);
    }
    at_ += static_cast<std::size_t>(width);
    return width < 64 ? value & ((std::uint64_t{1} << width) - 1) : value;
  }
  /// More was asked for than there is.
  bool isBeyond() const { return at_ > 8 * bytes_.size(); }
  /// Nothing is left but what fills the last byte.
  bool atEnd() const { return at_ + 8 > 8 * bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;  // [bits]
};

}  // namespace careen
