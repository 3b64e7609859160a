#include "image/font.h"

#include <array>
#include <cstddef>
#include <system_error>

#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

namespace careen {

struct Font::Parts {
  std::string bytes;
  stbtt_fontinfo info{};

  float scale(double size) const { return stbtt_ScaleForMappingEmToPixels(&info, static_cast<float>(size)); }
};

Font::Font(const std::filesystem::path& path) : parts_(std::make_unique<Parts>()) {
  try {
    parts_->bytes = readFile(path);
  } catch (const InputError& error) {
    throw MachineError(error.what());
  }
  const auto* const data = reinterpret_cast<const unsigned char*>(parts_->bytes.data());
  const int offset = parts_->bytes.size() < 12 ? -1 : stbtt_GetFontOffsetForIndex(data, 0);
  if (offset < 0 || stbtt_InitFont(&parts_->info, data, offset) == 0) {
    throw MachineError(path.string() + ": found no font, expected TrueType");
  }
}

Font::~Font() = default;
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;

double Font::capitalHeight(double size) const {
  std::array<int, 4> box{};  // x and y of the lower left, then of the upper right corner
  stbtt_GetCodepointBox(&parts_->info, 'H', box.data(), &box[1], &box[2], &box[3]);
  return static_cast<double>(box[3]) * static_cast<double>(parts_->scale(size));
}

std::vector<PlacedGlyph> Font::place(std::string_view utf8, double size) const {
  const auto scale = static_cast<double>(parts_->scale(size));
  std::vector<PlacedGlyph> placed;
  double pen = 0;
  int last = 0;
  for (const char32_t character : charactersOf(utf8)) {
    const int code = static_cast<int>(character);
    if (last != 0) {
      pen += scale * stbtt_GetCodepointKernAdvance(&parts_->info, last, code);
    }
    placed.push_back({.character = character, .pen = pen});
    int advance = 0;
    int bearing = 0;
    stbtt_GetCodepointHMetrics(&parts_->info, code, &advance, &bearing);
    pen += scale * advance;
    last = code;
  }
  placed.push_back({.character = 0, .pen = pen});
  return placed;
}

double Font::width(std::string_view utf8, double size) const { return place(utf8, size).back().pen; }

Glyph Font::draw(char32_t character, double size, double shift) const {
  const int code = static_cast<int>(character);
  const float scale = parts_->scale(size);
  const auto right = static_cast<float>(shift);
  Glyph glyph;
  int endColumn = 0;
  int endRow = 0;
  stbtt_GetCodepointBitmapBoxSubpixel(&parts_->info, code, scale, scale, right, 0, &glyph.left, &glyph.top,
                                      &endColumn, &endRow);
  glyph.width = endColumn - glyph.left;
  glyph.height = endRow - glyph.top;
  glyph.coverage.resize(static_cast<std::size_t>(glyph.width) * static_cast<std::size_t>(glyph.height));
  if (!glyph.coverage.empty()) {
    stbtt_MakeCodepointBitmapSubpixel(&parts_->info, glyph.coverage.data(), glyph.width, glyph.height,
                                      glyph.width, scale, scale, right, 0, code);
  }
  return glyph;
}

std::span<const std::filesystem::path> fontFolders() {
  static const std::array<std::filesystem::path, 3> kFolders = {
      "/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF"};
  return kFolders;
}

Font findFont(const std::string& file, std::span<const std::filesystem::path> folders) {
  std::string looked;
  for (const std::filesystem::path& folder : folders) {
    std::error_code none;
    if (std::filesystem::exists(folder / file, none)) {
      return Font(folder / file);
    }
    looked.append(looked.empty() ? "" : ", ").append(folder.string());
  }
  throw MachineError("found no font " + file + " to write with, looked in " + looked +
                     "; apt install fonts-dejavu-core");
}

}  // namespace careen
