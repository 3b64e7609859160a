#include "trajectory/compression.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace careen {
namespace {

constexpr int kLevel = 1;
constexpr int kStored = 0;

std::string compressedAt(int level, std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) {
    throw std::bad_alloc();
  }
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

}  // namespace

std::string compressed(std::string_view bytes) {
  std::string out = compressedAt(kLevel, bytes);
  return bytes.size() / kMostRatio > out.size() ? compressedAt(kStored, bytes) : out;
}

std::optional<std::string> decompressed(std::string_view bytes, std::size_t size) {
  if (size / kMostRatio > bytes.size()) {
    return std::nullopt;
  }
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor) {
    throw std::bad_alloc();
  }
  std::string out(size, '\0');
  // Without an output for the actual size, libdeflate accepts the exact size only.
  const libdeflate_result result = libdeflate_zlib_decompress(decompressor.get(), bytes.data(), bytes.size(),
                                                              out.data(), out.size(), nullptr);
  return result == LIBDEFLATE_SUCCESS ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace careen
