#include "core/characters.h"

#include <array>
#include <cstddef>

namespace careen {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

// The number of bytes of a character, from its first byte; 0 if no character starts with it.
std::size_t lengthOf(unsigned char first) {
  if (first < 0x80) {
    return 1;
  }
  if (first >= 0xC2 && first < 0xE0) {
    return 2;
  }
  if (first >= 0xE0 && first < 0xF0) {
    return 3;
  }
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

// The character that starts at `at`; `at` moves past it, or by one byte if the bytes are invalid.
char32_t next(std::string_view utf8, std::size_t& at) {
  constexpr std::array<char32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  const auto first = static_cast<unsigned char>(utf8[at]);
  const std::size_t length = lengthOf(first);
  const std::size_t start = at++;
  if (length == 0 || start + length > utf8.size()) {
    return kReplacement;
  }
  char32_t character = length == 1 ? first : first & (0x7FU >> length);
  for (std::size_t i = start + 1; i < start + length; ++i) {
    const auto byte = static_cast<unsigned char>(utf8[i]);
    if ((byte & 0xC0U) != 0x80U) {
      return kReplacement;
    }
    character = character << 6U | (byte & 0x3FU);
  }
  const bool isSurrogate = character >= 0xD800 && character < 0xE000;
  if (character < kSmallest.at(length) || character > 0x10FFFF || isSurrogate) {
    return kReplacement;
  }
  at = start + length;
  return character;
}

// What XML 1.0, 2.2, allows, without the control characters of Latin-1.
bool mayBeInMarkup(char32_t character) {
  return character == U'\t' || character == U'\n' || character == U'\r' ||
         (character >= 0x20 && character < 0x7F) ||
         (character >= 0xA0 && character != 0xFFFE && character != 0xFFFF);
}

// Control characters of both sets, line and paragraph separators, and marks that reorder text.
bool steersTerminals(char32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0) ||
         (character >= 0x200E && character <= 0x200F) || (character >= 0x2028 && character <= 0x202E) ||
         (character >= 0x2066 && character <= 0x2069);
}

std::string escaped(char32_t character) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = character < 0x100 ? "\\x" : "\\u";
  for (int shift = character < 0x100 ? 4 : 12; shift >= 0; shift -= 4) {
    text += kDigits[(character >> static_cast<unsigned>(shift)) & 0xFU];
  }
  return text;
}

}  // namespace

std::u32string charactersOf(std::string_view utf8) {
  std::u32string characters;
  for (std::size_t at = 0; at < utf8.size();) {
    characters.push_back(next(utf8, at));
  }
  return characters;
}

std::string utf8Of(char32_t character) {
  const auto more = [character](unsigned shift) {
    return static_cast<char>(0x80U | ((character >> shift) & 0x3FU));
  };
  if (character < 0x80) {
    return {static_cast<char>(character)};
  }
  if (character < 0x800) {
    return {static_cast<char>(0xC0U | (character >> 6U)), more(0)};
  }
  if (character < 0x10000) {
    return {static_cast<char>(0xE0U | (character >> 12U)), more(6), more(0)};
  }
  return {static_cast<char>(0xF0U | (character >> 18U)), more(12), more(6), more(0)};
}

std::string printableName(std::string_view utf8) {
  std::string result;
  for (std::size_t at = 0; at < utf8.size();) {
    const char32_t character = next(utf8, at);
    result += steersTerminals(character) ? escaped(character) : utf8Of(character);
  }
  return result;
}

std::string printableMessage(std::string_view utf8) {
  std::string result;
  for (std::size_t at = 0; at < utf8.size();) {
    const char32_t character = next(utf8, at);
    if (character == U'\n') {
      result += "\n  ";
    } else {
      result += steersTerminals(character) && character != U'\t' ? escaped(character) : utf8Of(character);
    }
  }
  return result;
}

std::string escapedForMarkup(std::string_view utf8) {
  std::string result;
  for (std::size_t at = 0; at < utf8.size();) {
    const char32_t character = next(utf8, at);
    switch (character) {
      case U'&':
        result += "&amp;";
        break;
      case U'<':
        result += "&lt;";
        break;
      case U'>':
        result += "&gt;";
        break;
      case U'"':
        result += "&quot;";
        break;
      case U'\'':
        result += "&#39;";
        break;
      default:
        result += utf8Of(mayBeInMarkup(character) ? character : kReplacement);
    }
  }
  return result;
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& each : lower) {
    each = each >= 'A' && each <= 'Z' ? static_cast<char>(each - 'A' + 'a') : each;
  }
  return lower;
}

}  // namespace careen
