#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/error.h"
#include "core/names.h"

namespace careen {

/// Integers and doubles in little-endian order, text with its length before it.
///
/// Writer and reader have the same interface, so that one description of a format serves both and they cannot
/// disagree: a function template visit(archive, value) per type.
class ArchiveWriter {
 public:
  static constexpr bool kReads = false;
  using Sink = std::function<void(std::string_view)>;

  /// Keeps all that is written.
  ArchiveWriter() = default;
  /// Hands it on in pieces, none of which ends within a number or a text.
  explicit ArchiveWriter(Sink sink) : sink_(std::move(sink)) {}

  template <std::unsigned_integral Integer>
  void visit(const Integer& value) {
    if (sink_ && bytes_.size() >= kPiece) {
      handOn();
    }
    std::array<char, sizeof(Integer)> bytes;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      bytes[i] = static_cast<char>(value >> (8 * i));
    }
    bytes_.append(bytes.data(), bytes.size());
  }
  void visit(const double& value) { visit(std::bit_cast<std::uint64_t>(value)); }
  void visit(const std::string& text) {
    visit(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  /// What has not been handed on.
  std::string& bytes() { return bytes_; }
  void handOn() {
    sink_(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 20U;

  Sink sink_;
  std::string bytes_;
};

/// InputError, which names the file, if the bytes end too early.
class ArchiveReader {
 public:
  static constexpr bool kReads = true;

  /// The next piece, whose bytes stay until the one after it is asked for; an empty one at the end.
  using Source = std::function<std::string_view()>;

  ArchiveReader(std::string_view bytes, std::string_view name) : rest_(bytes), name_(name) {}
  ArchiveReader(Source more, std::string_view name) : more_(std::move(more)), name_(name) {}

  template <std::unsigned_integral Integer>
  void visit(Integer& value) {
    const std::string_view bytes = take(sizeof(Integer));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    }
    value = static_cast<Integer>(bits);
  }
  void visit(double& value) {
    std::uint64_t bits = 0;
    visit(bits);
    value = std::bit_cast<double>(bits);
  }
  void visit(std::string& text) {
    std::uint64_t size = 0;
    visit(size);
    text = std::string(take(size));
  }
  /// So many bytes, as they are.
  std::string_view take(std::uint64_t count) {
    if (count > 0 && (atEnd() || count > rest_.size())) {
      fail("is cut short");
    }
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::string_view rest() const { return rest_; }
  bool atEnd() {
    if (rest_.empty() && more_) {
      rest_ = more_();
    }
    return rest_.empty();
  }
  /// Throws InputError: the file's `name`, "this trajectory file", what is wrong with it.
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(std::string(name_) + ": this trajectory file " + what);
  }

 private:
  Source more_;
  std::string_view rest_;
  std::string_view name_;
};

/// What visit() takes of a T: to be read or, constant, to be written.
template <class Archive, class T>
using Visited = std::conditional_t<Archive::kReads, T&, const T&>;

template <class Archive>
void visit(Archive& archive, Visited<Archive, bool> value) {
  std::uint8_t byte = value ? 1 : 0;
  archive.visit(byte);
  if constexpr (Archive::kReads) {
    value = byte != 0;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, double> value) {
  archive.visit(value);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::string> text) {
  archive.visit(text);
}

template <class Archive>
void visitIndex(Archive& archive, Visited<Archive, int> index) {
  auto value = static_cast<std::uint32_t>(index);
  archive.visit(value);
  if constexpr (Archive::kReads) {
    index = static_cast<int>(value);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, int> index) {
  visitIndex(archive, index);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::size_t> index) {
  archive.visit(index);
}

/// By name: the enumerators' values may change.
template <class Archive, class Enum, std::size_t kCount>
void visitNamed(Archive& archive, Enum& value, const std::array<std::string_view, kCount>& names) {
  std::string name;
  if constexpr (!Archive::kReads) {
    name = names.at(static_cast<std::size_t>(value));
  }
  archive.visit(name);
  if constexpr (Archive::kReads) {
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) {
      archive.fail("has '" + name + "', expected one of " + listed(names));
    }
    value = static_cast<Enum>(known - names.begin());
  }
}

/// Presence flag, then the value.
template <class Archive, class T>
void visitOptional(Archive& archive, T& optional) {
  bool isThere = optional.has_value();
  visit(archive, isThere);
  if constexpr (Archive::kReads) {
    optional.reset();
    if (isThere) {
      optional.emplace();
    }
  }
  if (isThere) {
    visit(archive, *optional);
  }
}

/// Count, then the elements. Read one by one, so that a corrupted count allocates no memory for missing
/// elements.
template <class Archive, class T>
void visitAll(Archive& archive, T& list) {
  std::uint64_t count = list.size();
  archive.visit(count);
  if constexpr (Archive::kReads) {
    list.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      visit(archive, list.emplace_back());
    }
  } else {
    for (const auto& item : list) {
      visit(archive, item);
    }
  }
}

/// Sets a variant to its alternative number `index`; false if there is none.
template <std::size_t kIndex = 0, class Variant>
bool emplaceAlternative(Variant& variant, std::uint64_t index) {
  if constexpr (kIndex == std::variant_size_v<Variant>) {
    return false;
  } else if (index == kIndex) {
    variant.template emplace<kIndex>();
    return true;
  } else {
    return emplaceAlternative<kIndex + 1>(variant, index);
  }
}

/// Index of a variant's alternative, then its value. Indices are part of the format: append only.
template <class Archive, class Variant>
void visitVariant(Archive& archive, Variant& variant) {
  auto index = static_cast<std::uint8_t>(variant.index());
  archive.visit(index);
  if constexpr (Archive::kReads) {
    if (!emplaceAlternative(variant, index)) {
      archive.fail("has an unknown kind of record");
    }
  }
  std::visit([&archive](auto& held) { visit(archive, held); }, variant);
}

}  // namespace careen
