#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace careen {

/// FNV-1a, 64 bits: the same bytes give the same value on every machine. It distinguishes runs; it does not
/// protect against forgery.
class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      addByte(static_cast<unsigned char>(byte));
    }
  }
  /// Little-endian bytes on every machine. A double is hashed by its bits: −0 differs from 0.
  void add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) {
      addByte(static_cast<unsigned char>(value >> shift));
    }
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }

  std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  void addByte(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3U; }

  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace careen
