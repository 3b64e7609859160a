#include "scene/box_names.h"

#include <optional>
#include <vector>

#include "scene/json_shape.h"

namespace careen {

BoxNames::BoxNames(const Scene& scene) {
  for (const SceneBox& box : scene.boxes) {
    boxes_.emplace(box.name, static_cast<int>(boxes_.size()));
  }
}

int BoxNames::named(const JsonTree& tree, const JsonNode& node) const {
  const auto found = boxes_.find(node.text);
  if (found != boxes_.end()) {
    return found->second;
  }
  std::vector<std::string_view> names;
  names.reserve(boxes_.size());
  for (const auto& [name, index] : boxes_) {
    names.push_back(name);
  }
  const std::optional<std::string_view> meant = nearest(node.text, names);
  tree.fail(node.offset, "no box of the name " + inQuotes(node.text),
            meant ? inQuotes(*meant) : "the name of a box of the scene");
}

}  // namespace careen
