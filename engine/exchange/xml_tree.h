#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

struct XmlAttribute {
  std::string name;
  std::string value;
  std::size_t offset = 0;  ///< [bytes] of its name in the text
};

/// An element with its position in the file. Text between elements is left out.
struct XmlElement {
  std::string name;
  std::size_t offset = 0;  ///< [bytes] of its name in the text
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  /// The attribute with this name, or null.
  const XmlAttribute* find(std::string_view attribute) const;
  /// Its value; empty if there is none.
  std::string text(std::string_view attribute) const;
};

inline constexpr std::size_t kMostXmlBytes = std::size_t{64} << 20U;
inline constexpr int kDeepestXml = 64;

/// An XML text in UTF-8, parsed into elements. Attributes of an element must be unique, nesting at most
/// kDeepestXml deep, the text at most kMostXmlBytes; there must be no document type, so that no entity is
/// expanded; otherwise InputError "file:line:column: found …, expected …".
class XmlTree {
 public:
  /// `name` is the file's name in messages.
  XmlTree(std::string text, std::string name);

  const XmlElement& root() const { return root_; }
  const std::string& name() const { return name_; }

  /// "3:14"
  std::string place(std::size_t offset) const;
  /// Throws the InputError for that place.
  [[noreturn]] void fail(std::size_t offset, const std::string& found, const std::string& expected) const;

 private:
  std::string text_;
  std::string name_;
  XmlElement root_;
};

}  // namespace careen
