#include "image/deep_picture.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/system/file.h"
#include "image/color_chunks.h"
#include "image/row_filter_undo.h"

namespace careen {
namespace {

constexpr std::uint64_t kFewBytes = std::uint64_t{64} << 20U;  // of samples, whatever the file
constexpr std::uint64_t kMostInflation = 1032;  // DEFLATE cannot do more: 258 bytes of two bits

enum ColorType : int { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgbAlpha = 6 };

[[noreturn]] void fail(const std::string& name, const std::string& fault) {
  throw InputError(name + ": " + fault);
}

int byteAt(std::string_view bytes, std::size_t place) { return static_cast<unsigned char>(bytes[place]); }

std::uint32_t bigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

/// What the chunks say: PNG specification, 11.
struct Chunks {
  int width = 0;
  int height = 0;
  int bits = 0;
  int color = 0;
  bool interlaced = false;
  std::string_view palette;
  std::optional<std::string_view> transparent;
  ColorChunks colors;
  std::string_view data;  ///< of all IDAT
  std::string joined;     ///< holds it where there are several

  std::size_t fileChannels() const {
    constexpr std::array<std::size_t, 7> kChannels{1, 0, 3, 1, 2, 0, 4};
    return kChannels.at(static_cast<std::size_t>(color));
  }
  std::size_t rowBytes(int columns) const {
    return (static_cast<std::size_t>(columns) * fileChannels() * static_cast<std::size_t>(bits) + 7) / 8;
  }
  std::size_t pixelBytes() const {
    return std::max<std::size_t>(1, fileChannels() * static_cast<std::size_t>(bits) / 8);
  }
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
  chunks.bits = byteAt(body, 8);
  chunks.color = byteAt(body, 9);
  const auto is = [&chunks](std::initializer_list<int> depths) {
    return std::find(depths.begin(), depths.end(), chunks.bits) != depths.end();
  };
  const bool known =
      (chunks.color == kGrey && is({1, 2, 4, 8, 16})) || (chunks.color == kPalette && is({1, 2, 4, 8})) ||
      ((chunks.color == kRgb || chunks.color == kGreyAlpha || chunks.color == kRgbAlpha) && is({8, 16}));
  if (!known || byteAt(body, 10) != 0 || byteAt(body, 11) != 0 || byteAt(body, 12) > 1) {
    fail(name, "is a PNG of colour type " + std::to_string(chunks.color) + " with " +
                   std::to_string(chunks.bits) + " bits, compression " + std::to_string(byteAt(body, 10)) +
                   ", filter " + std::to_string(byteAt(body, 11)) + ", interlace " +
                   std::to_string(byteAt(body, 12)) + ", which the format does not have");
  }
  chunks.interlaced = byteAt(body, 12) == 1;
}

std::optional<std::string_view>* placeOf(ColorChunks& colors, std::string_view type) {
  return type == "cICP"   ? &colors.codePoints
         : type == "iCCP" ? &colors.profile
         : type == "sRGB" ? &colors.srgb
         : type == "gAMA" ? &colors.gamma
         : type == "cHRM" ? &colors.chromaticities
                          : nullptr;
}

void takeData(Chunks& chunks, std::string_view body) {
  if (chunks.data.empty()) {
    chunks.data = body;
    return;
  }
  if (chunks.joined.empty()) {
    chunks.joined = chunks.data;
  }
  chunks.joined += body;
  chunks.data = chunks.joined;
}

/// Reads into `chunks`, which the caller keeps: `data` may point into it.
void readChunks(Chunks& chunks, std::string_view bytes, const std::string& name) {
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
    } else if (type == "PLTE") {
      chunks.palette = body;
    } else if (type == "tRNS") {
      chunks.transparent = body;
    } else if (std::optional<std::string_view>* const color = placeOf(chunks.colors, type)) {
      *color = body;
    } else if (type == "IDAT") {
      takeData(chunks, body);
    } else if (type == "IEND") {
      return;
    } else if ((byteAt(type, 0) & 0x20) == 0) {
      fail(name, "has a chunk '" + std::string(type) + "' that a reader must know, and this one does not");
    }
    bytes.remove_prefix(12 + length);
  }
  fail(name, "is a PNG cut short");
}

/// One pass of an interlaced picture, or the whole of another: PNG specification, 8.2.
struct Pass {
  int left, top, stepX, stepY;
  int columns(int width) const { return (width - left + stepX - 1) / stepX; }
  int rows(int height) const { return (height - top + stepY - 1) / stepY; }
};

std::span<const Pass> passesOf(const Chunks& chunks) {
  static constexpr std::array<Pass, 1> kWhole{{{0, 0, 1, 1}}};
  static constexpr std::array<Pass, 7> kAdam7{
      {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
  if (chunks.interlaced) {
    return kAdam7;
  }
  return kWhole;
}

std::vector<std::uint8_t> inflate(const Chunks& chunks, const std::string& name) {
  std::uint64_t size = 0;
  for (const Pass& pass : passesOf(chunks)) {
    const int columns = pass.columns(chunks.width);
    const int rows = pass.rows(chunks.height);
    if (columns > 0 && rows > 0) {
      size += static_cast<std::uint64_t>(rows) * (chunks.rowBytes(columns) + 1);
    }
  }
  if (size > kMostInflation * chunks.data.size()) {
    fail(name, "claims " + std::to_string(chunks.width) + " x " + std::to_string(chunks.height) +
                   " pixels, more than its " + std::to_string(chunks.data.size()) +
                   " bytes of data can hold");
  }
  std::vector<std::uint8_t> rows(size);
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!reader) {
    throw MachineError("no memory to read " + name);
  }
  if (libdeflate_zlib_decompress(reader.get(), chunks.data.data(), chunks.data.size(), rows.data(),
                                 rows.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    fail(name, "is a damaged PNG: its data are not those of " + std::to_string(chunks.width) + " x " +
                   std::to_string(chunks.height) + " pixels");
  }
  return rows;
}

/// Spreads the file's samples to RGB or RGBA of 8 or 16 bits.
class Spreader {
 public:
  Spreader(const Chunks& chunks, const std::string& name) : chunks_(&chunks), name_(&name) {
    const std::size_t keyBytes = chunks.color == kGrey ? 2 : chunks.color == kRgb ? 6 : 0;
    const bool paletted = chunks.color == kPalette;
    if (paletted && (chunks.palette.empty() || chunks.palette.size() % 3 != 0)) {
      fail(name, "is a damaged PNG: it has no whole palette");
    }
    if (!chunks.transparent) {
      return;
    }
    const std::size_t found = chunks.transparent->size();
    if (paletted ? found > chunks.palette.size() / 3 : keyBytes == 0 || found != keyBytes) {
      fail(name, "is a damaged PNG: its chunk tRNS does not fit its colour type");
    }
    for (std::size_t i = 0; i < keyBytes / 2; ++i) {
      key_[i] = byteAt(*chunks.transparent, 2 * i) << 8 | byteAt(*chunks.transparent, 2 * i + 1);
    }
  }

  int channels() const {
    return chunks_->transparent || chunks_->color == kGreyAlpha || chunks_->color == kRgbAlpha ? 4 : 3;
  }

  template <class Sample>
  void spread(std::span<const std::uint8_t> row, std::size_t column, Sample* pixel) const {
    std::array<int, 4> values{};
    const std::size_t inFile = chunks_->fileChannels();
    for (std::size_t k = 0; k < inFile; ++k) {
      values[k] = sample(row, column * inFile + k);
    }
    if (chunks_->color == kPalette) {
      spreadEntry(static_cast<std::size_t>(values[0]), pixel);
      return;
    }
    const bool grey = chunks_->color == kGrey || chunks_->color == kGreyAlpha;
    const int scale = chunks_->bits < 8 ? 255 / ((1 << chunks_->bits) - 1) : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      pixel[k] = static_cast<Sample>(scale * values[grey ? 0 : k]);
    }
    if (chunks_->transparent) {
      const bool hidden = values[0] == key_[0] && (grey || (values[1] == key_[1] && values[2] == key_[2]));
      pixel[3] = hidden ? Sample{0} : static_cast<Sample>(-1);
    } else if (channels() == 4) {
      pixel[3] = static_cast<Sample>(values[grey ? 1 : 3]);
    }
  }

 private:
  int sample(std::span<const std::uint8_t> row, std::size_t place) const {
    if (chunks_->bits == 16) {
      return row[2 * place] << 8 | row[2 * place + 1];
    }
    if (chunks_->bits == 8) {
      return row[place];
    }
    const auto bits = static_cast<std::size_t>(chunks_->bits);
    const std::size_t bit = place * bits;
    return row[bit / 8] >> (8 - bits - bit % 8) & ((1 << bits) - 1);
  }

  template <class Sample>
  void spreadEntry(std::size_t entry, Sample* pixel) const {
    if (3 * entry >= chunks_->palette.size()) {
      fail(*name_, "is a damaged PNG: a pixel has colour " + std::to_string(entry) + " of a palette of " +
                       std::to_string(chunks_->palette.size() / 3));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      pixel[k] = static_cast<Sample>(byteAt(chunks_->palette, 3 * entry + k));
    }
    if (chunks_->transparent) {
      pixel[3] = static_cast<Sample>(
          entry < chunks_->transparent->size() ? byteAt(*chunks_->transparent, entry) : 255);
    }
  }

  const Chunks* chunks_;
  const std::string* name_;
  std::array<int, 3> key_{};
};

void checkBytes(const DeepPicture& picture, std::uint64_t most, const std::string& name) {
  const std::uint64_t bytes = std::uint64_t{picture.samples()} * (picture.deep ? 2 : 1);
  if (bytes > most) {
    fail(name, "has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                   " pixels, which take " + std::to_string(bytes) + " bytes; expected at most " +
                   std::to_string(most) + " here");
  }
}

// Grey and palettes take more room as RGB than in the file.
void checkSpread(const Chunks& chunks, std::uint64_t bytes, const std::string& name) {
  if (bytes > std::max(kFewBytes, kMostInflation * chunks.data.size())) {
    fail(name, "has " + std::to_string(chunks.width) + " x " + std::to_string(chunks.height) +
                   " pixels, which take " + std::to_string(bytes) + " bytes, in " +
                   std::to_string(chunks.data.size()) + "; expected at most 64 MiB, or " +
                   std::to_string(kMostInflation) + " times as many as in the file");
  }
}

template <class Sample>
std::vector<Sample> unpacked(const Chunks& chunks, const Spreader& spreader, const std::string& name) {
  std::vector<std::uint8_t> rows = inflate(chunks, name);
  const auto channels = static_cast<std::size_t>(spreader.channels());
  const auto width = static_cast<std::size_t>(chunks.width);
  const bool asIs = sizeof(Sample) == 1 && chunks.fileChannels() == channels && !chunks.interlaced;
  checkSpread(chunks, width * static_cast<std::size_t>(chunks.height) * channels * sizeof(Sample), name);
  std::vector<Sample> samples(width * static_cast<std::size_t>(chunks.height) * channels);
  std::span<std::uint8_t> left(rows);
  for (const Pass& pass : passesOf(chunks)) {
    const int columns = pass.columns(chunks.width);
    if (columns < 1) {
      continue;
    }
    const std::size_t rowBytes = chunks.rowBytes(columns);
    const std::size_t bytes = static_cast<std::size_t>(pass.rows(chunks.height)) * (rowBytes + 1);
    if (const std::optional<int> unknown = undoFilters(left.first(bytes), rowBytes, chunks.pixelBytes())) {
      fail(name, "is a damaged PNG: a row has filter " + std::to_string(*unknown) + ", the last is 4");
    }
    for (int y = pass.top; y < chunks.height; y += pass.stepY) {
      const std::span<const std::uint8_t> row = left.subspan(1, rowBytes);
      Sample* const out = samples.data() + static_cast<std::size_t>(y) * width * channels;
      if (asIs) {
        std::copy(row.begin(), row.end(), out);
      }
      for (int i = 0; !asIs && i < columns; ++i) {
        spreader.spread(row, static_cast<std::size_t>(i),
                        out + static_cast<std::size_t>(pass.left + i * pass.stepX) * channels);
      }
      left = left.subspan(1 + rowBytes);
    }
  }
  return samples;
}

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
  Chunks chunks;
  readChunks(chunks, bytes, name);
  const Spreader spreader(chunks, name);
  DeepPicture picture{.width = chunks.width,
                      .height = chunks.height,
                      .channels = spreader.channels(),
                      .deep = chunks.bits == 16,
                      .colorSpace = colorSpaceOf(chunks.colors),
                      .samples8 = {},
                      .samples16 = {}};
  checkBytes(picture, most, name);
  if (picture.deep) {
    picture.samples16 = unpacked<std::uint16_t>(chunks, spreader, name);
  } else {
    picture.samples8 = unpacked<std::uint8_t>(chunks, spreader, name);
  }
  return picture;
}

PngSize checkPng(std::string_view bytes, const std::string& name) {
  Chunks chunks;
  readChunks(chunks, bytes, name);
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
