#pragma once

#include <string>
#include <vector>

namespace careen {

/// A key that scene files may have, as assets/scene.schema.json describes it.
struct SceneKey {
  std::string path;  ///< "boxes[].half_extents": of each of the boxes
  std::string text;  ///< what it means, with its unit, and what it is if it is missing
};

/// In the order of the schema. MachineError if that is not where data is.
std::vector<SceneKey> sceneKeys();

}  // namespace careen
