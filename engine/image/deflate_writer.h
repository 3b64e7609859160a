#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace careen {

/// A fast DEFLATE compressor (RFC 1951) for filtered pixels: each piece has its own Huffman codes, and the
/// only matches are runs of one byte. After a filter, this gets most of the possible compression; text would
/// stay large. A piece that would not shrink is stored, so the output is at most 5 bytes per 65,535 input
/// bytes (or part of them) larger.
class DeflateWriter {
 public:
  /// Appends to `out`, which must live until the last piece is written.
  explicit DeflateWriter(std::string& out) : out_(&out) {}

  /// Writes the next piece; the last one ends the stream. About 256 KiB each is best: the codes fit the data,
  /// and the piece still fits a core's cache. Less than 2 GiB.
  void write(std::span<const std::uint8_t> bytes, bool last);

 private:
  void store(std::span<const std::uint8_t> bytes, bool last);

  std::string* out_;
  std::uint64_t pending_ = 0;  // bits of an incomplete byte, lowest first
  unsigned pendingBits_ = 0;   // less than 8
  std::vector<std::uint16_t> tokens_;
};

}  // namespace careen
