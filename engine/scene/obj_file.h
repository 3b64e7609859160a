#pragma once

#include <string>

#include "scene/solid_mesh.h"

namespace careen {

/// The vertices and faces of a Wavefront OBJ file, in metres; all of its objects and groups as one mesh.
/// Faces of more than three corners are cut into triangles from their first corner. Vertices at the same
/// place are one. What else such files hold (normals, textures, materials, lines) is passed over.
///
/// InputError says "name:line: what was found, what was expected".
TriangleMesh parseObj(const std::string& text, const std::string& name);

}  // namespace careen
