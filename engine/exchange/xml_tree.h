#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

struct XmlAttribute {
  std::string name;
  std::string value;
  std::size_t offset = 0;  ///< [bytes] of its name in the texts
};

/// An element with its position in the file. Text between elements is left out.
struct XmlElement {
  std::string name;
  std::size_t offset = 0;  ///< [bytes] of its name in the texts
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
/// kDeepestXml deep, all texts together at most kMostXmlBytes; there must be no document type, so that no
/// entity is expanded; otherwise InputError "file:line:column: found …, expected …".
class XmlTree {
 public:
  /// `name` is the file's name in messages.
  XmlTree(std::string text, std::string name);

  const XmlElement& root() const { return root_; }
  XmlElement& root() { return root_; }
  /// Of the first file.
  const std::string& name() const { return files_.front().name; }

  /// The root of another file, whose elements may be put into the tree: offsets tell which file they are of.
  XmlElement add(std::string text, std::string name);

  /// "3:14"
  std::string place(std::size_t offset) const;
  /// Throws the InputError for that place.
  [[noreturn]] void fail(std::size_t offset, const std::string& found, const std::string& expected) const;

 private:
  struct File {
    std::string text;
    std::string name;
    std::size_t begin = 0;  // of its offsets
  };
  const File& fileOf(std::size_t offset) const;

  std::vector<File> files_;
  XmlElement root_;
};

}  // namespace careen
