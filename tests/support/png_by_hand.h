#pragma once

#include <libdeflate.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

inline std::string bigEndianBytes(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<char>(value >> shift & 0xffU));
  }
  return bytes;
}

inline std::string pngChunk(std::string_view type, std::string_view body) {
  const std::string checked = std::string(type) + std::string(body);
  return bigEndianBytes(static_cast<std::uint32_t>(body.size())) + checked +
         bigEndianBytes(libdeflate_crc32(0, checked.data(), checked.size()));
}

inline std::string zlibStream(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> writer(
      libdeflate_alloc_compressor(6), libdeflate_free_compressor);
  std::string stream(libdeflate_zlib_compress_bound(writer.get(), bytes.size()), '\0');
  stream.resize(
      libdeflate_zlib_compress(writer.get(), bytes.data(), bytes.size(), stream.data(), stream.size()));
  return stream;
}

/// A PNG assembled for a test, of any kind in the format, directly from the specification.
struct PngByHand {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int bits = 8;
  int color = 2;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha
  bool interlaced = false;
  std::string before{};  ///< chunks between header and data
  std::string rows{};    ///< each with its filter number, as input of the compression

  std::string header() const {
    std::string body = bigEndianBytes(width) + bigEndianBytes(height);
    body += static_cast<char>(bits);
    body += static_cast<char>(color);
    body += std::string(2, '\0');
    body += interlaced ? '\1' : '\0';
    return pngChunk("IHDR", body);
  }
  std::string bytes() const {
    return "\x89PNG\r\n\x1a\n" + header() + before + pngChunk("IDAT", zlibStream(rows)) +
           pngChunk("IEND", "");
  }
};

}  // namespace careen
