#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace careen {

/// Compresses filtered pixels to DEFLATE (RFC 1951), quickly: Huffman codes made for each piece, and of
/// repeats only runs of one byte. That is most of what is to be had after a filter; text would remain large.
/// A piece that gets no smaller is stored: the whole is at most 5 bytes for each begun 65,535 of a piece
/// larger.
class DeflateWriter {
 public:
  /// Appends to `out`, which must stay until the last piece.
  explicit DeflateWriter(std::string& out) : out_(&out) {}

  /// The next piece; the last one ends the stream. Some 256 KiB each is best: codes fit what is there, and
  /// pieces still fit a core's cache. Less than 2 GiB.
  void write(std::span<const std::uint8_t> bytes, bool last);

 private:
  void store(std::span<const std::uint8_t> bytes, bool last);

  std::string* out_;
  std::uint64_t pending_ = 0;  // bits of a byte not yet full, the first lowest
  unsigned pendingBits_ = 0;   // less than 8
  std::vector<std::uint16_t> tokens_;
};

}  // namespace careen
