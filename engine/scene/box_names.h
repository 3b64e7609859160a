#pragma once

#include <map>
#include <string_view>

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Boxes of a scene by name. Refers to it.
class BoxNames {
 public:
  explicit BoxNames(const Scene& scene);

  bool has(std::string_view name) const { return boxes_.contains(name); }
  /// Index of the box whose name this node is; InputError there if there is none.
  int named(const JsonTree& tree, const JsonNode& node) const;

 private:
  std::map<std::string_view, int> boxes_;
};

}  // namespace careen
