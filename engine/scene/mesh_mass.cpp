#include "scene/mesh_mass.h"

#include <filesystem>
#include <string>

#include "core/brief.h"
#include "core/error.h"
#include "core/system/file.h"
#include "physics/world/given_inertia.h"
#include "scene/json_shape.h"
#include "scene/obj_file.h"
#include "scene/solid_mesh.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

std::string inBrief(const Vec3& v) {
  return "(" + brief(v.x()) + ", " + brief(v.y()) + ", " + brief(v.z()) + ")";
}

// Nothing that waits for another program, as a pipe does, is opened.
TriangleMesh readMesh(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw InputError(path.string() + ": found no such file, expected a mesh, .obj");
  }
  return parseObj(readFile(path), path.string());
}

void checkWithin(const TriangleMesh& mesh, const Vec3& halfExtents) {
  const Vec3 most = halfExtents + Vec3::Constant(kFitsBox * halfExtents.norm());
  for (const Vec3& point : mesh.points) {
    if ((point.cwiseAbs().array() > most.array()).any()) {
      throw InputError("found a vertex at " + inBrief(point) + " m, outside the box of half extents " +
                       inBrief(halfExtents) + " m, expected a mesh in metres within its box");
    }
  }
}

// A mesh in a file has few digits: what is as good as centred, or along the axes, is.
void roundToBox(SolidMoments& moments, const Vec3& halfExtents) {
  if (moments.center.norm() <= kFitsBox * halfExtents.norm()) {
    moments.center = Vec3::Zero();
  }
  const Mat3 along = moments.inertia.diagonal().asDiagonal();
  if ((moments.inertia - along).cwiseAbs().maxCoeff() <= kFitsBox * moments.inertia.trace()) {
    moments.inertia = along;
  }
}

// Does something with the mesh that a key of a box names, once it lies within the box; an InputError of it is
// told with the key's place.
template <class Use>
void useMesh(const JsonTree& tree, std::size_t place, const char* key, const std::string& name,
             const SceneBox& box, const Use& use) {
  const fs::path path = fs::path(tree.name()).parent_path() / name;
  const auto fail = [&](const std::string& why) {
    throw InputError(tree.name() + ":" + tree.place(place) + ": " + key + " of box " + inQuotes(box.name) +
                     ": " + why);
  };
  TriangleMesh mesh;
  try {
    mesh = readMesh(path);
  } catch (const InputError& error) {
    fail(error.what());
  }
  try {
    checkWithin(mesh, box.halfExtents);
    use(mesh);
  } catch (const InputError& error) {
    fail(path.string() + ": " + error.what());
  }
}

void takeMass(const JsonTree& tree, const JsonNode& node, SceneBox& box) {
  const std::size_t place = node.find("mass_from")->offset;
  const std::string found = "mass_from for box " + inQuotes(box.name);
  for (const char* const key : {"mass", "inertia", "center", "parts"}) {
    if (node.find(key) != nullptr) {
      tree.fail(place, found + " beside " + key, "one of them: the mesh gives mass, centre and inertia");
    }
  }
  if (box.fixed) {
    tree.fail(place, found + ", which is fixed", "none, as it stays where it is");
  }
  const JsonNode* const density = node.find("density");
  if (density == nullptr) {
    tree.fail(place, found + " without density", "a density [kg/m³]");
  }
  useMesh(tree, place, "mass_from", box.massFrom, box, [&](const TriangleMesh& mesh) {
    SolidMoments moments = momentsOf(mesh);
    roundToBox(moments, box.halfExtents);
    box.mass = density->number * moments.volume;
    box.inertia = density->number * moments.inertia;
    box.center = moments.center;
    if (const std::string why = whyNoTensor(*box.inertia); !why.empty() || box.mass < kSmallestPositive) {
      throw InputError("found a mass of " + brief(box.mass) + " kg and an inertia with " +
                       inBrief(box.inertia->diagonal()) + " kg m² on the diagonal, expected those of a body");
    }
  });
}

}  // namespace

void takeMassesFromMeshes(const JsonTree& tree, Scene& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    if (!scene.boxes[i].massFrom.empty()) {
      takeMass(tree, tree.root().find("boxes")->children[i], scene.boxes[i]);
    }
  }
}

void takeDrawnMeshes(const JsonTree& tree, Scene& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    SceneBox& box = scene.boxes[i];
    if (!box.drawFrom.empty()) {
      const std::size_t place = tree.root().find("boxes")->children[i].find("draw")->offset;
      useMesh(tree, place, "draw", box.drawFrom, box, [&](const TriangleMesh& mesh) {
        momentsOf(mesh);  // refuses what is not closed
        box.drawn = mesh;
      });
    }
  }
}

}  // namespace careen
