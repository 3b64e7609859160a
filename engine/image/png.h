#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "image/picture.h"

namespace careen {

using PngColor = std::array<std::uint8_t, 3>;

/// A PNG file's bytes: 8-bit RGB, or RGBA of a picture with alpha, lossless. Pixels of the colour `clear`, if
/// any, are transparent. The same picture gives the same bytes.
std::string encodePng(const Picture& picture, const std::optional<PngColor>& clear = {});

/// Any PNG in 8 bits, rounded. InputError, naming `name`, if the bytes are no
/// whole PNG or one of its checksums is wrong.
Picture decodePng(std::string_view bytes, const std::string& name);

/// InputError if the file is missing, cut short or changed.
Picture readPng(const std::filesystem::path& path);
/// The file appears whole or not at all; MachineError if it cannot be written.
void writePng(const std::filesystem::path& path, const Picture& picture);

/// Whether the file is a PNG of this size with nothing missing and every checksum right: quick, for its
/// pixels are not unpacked.
bool isWholePng(const std::filesystem::path& path, int width, int height);

}  // namespace careen
