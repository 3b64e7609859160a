#include "trajectory/numpy_array.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.h"

namespace careen {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kAlignment = 64;  // of the data, from the file's begin
constexpr std::size_t kLetter = 4;      // [bytes] of a letter of '<U'
constexpr std::size_t kMostDimensions = 8;

/// What the elements are.
struct ElementType {
  char kind = 'f';  // f i u b U S
  std::size_t bytes = 8;
  bool bigEndian = false;
};

class Reading {
 public:
  Reading(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  NumpyArray array();

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  std::string_view header();
  std::string_view valueOf(std::string_view header, std::string_view key) const;
  ElementType typeIn(std::string_view value) const;
  std::vector<std::size_t> shapeIn(std::string_view value) const;
  std::uint64_t bitsAt(std::size_t offset, std::size_t bytes, bool bigEndian) const;
  double numberAt(std::size_t offset, const ElementType& type) const;
  std::string textAt(std::size_t offset, const ElementType& type) const;

  std::string_view bytes_;  // after the header: the elements
  const std::string& name_;
};

std::string_view Reading::header() {
  constexpr std::size_t kVersionAt = 6;
  if (!bytes_.starts_with(kMagic) || bytes_.size() < 12) {
    fail("is no NumPy array, expected one in the format .npy");
  }
  const auto version = static_cast<unsigned char>(bytes_[kVersionAt]);
  if (version < 1 || version > 3) {
    fail("has version " + std::to_string(version) + " of the format .npy, expected 1 to 3");
  }
  const std::size_t width = version == 1 ? 2 : 4;
  const std::size_t begin = kVersionAt + 2 + width;
  const std::size_t length = bitsAt(kVersionAt + 2, width, false);
  if (length > bytes_.size() - begin) {
    fail("is cut short");
  }
  const std::string_view text = bytes_.substr(begin, length);
  bytes_.remove_prefix(begin + length);
  return text;
}

// What follows a key of the dictionary.
std::string_view Reading::valueOf(std::string_view header, std::string_view key) const {
  const std::size_t at = header.find(key);
  const std::size_t colon = at == std::string_view::npos ? at : header.find(':', at);
  if (colon == std::string_view::npos) {
    fail("has a header without " + std::string(key));
  }
  const std::size_t first = header.find_first_not_of(' ', colon + 1);
  return first == std::string_view::npos ? std::string_view() : header.substr(first);
}

ElementType Reading::typeIn(std::string_view value) const {
  const std::size_t end = value.find('\'', 1);
  if (!value.starts_with('\'') || end == std::string_view::npos || end < 3) {
    fail("has elements of several parts, expected numbers or texts");
  }
  const std::string_view text = value.substr(1, end - 1);
  ElementType type{.kind = text[1], .bytes = 0, .bigEndian = text[0] == '>'};
  const auto [last, error] = std::from_chars(text.data() + 2, text.data() + text.size(), type.bytes);
  if (type.kind == 'U') {
    type.bytes = std::min<std::size_t>(type.bytes, SIZE_MAX / kLetter) * kLetter;
  }
  const bool isKnown =
      (type.kind == 'f' && (type.bytes == 2 || type.bytes == 4 || type.bytes == 8)) ||
      ((type.kind == 'i' || type.kind == 'u') && std::has_single_bit(type.bytes) && type.bytes <= 8) ||
      (type.kind == 'b' && type.bytes == 1) || type.kind == 'U' || type.kind == 'S';
  if (error != std::errc() || last != text.data() + text.size() || !isKnown) {
    fail("has elements of the type '" + std::string(text.substr(0, 16)) + "', expected numbers or texts");
  }
  return type;
}

std::vector<std::size_t> Reading::shapeIn(std::string_view value) const {
  std::vector<std::size_t> shape;
  const std::size_t end = value.find(')');
  if (!value.starts_with('(') || end == std::string_view::npos) {
    fail("has a header without a shape");
  }
  const char* at = value.data() + 1;
  const char* const last = value.data() + end;
  while (at != last) {
    if (*at == ' ' || *at == ',' || *at == 'L') {
      ++at;
      continue;
    }
    std::size_t length = 0;
    const auto [next, error] = std::from_chars(at, last, length);
    if (error != std::errc() || shape.size() == kMostDimensions) {
      fail("has a shape that cannot be read");
    }
    shape.push_back(length);
    at = next;
  }
  return shape;
}

std::uint64_t Reading::bitsAt(std::size_t offset, std::size_t bytes, bool bigEndian) const {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t place = bigEndian ? bytes - 1 - i : i;
    bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[offset + place])) << (8 * i);
  }
  return bits;
}

// A number of half precision (IEEE 754 binary16): sign, 5 bits of exponent, 10 of fraction.
double halfFrom(std::uint64_t bits) {
  constexpr std::uint64_t kAllOnes = 31;
  const std::uint64_t sign = bits >> 15U;
  const std::uint64_t exponent = bits >> 10U & kAllOnes;
  const std::uint64_t fraction = bits & 0x3FFU;
  if (exponent == kAllOnes) {
    return std::bit_cast<double>(sign << 63U | std::uint64_t{0x7FF} << 52U | fraction << 42U);
  }
  const double size = exponent == 0
                          ? std::ldexp(static_cast<double>(fraction), -24)
                          : std::ldexp(static_cast<double>(1024 + fraction), static_cast<int>(exponent) - 25);
  return sign == 0 ? size : -size;
}

double Reading::numberAt(std::size_t offset, const ElementType& type) const {
  const std::uint64_t bits = bitsAt(offset, type.bytes, type.bigEndian);
  switch (type.kind) {
    case 'f':
      return type.bytes == 8   ? std::bit_cast<double>(bits)
             : type.bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                               : halfFrom(bits);
    case 'i': {
      const auto unused = static_cast<unsigned>(64 - 8 * type.bytes);
      return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
    }
    default:
      return static_cast<double>(bits);
  }
}

void appendUtf8(std::string& text, std::uint64_t letter) {
  const auto add = [&text](std::uint64_t byte) { text += static_cast<char>(byte); };
  if (letter < 0x80) {
    add(letter);
  } else if (letter < 0x800) {
    add(0xC0 | letter >> 6U);
    add(0x80 | (letter & 0x3FU));
  } else if (letter < 0x10000) {
    add(0xE0 | letter >> 12U);
    add(0x80 | (letter >> 6U & 0x3FU));
    add(0x80 | (letter & 0x3FU));
  } else {
    add(0xF0 | (letter >> 18U & 0x07U));
    add(0x80 | (letter >> 12U & 0x3FU));
    add(0x80 | (letter >> 6U & 0x3FU));
    add(0x80 | (letter & 0x3FU));
  }
}

// Padded with zeros.
std::string Reading::textAt(std::size_t offset, const ElementType& type) const {
  std::string text;
  if (type.kind == 'S') {
    text = std::string(bytes_.substr(offset, type.bytes));
    return text.substr(0, text.find('\0'));
  }
  for (std::size_t i = 0; i < type.bytes; i += kLetter) {
    const std::uint64_t letter = bitsAt(offset + i, kLetter, type.bigEndian);
    if (letter == 0) {
      break;
    }
    appendUtf8(text, letter);
  }
  return text;
}

NumpyArray Reading::array() {
  const std::string_view text = header();
  const ElementType type = typeIn(valueOf(text, "'descr'"));
  const bool fortran = valueOf(text, "'fortran_order'").starts_with("True");
  NumpyArray array;
  array.shape = shapeIn(valueOf(text, "'shape'"));
  array.isText = type.kind == 'U' || type.kind == 'S';
  // Elements of no bytes could be any number.
  std::size_t count = 1;
  for (const std::size_t length : array.shape) {
    if (length > bytes_.size() || (length > 0 && count > bytes_.size() / length)) {
      fail("is cut short: its shape asks for more than it has");
    }
    count *= length;
  }
  if (type.bytes > 0 && count > bytes_.size() / type.bytes) {
    fail("is cut short: " + std::to_string(bytes_.size()) + " bytes, expected " + std::to_string(count) +
         " elements of " + std::to_string(type.bytes));
  }
  if (bytes_.size() != count * type.bytes) {
    fail("has bytes after its end");
  }
  (array.isText ? array.texts.resize(count) : array.numbers.resize(count));
  std::vector<std::size_t> index(array.shape.size(), 0);
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t place = k;
    if (fortran) {
      place = 0;
      for (std::size_t axis = array.shape.size(); axis-- > 0;) {
        place = place * array.shape[axis] + index[axis];
      }
      for (std::size_t axis = array.shape.size(); axis-- > 0 && ++index[axis] == array.shape[axis];) {
        index[axis] = 0;
      }
    }
    if (array.isText) {
      array.texts[k] = textAt(place * type.bytes, type);
    } else {
      array.numbers[k] = numberAt(place * type.bytes, type);
    }
  }
  return array;
}

// Letters of a UTF-8 text; bytes that are none stand for themselves.
std::vector<std::uint32_t> lettersOf(std::string_view text) {
  std::vector<std::uint32_t> letters;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80    ? 1
                               : first >= 0xF0 ? 4
                               : first >= 0xE0 ? 3
                               : first >= 0xC0 ? 2
                                               : 1;
    const std::size_t end = std::min(i + length, text.size());
    std::uint32_t letter = length == 1 ? first : first & (0xFFU >> (length + 1));
    for (std::size_t k = i + 1; k < end; ++k) {
      letter = letter << 6U | (static_cast<unsigned char>(text[k]) & 0x3FU);
    }
    letters.push_back(letter);
    i = end;
  }
  return letters;
}

void append(std::string& bytes, std::uint64_t bits, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bytes += static_cast<char>(bits >> (8 * i));
  }
}

std::string textOf(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (const std::size_t length : shape) {
    text += std::to_string(length) + ",";
  }
  return text + ")";
}

// All before the elements.
std::string beginningOf(const std::string& type, const std::vector<std::size_t>& shape) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + textOf(shape) + ", }";
  constexpr std::size_t kBefore = 10;  // magic word, version, length
  header.append((kAlignment - (kBefore + header.size() + 1) % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += '\1';
  bytes += '\0';
  append(bytes, header.size(), 2);
  return bytes + header;
}

template <class Number>
std::string encodeSmall(const char* type, std::span<const Number> numbers,
                        const std::vector<std::size_t>& shape) {
  std::string bytes = beginningOf(type, shape);
  const std::size_t begin = bytes.size();
  bytes.resize(begin + numbers.size_bytes());
  if constexpr (std::endian::native == std::endian::little || sizeof(Number) == 1) {
    std::memcpy(bytes.data() + begin, numbers.data(), numbers.size_bytes());
  } else {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto bits = std::bit_cast<std::uint32_t>(numbers[i]);
      for (std::size_t k = 0; k < sizeof(Number); ++k) {
        bytes[begin + sizeof(Number) * i + k] = static_cast<char>(bits >> (8 * k));
      }
    }
  }
  return bytes;
}

}  // namespace

NumpyArray NumpyArray::of(std::vector<double> numbers, std::vector<std::size_t> shape) {
  return {.shape = std::move(shape), .numbers = std::move(numbers), .texts = {}, .isText = false};
}

NumpyArray NumpyArray::of(std::vector<std::string> texts, std::vector<std::size_t> shape) {
  return {.shape = std::move(shape), .numbers = {}, .texts = std::move(texts), .isText = true};
}

std::string encodeNumpy(const NumpyArray& array) {
  std::vector<std::vector<std::uint32_t>> letters;
  std::size_t longest = 1;
  for (const std::string& text : array.texts) {
    letters.push_back(lettersOf(text));
    longest = std::max(longest, letters.back().size());
  }
  std::string bytes =
      beginningOf(array.isText ? "<U" + std::to_string(longest) : std::string("<f8"), array.shape);
  bytes.reserve(bytes.size() + 8 * array.numbers.size() + kLetter * longest * letters.size());
  for (const double number : array.numbers) {
    append(bytes, std::bit_cast<std::uint64_t>(number), sizeof(double));
  }
  for (const std::vector<std::uint32_t>& text : letters) {
    for (std::size_t i = 0; i < longest; ++i) {
      append(bytes, i < text.size() ? text[i] : 0, kLetter);
    }
  }
  return bytes;
}

std::string encodeNumpy(std::span<const float> numbers, const std::vector<std::size_t>& shape) {
  return encodeSmall("<f4", numbers, shape);
}
std::string encodeNumpy(std::span<const std::int32_t> numbers, const std::vector<std::size_t>& shape) {
  return encodeSmall("<i4", numbers, shape);
}
std::string encodeNumpy(std::span<const std::uint8_t> numbers, const std::vector<std::size_t>& shape) {
  return encodeSmall("|u1", numbers, shape);
}

NumpyArray decodeNumpy(std::string_view bytes, const std::string& name) {
  return Reading(bytes, name).array();
}

void NumpyArchive::add(const std::string& name, const std::string& unit, const NumpyArray& array) {
  entries_.emplace_back(name + ".npy", encodeNumpy(array));
  units_.push_back(name);
  units_.push_back(unit);
}

std::string NumpyArchive::bytes() {
  const std::size_t count = units_.size() / 2;
  entries_.emplace_back("units.npy", encodeNumpy(NumpyArray::of(std::move(units_), {count, 2})));
  return zipOf(entries_);
}

}  // namespace careen
