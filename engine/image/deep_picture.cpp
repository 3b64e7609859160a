#include "image/deep_picture.h"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "core/system/file.h"
#include "image/color_chunks.h"

namespace careen {
namespace {

constexpr std::uint64_t kFewBytes = std::uint64_t{64} << 20U;  // of samples, whatever the file
constexpr std::uint64_t kMostInflation = 1032;  // DEFLATE cannot do more: 258 bytes of two bits

[[noreturn]] void fail(const std::string& name, const std::string& fault) {
  throw InputError(name + ": " + fault);
}

std::uint32_t bigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

/// What the chunks say that libpng does not: PNG specification, 11.
struct Chunks {
  int width = 0;
  int height = 0;
  ColorChunks colors;
  std::uint64_t dataBytes = 0;  ///< of all IDAT
};

void readHeader(Chunks& chunks, std::string_view body, const std::string& name) {
  if (body.size() != 13) {
    fail(name, "is a damaged PNG: its header has " + std::to_string(body.size()) + " bytes, not 13");
  }
  const std::uint32_t width = bigEndian(body);
  const std::uint32_t height = bigEndian(body.substr(4));
  if (width == 0 || height == 0 || std::uint64_t{width} * height > kMostPixels) {
    fail(name, "claims " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels; from 1 to 268435456 can be read");
  }
  chunks.width = static_cast<int>(width);
  chunks.height = static_cast<int>(height);
}

std::optional<std::string_view>* placeOf(ColorChunks& colors, std::string_view type) {
  return type == "cICP"   ? &colors.codePoints
         : type == "iCCP" ? &colors.profile
         : type == "sRGB" ? &colors.srgb
         : type == "gAMA" ? &colors.gamma
         : type == "cHRM" ? &colors.chromaticities
                          : nullptr;
}

Chunks readChunks(std::string_view bytes, const std::string& name) {
  Chunks chunks;
  if (!bytes.starts_with(kPngSignature)) {
    fail(name, "is no PNG");
  }
  for (bytes.remove_prefix(kPngSignature.size()); bytes.size() >= 12;) {
    const std::size_t length = bigEndian(bytes);
    if (length > bytes.size() - 12) {
      break;
    }
    const std::string_view type = bytes.substr(4, 4);
    const std::string_view body = bytes.substr(8, length);
    if (libdeflate_crc32(0, type.data(), 4 + length) != bigEndian(bytes.substr(8 + length))) {
      fail(name, "is a damaged PNG: a checksum is wrong");
    }
    if ((type == "IHDR") != (chunks.width == 0)) {
      fail(name, "is a damaged PNG: its header is not its first chunk");
    }
    if (type == "IHDR") {
      readHeader(chunks, body, name);
    } else if (std::optional<std::string_view>* const color = placeOf(chunks.colors, type)) {
      *color = body;
    } else if (type == "IDAT") {
      chunks.dataBytes += length;
    } else if (type == "IEND") {
      return chunks;
    }
    bytes.remove_prefix(12 + length);
  }
  fail(name, "is a PNG cut short");
}

void checkBytes(const DeepPicture& picture, std::uint64_t dataBytes, std::uint64_t most,
                const std::string& name) {
  const std::uint64_t bytes = std::uint64_t{picture.samples()} * (picture.deep ? 2 : 1);
  const std::string found = "has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                            " pixels, which take " + std::to_string(bytes) + " bytes";
  if (bytes > most) {
    fail(name, found + "; expected at most " + std::to_string(most) + " here");
  }
  if (bytes > std::max(kFewBytes, kMostInflation * dataBytes)) {
    fail(name, found + ", in " + std::to_string(dataBytes) + "; expected at most 64 MiB, or " +
                   std::to_string(kMostInflation) + " times as many as in the file");
  }
}

/// A picture as libpng reads it. Its errors leave it by longjmp, over no object that must be destroyed: what
/// the functions that may meet one need is kept here.
class PngReading {
 public:
  explicit PngReading(std::string_view bytes)
      : left_(bytes), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, failed, warned)) {
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw MachineError("no memory to read a PNG");
    }
    // Chunks that are not of the pixels are none of its business.
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_read_fn(png_, this, take);
  }
  PngReading(const PngReading&) = delete;
  PngReading& operator=(const PngReading&) = delete;
  ~PngReading() { png_destroy_read_struct(&png_, &info_, nullptr); }

  const std::string& error() const { return error_; }

  /// All before the pixels, which are asked for as RGB or RGBA. False on an error.
  bool begin(DeepPicture& picture) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_read_info(png_, info_);
    png_set_expand(png_);
    png_set_gray_to_rgb(png_);
    if (std::endian::native == std::endian::little) {
      png_set_swap(png_);
    }
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    picture.channels = png_get_channels(png_, info_);
    picture.deep = png_get_bit_depth(png_, info_) == 16;
    return true;
  }

  bool readRows(std::uint8_t* first, std::size_t rowBytes, std::size_t height) {
    for (std::size_t y = 0; y < height; ++y) {
      rows_.push_back(first + y * rowBytes);
    }
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_read_image(png_, rows_.data());
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  [[noreturn]] static void failed(png_structp png, png_const_charp message) {
    static_cast<PngReading*>(png_get_error_ptr(png))->error_ = message;
    png_longjmp(png, 1);
  }
  // What libpng only warns of is damage, too: bytes after the picture, a wrong checksum of all.
  static void warned(png_structp png, png_const_charp message) { failed(png, message); }
  static void take(png_structp png, png_bytep to, std::size_t size) {
    std::string_view& left = static_cast<PngReading*>(png_get_io_ptr(png))->left_;
    if (size > left.size()) {
      png_error(png, "it is cut short");
    }
    std::memcpy(to, left.data(), size);
    left.remove_prefix(size);
  }

  std::string_view left_;
  std::string error_;
  std::vector<png_bytep> rows_;
  png_structp png_;
  png_infop info_;
};

template <class Sample>
std::vector<Sample> opaque(const std::vector<Sample>& rgb) {
  std::vector<Sample> rgba;
  rgba.reserve(rgb.size() / 3 * 4);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    rgba.insert(rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], static_cast<Sample>(-1)});
  }
  return rgba;
}

}  // namespace

DeepPicture decodeDeepPng(std::string_view bytes, const std::string& name, std::uint64_t most) {
  const Chunks chunks = readChunks(bytes, name);
  DeepPicture picture{.width = chunks.width,
                      .height = chunks.height,
                      .colorSpace = colorSpaceOf(chunks.colors),
                      .samples8 = {},
                      .samples16 = {}};
  PngReading reading(bytes);
  bool read = reading.begin(picture);
  if (read) {
    checkBytes(picture, chunks.dataBytes, most, name);
    picture.samples8.resize(picture.deep ? 0 : picture.samples());
    picture.samples16.resize(picture.deep ? picture.samples() : 0);
    read = reading.readRows(
        picture.deep ? reinterpret_cast<std::uint8_t*>(picture.samples16.data()) : picture.samples8.data(),
        picture.rowSamples() * (picture.deep ? 2 : 1), static_cast<std::size_t>(picture.height));
  }
  if (!read) {
    fail(name, "is a damaged PNG: " + reading.error());
  }
  return picture;
}

PngSize checkPng(std::string_view bytes, const std::string& name) {
  const Chunks chunks = readChunks(bytes, name);
  return {.width = chunks.width, .height = chunks.height};
}

DeepPicture readDeepPng(const std::filesystem::path& path) {
  return decodeDeepPng(readFile(path), path.string());
}

PngSize sizeOfPng(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kHeader = 8 + 8 + 13;  // signature; length and type; body
  if (!bytes.starts_with(kPngSignature)) {
    fail(name, "is no PNG");
  }
  if (bytes.size() < kHeader) {
    fail(name, "is a PNG cut short");
  }
  Chunks chunks;
  readHeader(chunks, bytes.substr(16, 13), name);
  return {.width = chunks.width, .height = chunks.height};
}

std::string otherSize(const DeepPicture& expected, const DeepPicture& actual) {
  const auto sizeOf = [](const DeepPicture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
  };
  return expected.width == actual.width && expected.height == actual.height
             ? ""
             : "found a picture of " + sizeOf(actual) + " pixels, expected one of " + sizeOf(expected);
}

void requireOneSize(const DeepPicture& expected, const DeepPicture& actual) {
  if (const std::string fault = otherSize(expected, actual); !fault.empty()) {
    throw InputError(fault);
  }
}

DeepPicture deepened(const DeepPicture& picture) {
  DeepPicture result = picture;
  if (!picture.deep) {
    result.deep = true;
    result.samples8.clear();
    result.samples16.reserve(picture.samples());
    for (const std::uint8_t sample : picture.samples8) {
      result.samples16.push_back(static_cast<std::uint16_t>(sample * 257));
    }
  }
  return result;
}

DeepPicture withAlpha(const DeepPicture& picture) {
  DeepPicture result = picture;
  if (picture.channels == 3) {
    result.channels = 4;
    result.samples8 = opaque(picture.samples8);
    result.samples16 = opaque(picture.samples16);
  }
  return result;
}

}  // namespace careen
