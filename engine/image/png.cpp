#include "image/png.h"

#include <libdeflate.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "core/error.h"
#include "core/file.h"

namespace {

struct Free {
  void operator()(unsigned char* memory) const { std::free(memory); }
};
using Buffer = std::unique_ptr<unsigned char, Free>;  // stb takes and gives what malloc made

// What stb would do with its own compressor in seven times the time. Level 1: higher ones cost much and save
// little.
unsigned char* compress(const unsigned char* data, int size, int* compressedSize) {
  constexpr int kLevel = 1;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) {
    return nullptr;
  }
  const auto length = static_cast<std::size_t>(size);
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), length);
  Buffer out(static_cast<unsigned char*>(std::malloc(bound)));
  if (!out || bound > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return nullptr;
  }
  const std::size_t used = libdeflate_zlib_compress(compressor.get(), data, length, out.get(), bound);
  *compressedSize = static_cast<int>(used);
  return used == 0 ? nullptr : out.release();
}

}  // namespace

#define STBIW_ZLIB_COMPRESS(data, size, compressedSize, quality) compress(data, size, compressedSize)
#define STBIW_CRC32(data, size) libdeflate_crc32(0, data, static_cast<std::size_t>(size))
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

namespace careen {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
constexpr std::size_t kHeaderBytes = 24;  // signature, then the header chunk as far as width and height

std::uint32_t bigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) {
    value = value << 8U | static_cast<unsigned char>(byte);
  }
  return value;
}

// stb passes over the checksums; a damaged frame would be read as one of other pixels.
const char* faultOf(std::string_view bytes) {
  if (!bytes.starts_with(kSignature)) {
    return "is no PNG";
  }
  for (bytes.remove_prefix(kSignature.size()); bytes.size() >= 12;) {
    const std::size_t length = bigEndian(bytes);
    if (length > bytes.size() - 12) {
      break;
    }
    const std::string_view checked = bytes.substr(4, 4 + length);
    if (libdeflate_crc32(0, checked.data(), checked.size()) != bigEndian(bytes.substr(8 + length))) {
      return "is a damaged PNG: a checksum is wrong";
    }
    if (checked.starts_with("IEND")) {
      return nullptr;
    }
    bytes.remove_prefix(12 + length);
  }
  return "is a PNG cut short";
}

void append(void* text, void* bytes, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

}  // namespace

std::string encodePng(const Picture& picture) {
  const std::size_t rows = static_cast<std::size_t>(picture.height) * (picture.rowBytes() + 1);
  if (picture.width < 1 || picture.height < 1 ||
      picture.rgb.size() != picture.rowBytes() * static_cast<std::size_t>(picture.height) ||
      rows > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 2) {
    throw InputError("a picture of " + std::to_string(picture.width) + " x " +
                     std::to_string(picture.height) + " cannot be written as PNG");
  }
  std::string bytes;
  if (stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3, picture.rgb.data(),
                             static_cast<int>(picture.rowBytes())) == 0) {
    throw std::bad_alloc();
  }
  return bytes;
}

Picture decodePng(std::string_view bytes, const std::string& name) {
  if (const char* fault = faultOf(bytes)) {
    throw InputError(name + ": " + fault);
  }
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InputError(name + ": is too large a PNG");
  }
  Picture picture;
  int channels = 0;
  const Buffer pixels(stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                            static_cast<int>(bytes.size()), &picture.width, &picture.height,
                                            &channels, 3));
  if (!pixels) {
    throw InputError(name + ": cannot be read as PNG: " + stbi_failure_reason());
  }
  picture.rgb.assign(pixels.get(),
                     pixels.get() + picture.rowBytes() * static_cast<std::size_t>(picture.height));
  return picture;
}

Picture readPng(const std::filesystem::path& path) { return decodePng(readFile(path), path.string()); }

void writePng(const std::filesystem::path& path, const Picture& picture) {
  writeFile(path, encodePng(picture));
}

bool looksWhole(const std::filesystem::path& path, int width, int height) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, kHeaderBytes> head{};
  std::array<char, kEnd.size()> tail{};
  stream.read(head.data(), head.size());
  stream.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  stream.read(tail.data(), tail.size());
  const std::string_view header(head.data(), head.size());
  return stream.good() && header.starts_with(kSignature) &&
         std::cmp_equal(bigEndian(header.substr(16)), width) &&
         std::cmp_equal(bigEndian(header.substr(20)), height) &&
         std::string_view(tail.data(), tail.size()) == kEnd;
}

}  // namespace careen
