#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// A picture with all that its PNG says of the pixels: 8 or 16 bits, with alpha or without. Grey and palettes
/// are spread to RGB, 1, 2 and 4 bits to 8, and a colour that stands for "transparent" becomes alpha; nothing
/// of it loses a bit. Gamma and colour profiles are not applied: `colorSpace` names them.
struct DeepPicture {
  int width = 0;                    ///< [px]
  int height = 0;                   ///< [px]
  int channels = 3;                 ///< 3: RGB, 4: RGBA, not multiplied by alpha
  bool deep = false;                ///< 16 bits a sample, not 8
  std::string colorSpace = "sRGB";  ///< see color_chunks.h

  /// Rows from the top, no padding; one of the two is empty.
  std::vector<std::uint8_t> samples8;
  std::vector<std::uint16_t> samples16;

  std::size_t rowSamples() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
  std::size_t samples() const { return rowSamples() * static_cast<std::size_t>(height); }
};

/// What every PNG begins with.
inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

inline constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28U;  ///< 16384 x 16384

/// Any PNG: every colour type, depth and filter, interlaced or not. InputError, naming `name`, if a byte of
/// it is missing, a checksum is wrong, or its samples take more than `most` bytes. Memory is bounded by the
/// file: the samples take at most 64 MiB or 1032 times the bytes of its data, whichever is more. (DEFLATE
/// makes 1032 bytes of one.) libpng reads the pixels, in twice the time that a reader of our own took.
DeepPicture decodeDeepPng(std::string_view bytes, const std::string& name,
                          std::uint64_t most = kMostPixels * 8);

/// InputError if the file is missing, cut short or changed.
DeepPicture readDeepPng(const std::filesystem::path& path);

struct PngSize {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
};
/// InputError, naming `name`, if something of a PNG is missing or a checksum is wrong: quick, for its pixels
/// are not unpacked.
PngSize checkPng(std::string_view bytes, const std::string& name);

/// Of a PNG's header alone. InputError, naming `name`, if there is none.
PngSize sizeOfPng(std::string_view bytes, const std::string& name);

/// "found a picture of 2x2 pixels, expected one of 4x4"; empty if they have one size.
std::string otherSize(const DeepPicture& expected, const DeepPicture& actual);
/// InputError with these words, if any.
void requireOneSize(const DeepPicture& expected, const DeepPicture& actual);

/// The same picture with 16 bits a sample (the same share of full), and with alpha (opaque).
DeepPicture deepened(const DeepPicture& picture);
DeepPicture withAlpha(const DeepPicture& picture);

}  // namespace careen
