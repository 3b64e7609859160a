#include "image/png.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "image/deflate_writer.h"
#include "image/row_filter.h"

namespace {

struct Free {
  void operator()(unsigned char* memory) const { std::free(memory); }
};
using Buffer = std::unique_ptr<unsigned char, Free>;  // stb gives what malloc made

}  // namespace

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

void appendBigEndian(std::string& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<char>(value >> shift & 0xffU));
  }
}

/// Appends a chunk: PNG specification, 5.3. What is in it is appended between the beginning and finish().
class Chunk {
 public:
  Chunk(std::string& bytes, std::string_view type) : bytes_(&bytes), begun_(bytes.size()) {
    bytes.append(4, '\0');
    bytes += type;
  }
  void finish() {
    const std::string_view checked = std::string_view(*bytes_).substr(begun_ + 4);
    const std::uint32_t checksum = libdeflate_crc32(0, checked.data(), checked.size());
    std::string length;
    appendBigEndian(length, static_cast<std::uint32_t>(checked.size() - 4));
    bytes_->replace(begun_, length.size(), length);
    appendBigEndian(*bytes_, checksum);
  }

 private:
  std::string* bytes_;
  std::size_t begun_;
};

// The pixels as a zlib stream, RFC 1950. Every row gets the Paeth filter: of filters for a whole picture it
// makes most rendered frames smallest. The best of three for every row would save up to 7 %, and all three
// would have to be tried.
void appendPixels(std::string& bytes, const Picture& picture) {
  constexpr std::size_t kPiece = std::size_t{1} << 18U;
  constexpr std::uint8_t kPaeth = 4;
  constexpr std::string_view kZlibHeader = "\x78\x01";
  const std::size_t rowBytes = picture.rowBytes();
  const auto height = static_cast<std::size_t>(picture.height);
  const std::size_t rowsOfPiece = std::clamp<std::size_t>(kPiece / (rowBytes + 1), 1, height);
  std::vector<std::uint8_t> piece(rowsOfPiece * (rowBytes + 1));
  const std::vector<std::uint8_t> nothing(rowBytes);
  std::span<const std::uint8_t> above(nothing);
  std::uint32_t checksum = 1;
  bytes += kZlibHeader;
  DeflateWriter deflate(bytes);
  for (std::size_t row = 0; row < height;) {
    std::size_t used = 0;
    for (const std::size_t end = std::min(row + rowsOfPiece, height); row < end; ++row) {
      const std::span pixels(picture.rgb.data() + row * rowBytes, rowBytes);
      piece[used] = kPaeth;
      subtractPaeth(pixels, above, {piece.data() + used + 1, rowBytes});
      above = pixels;
      used += rowBytes + 1;
    }
    checksum = libdeflate_adler32(checksum, piece.data(), used);
    deflate.write({piece.data(), used}, row == height);
  }
  appendBigEndian(bytes, checksum);
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
  std::string bytes(kSignature);
  Chunk header(bytes, "IHDR");
  appendBigEndian(bytes, static_cast<std::uint32_t>(picture.width));
  appendBigEndian(bytes, static_cast<std::uint32_t>(picture.height));
  bytes.append({8, 2, 0, 0, 0});  // 8-bit RGB, nothing special
  header.finish();
  Chunk data(bytes, "IDAT");
  appendPixels(bytes, picture);
  data.finish();
  bytes += kEnd;
  return bytes;
}

void checkPng(std::string_view bytes, const std::string& name) {
  if (const char* fault = faultOf(bytes)) {
    throw InputError(name + ": " + fault);
  }
}

Picture decodePng(std::string_view bytes, const std::string& name) {
  checkPng(bytes, name);
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

bool isWholePng(const std::filesystem::path& path, int width, int height) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) {
    return false;
  }
  const std::string bytes = readFile(path);
  return faultOf(bytes) == nullptr && bytes.size() >= kHeaderBytes &&
         std::cmp_equal(bigEndian(std::string_view(bytes).substr(16)), width) &&
         std::cmp_equal(bigEndian(std::string_view(bytes).substr(20)), height);
}

}  // namespace careen
