#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// One character as pixels: how much of each it covers, 0 … 255, rows from the top.
struct Glyph {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  int left = 0;    ///< [px] of the first column from the pen, rightward
  int top = 0;     ///< [px] of the first row from the baseline, downward
  std::vector<std::uint8_t> coverage;
};

/// Where a character of a text stands.
struct PlacedGlyph {
  char32_t character = 0;
  double pen = 0;  ///< [px] from the start of the text
};

/// An outline font. Sizes are those of the em square [px].
class Font {
 public:
  /// A TrueType file; MachineError if it cannot be read or is none.
  explicit Font(const std::filesystem::path& path);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;

  /// [px] of a capital letter.
  double capitalHeight(double size) const;
  /// Characters with their pens, kerned; a last one, 0, tells where the text ends.
  std::vector<PlacedGlyph> place(std::string_view utf8, double size) const;
  /// [px] from the start to the end of a line of text.
  double width(std::string_view utf8, double size) const;
  /// `shift` [px], 0 … 1: how far right of a whole pixel the pen stands.
  Glyph draw(char32_t character, double size, double shift) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

inline constexpr const char* kPlainFont = "DejaVuSans.ttf";
inline constexpr const char* kMonospacedFont = "DejaVuSansMono.ttf";

/// Folders where distributions keep the fonts of DejaVu.
std::span<const std::filesystem::path> fontFolders();

/// The font of that file name, "DejaVuSans.ttf", in the first folder that has it. MachineError names the
/// package to install if none has.
Font findFont(const std::string& file, std::span<const std::filesystem::path> folders = fontFolders());

}  // namespace careen
