#include "exchange/xml_tree.h"

#include <algorithm>
#include <iterator>
#include <pugixml.hpp>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

// pugixml knows where elements begin. It has found them to be whole, so that their attributes are names, an
// equals sign and a value in quotes.
class ElementReader {
 public:
  ElementReader(const XmlTree& tree, std::string_view text, std::size_t begin)
      : tree_(tree), text_(text), begin_(begin) {}

  XmlElement element(const pugi::xml_node& node, int depth) const {
    XmlElement read{.name = node.name(),
                    .offset = begin_ + static_cast<std::size_t>(node.offset_debug()),
                    .attributes = {},
                    .children = {}};
    if (depth > kDeepestXml) {
      tree_.fail(read.offset, "elements nested deeper than " + std::to_string(kDeepestXml), "a flatter file");
    }
    std::size_t at = read.offset - begin_ + read.name.size();
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      at = text_.find_first_not_of(kXmlBlanks, at);
      if (const XmlAttribute* const first = read.find(attribute.name()); first != nullptr) {
        tree_.fail(begin_ + at, "the attribute " + first->name + " again",
                   "each once; it stands at " + tree_.place(first->offset) + " already");
      }
      read.attributes.push_back(
          {.name = attribute.name(), .value = attribute.value(), .offset = begin_ + at});
      const std::size_t open = text_.find_first_of("\"'", at);
      at = text_.find(text_[open], open + 1) + 1;
    }
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element) {
        read.children.push_back(element(child, depth + 1));
      }
    }
    return read;
  }

 private:
  const XmlTree& tree_;
  std::string_view text_;
  std::size_t begin_;
};

}  // namespace

const XmlAttribute* XmlElement::find(std::string_view attribute) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [attribute](const XmlAttribute& each) { return each.name == attribute; });
  return found == attributes.end() ? nullptr : &*found;
}

std::string XmlElement::text(std::string_view attribute) const {
  const XmlAttribute* const found = find(attribute);
  return found == nullptr ? std::string() : found->value;
}

XmlTree::XmlTree(std::string text, std::string name) { root_ = add(std::move(text), std::move(name)); }

XmlElement XmlTree::add(std::string text, std::string name) {
  const std::size_t begin = files_.empty() ? 0 : files_.back().begin + files_.back().text.size() + 1;
  if (begin + text.size() > kMostXmlBytes) {
    throw InputError(name + ": found " + std::to_string(begin + text.size()) +
                     " bytes of XML, expected at most " + std::to_string(kMostXmlBytes));
  }
  files_.push_back({.text = std::move(text), .name = std::move(name), .begin = begin});
  const std::string_view all = files_.back().text;
  // The parser would take a zero byte for the end of the text.
  if (const std::size_t zero = all.find('\0'); zero != std::string::npos) {
    fail(begin + zero, "a zero byte", "XML text");
  }
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(
      all.data(), all.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!result) {
    std::string why = result.description();
    why.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(why.front())));
    fail(begin + std::min(static_cast<std::size_t>(result.offset), all.size()), why, "well-formed XML");
  }
  const pugi::xml_node root = document.document_element();
  for (const pugi::xml_node& child : document.children()) {
    if (child.type() == pugi::node_doctype) {
      fail(begin + all.find("<!DOCTYPE"), "a document type", "none: no entity is expanded");
    }
    if (child.type() == pugi::node_element && child != root) {
      fail(begin + static_cast<std::size_t>(child.offset_debug()),
           "a second element <" + std::string(child.name()) + ">", "the end of the file");
    }
  }
  return ElementReader(*this, all, begin).element(root, 1);
}

const XmlTree::File& XmlTree::fileOf(std::size_t offset) const {
  const auto after = std::upper_bound(files_.begin(), files_.end(), offset,
                                      [](std::size_t at, const File& file) { return at < file.begin; });
  return *std::prev(after);
}

std::string XmlTree::place(std::size_t offset) const {
  const File& file = fileOf(offset);
  return placeIn(file.text, offset - file.begin);
}

void XmlTree::fail(std::size_t offset, const std::string& found, const std::string& expected) const {
  throw InputError(fileOf(offset).name + ":" + place(offset) + ": found " + found + ", expected " + expected);
}

}  // namespace careen
