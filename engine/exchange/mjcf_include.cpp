#include "exchange/mjcf_include.h"

#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "core/system/file.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

class FileIncluder {
 public:
  explicit FileIncluder(XmlTree& tree) : tree_(tree), first_(fs::path(tree.name()).parent_path()) {
    isNew(tree.name());
  }

  void expand() { expand(tree_.root(), first_, 1); }

 private:
  // Each file is one deeper, so that long chains of them end in a message too.
  void expand(XmlElement& element, const fs::path& folder, int depth) {
    if (depth > kDeepestXml) {
      tree_.fail(element.offset, "elements nested deeper than " + std::to_string(kDeepestXml),
                 "fewer files that include others");
    }
    std::vector<XmlElement> children;
    children.reserve(element.children.size());
    for (XmlElement& child : element.children) {
      if (child.name == "include") {
        std::vector<XmlElement> found = elementsFor(child, folder, depth);
        std::move(found.begin(), found.end(), std::back_inserter(children));
      } else {
        expand(child, folder, depth + 1);
        children.push_back(std::move(child));
      }
    }
    element.children = std::move(children);
  }

  std::vector<XmlElement> elementsFor(const XmlElement& include, const fs::path& folder, int depth) {
    const XmlAttribute* const file = include.find("file");
    if (file == nullptr || include.attributes.size() > 1 || !include.children.empty()) {
      tree_.fail(include.offset, "an <include> with more or less than a file", "<include file=\"…\"/>");
    }
    const auto fail = [&](const std::string& expected) {
      tree_.fail(file->offset, "file=" + inQuotes(file->value) + " for <include>", expected);
    };
    fs::path path = first_ / file->value;
    if (!isFile(path)) {
      path = folder / file->value;
    }
    if (!isFile(path)) {
      fail("a file beside the model");
    }
    if (!isNew(path)) {
      fail("each file once; this one has been read");
    }
    XmlElement root = tree_.add(readFile(path), path.string());
    if (root.children.empty()) {
      fail("a file with elements in its root");
    }
    expand(root, path.parent_path(), depth + 1);
    return std::move(root.children);
  }

  static bool isFile(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
  }
  bool isNew(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(path, error);
    return read_.insert(error ? path : whole).second;
  }

  XmlTree& tree_;
  fs::path first_;
  std::set<fs::path> read_;
};

}  // namespace

void includeFiles(XmlTree& tree) { FileIncluder(tree).expand(); }

}  // namespace careen
