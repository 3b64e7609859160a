#include "scene/scene_reader.h"

#include "core/system/file.h"
#include "scene/json_tree.h"
#include "scene/scene_check.h"
#include "scene/scene_shape.h"

namespace careen {

Scene readScene(const std::filesystem::path& path) { return parseScene(readFile(path), path.string()); }

Scene parseScene(const std::string& text, const std::string& name, Starts starts) {
  const JsonTree tree(text, name);
  Scene scene = readShape(tree);
  checkScene(tree, scene, starts);
  return scene;
}

}  // namespace careen
