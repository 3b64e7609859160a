#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// The pixels of one character: how much of each pixel it covers, 0 … 255, rows from the top.
struct Glyph {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  int left = 0;    ///< [px] from the pen to the first column, rightward
  int top = 0;     ///< [px] from the baseline to the first row, downward
  std::vector<std::uint8_t> coverage;
};

/// The position of a character in a text.
struct PlacedGlyph {
  char32_t character = 0;
  double pen = 0;  ///< [px] from the start of the text
};

/// An outline font. Sizes are em sizes [px].
class Font {
 public:
  /// Loads a TrueType file; MachineError if it cannot be read or is not one.
  explicit Font(const std::filesystem::path& path);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;

  /// Height of a capital letter [px].
  double capitalHeight(double size) const;
  /// Characters and their pen positions, kerned; the last one is 0 and marks the end of the text.
  std::vector<PlacedGlyph> place(std::string_view utf8, double size) const;
  /// Length of a line of text [px].
  double width(std::string_view utf8, double size) const;
  /// `shift` [px], 0 … 1: fraction of a pixel by which the pen is to the right.
  Glyph draw(char32_t character, double size, double shift) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

inline constexpr const char* kPlainFont = "DejaVuSans.ttf";
inline constexpr const char* kMonospacedFont = "DejaVuSansMono.ttf";

/// Folders where Linux distributions install the DejaVu fonts.
std::span<const std::filesystem::path> fontFolders();

/// The font with that file name, such as "DejaVuSans.ttf", from the first folder that has it. If none has,
/// MachineError names the package to install.
Font findFont(const std::string& file, std::span<const std::filesystem::path> folders = fontFolders());

}  // namespace careen
