#include "image/color_chunks.h"

#include <libdeflate.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "core/brief.h"
#include "core/hash.h"

namespace careen {
namespace {

constexpr const char* kSrgb = "sRGB";

int numberAt(std::string_view bytes, std::size_t place) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[place + i]);
  }
  return static_cast<int>(value & 0x7fffffffU);
}

// Compressed by two programs, one profile may have two texts. More than 4 MB it is not worth unpacking.
std::string inflatedProfile(std::string_view zlib) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string bytes(std::size_t{4} << 20U, '\0');
  std::size_t size = 0;
  if (!reader || libdeflate_zlib_decompress(reader.get(), zlib.data(), zlib.size(), bytes.data(),
                                            bytes.size(), &size) != LIBDEFLATE_SUCCESS) {
    return std::string(zlib);
  }
  bytes.resize(size);
  return bytes;
}

std::optional<std::string> profileText(std::string_view chunk) {
  const std::size_t end = chunk.find('\0');
  if (end == std::string_view::npos || end + 2 > chunk.size()) {
    return std::nullopt;
  }
  Hash hash;
  hash.add(inflatedProfile(chunk.substr(end + 2)));
  return "ICC profile '" + std::string(chunk.substr(0, end)) + "' " + hash.text();
}

std::optional<std::string> codePointsText(std::string_view chunk) {
  if (chunk.size() != 4) {
    return std::nullopt;
  }
  if (chunk == std::string_view("\x01\x0d\x00\x01", 4)) {
    return std::string(kSrgb);
  }
  std::string text = "code points";
  for (const char each : chunk) {
    text += " " + std::to_string(static_cast<unsigned char>(each));
  }
  return text;
}

std::string gammaText(const ColorChunks& chunks) {
  constexpr int kSrgbGamma = 45455;  // of 100000
  constexpr std::array<int, 8> kSrgbPrimaries{31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
  constexpr int kRounding = 10;
  const int gamma = chunks.gamma && chunks.gamma->size() == 4 && numberAt(*chunks.gamma, 0) > 0
                        ? numberAt(*chunks.gamma, 0)
                        : kSrgbGamma;
  std::string text;
  if (std::abs(gamma - kSrgbGamma) > kRounding) {
    text = "gamma 1/" + brief(100000.0 / gamma);
  }
  if (chunks.chromaticities && chunks.chromaticities->size() == 32) {
    std::string numbers;
    bool isSrgb = true;
    for (std::size_t i = 0; i < kSrgbPrimaries.size(); ++i) {
      const int found = numberAt(*chunks.chromaticities, 4 * i);
      isSrgb &= std::abs(found - kSrgbPrimaries[i]) <= kRounding;
      numbers += ' ';
      numbers += brief(found / 100000.0);
    }
    text += isSrgb ? "" : (text.empty() ? "white and primaries" : ", white and primaries") + numbers;
  }
  return text.empty() ? std::string(kSrgb) : text;
}

}  // namespace

std::string colorSpaceOf(const ColorChunks& chunks) {
  if (chunks.codePoints) {
    if (const std::optional<std::string> text = codePointsText(*chunks.codePoints)) {
      return *text;
    }
  }
  if (chunks.profile) {
    if (const std::optional<std::string> text = profileText(*chunks.profile)) {
      return *text;
    }
  }
  return chunks.srgb ? std::string(kSrgb) : gammaText(chunks);
}

}  // namespace careen
