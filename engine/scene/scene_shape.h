#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// First half of reading a scene: its shape, which is exactly what assets/scene.schema.json can express
/// (keys, types, ranges of single values). Relations between values are left to checkScene, and so are the
/// bodies that springs and joints name: their ends hold places only, those of joints in the world. Directions
/// and quaternions are normalised here.
Scene readShape(const JsonTree& tree);
/// Of a scene, or of one that lacks all else, how it is shown: camera, film, look, light and what is drawn
/// over it.
Scene readShownShape(const JsonTree& tree);

}  // namespace careen
