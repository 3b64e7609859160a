#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace careen {

/// What the chunks of a PNG say of the meaning of its colours; PNG specification, 11.3.2.
struct ColorChunks {
  std::optional<std::string_view> codePoints = {};      ///< cICP
  std::optional<std::string_view> profile = {};         ///< iCCP
  std::optional<std::string_view> srgb = {};            ///< sRGB
  std::optional<std::string_view> gamma = {};           ///< gAMA
  std::optional<std::string_view> chromaticities = {};  ///< cHRM
};

/// In which colours a viewer shows it, in words: "sRGB" where nothing else is said, "gamma 1/1.8", "ICC
/// profile 'Display P3' 0123456789abcdef" with a hash of its bytes. Two pictures with the same samples look
/// the same if these words are. Of several chunks the first of the above counts; one that is broken does not.
std::string colorSpaceOf(const ColorChunks& chunks);

}  // namespace careen
