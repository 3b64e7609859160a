#include "exchange/export_glb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "exchange/exporters.h"
#include "exchange/gltf_animation.h"
#include "exchange/gltf_buffer.h"
#include "view/camera.h"
#include "view/camera_path.h"
#include "view/materials.h"
#include "view/scene_extent.h"
#include "view/surfaces.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVertices = 34962;                       // target of a view
constexpr int kLines = 1;                              // mode of a primitive
constexpr std::size_t kTrianglesOfPrimitive = 20'000;  // whose corners 16 bits can number

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

// Readers address nodes by name, and three.js leaves out what separates parts of its paths: names that are
// the same to it get a number.
class NodeNames {
 public:
  std::string unique(const std::string& name) {
    std::string found = name;
    for (int number = 2; !used_.insert(seen(found)).second; ++number) {
      found = name + "-" + std::to_string(number);
    }
    return found;
  }

 private:
  static std::string seen(const std::string& name) {
    std::string kept;
    for (const char letter : name) {
      if (std::string_view("[].:/").find(letter) == std::string_view::npos) {
        kept += std::string_view(" \t\n\r\f\v").find(letter) == std::string_view::npos ? letter : '_';
      }
    }
    return kept;
  }

  std::set<std::string> used_;
};

class GlbWriter {
 public:
  GlbWriter(const Trajectory& run, const ExportSettings& settings)
      : run_(run),
        settings_(settings),
        materials_(materialsOf(run.stage)),
        animation_(run, settings.within, buffer_) {}

  GlbFile file() {
    nodes_.push_back({{"name", ""}, {"rotation", floatsOf(Quat(std::sqrt(0.5), -std::sqrt(0.5), 0, 0))}});
    addBoxes();
    addSurfaces();
    addLines();
    addCamera();
    nodes_[0]["name"] = names_.unique(run_.stage.name);
    for (std::size_t node = 1; node < nodes_.size(); ++node) {
      nodes_[0]["children"].push_back(node);
    }
    file_.keys = animation_.keys();
    file_.positionError = animation_.positionError();
    file_.attitudeError = animation_.attitudeError();
    file_.bytes = buffer_.pack(document());
    return std::move(file_);
  }

 private:
  // ---- What is shown

  std::size_t material(const Vec3& color, double roughness) {
    const std::array<double, 4> key = {rounded(color.x()), rounded(color.y()), rounded(color.z()), roughness};
    const auto [found, isNew] = materialIndices_.emplace(key, materialsWritten_.size());
    if (isNew) {
      materialsWritten_.push_back({{"pbrMetallicRoughness",
                                    {{"baseColorFactor", {key[0], key[1], key[2], 1}},
                                     {"metallicFactor", 0},
                                     {"roughnessFactor", roughness}}}});
    }
    return found->second;
  }

  // A cube from −1 to 1, the same for all boxes: position, normal and index accessors.
  Json cube() {
    if (cube_.is_null()) {
      std::vector<float> positions;
      std::vector<float> normals;
      std::vector<std::uint16_t> indices;
      for (int face = 0; face < 6; ++face) {
        const Vec3 normal = Vec3::Unit(face / 2) * (face % 2 == 0 ? 1 : -1);
        const Vec3 across = Vec3::Unit((face / 2 + 1) % 3);
        const Vec3 along = normal.cross(across);
        const auto first = static_cast<std::uint16_t>(4 * face);
        for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
          appendFloats(positions, normal + u * across + v * along);
          appendFloats(normals, normal);
        }
        for (const int corner : {0, 1, 2, 0, 2, 3}) {
          indices.push_back(static_cast<std::uint16_t>(first + corner));
        }
      }
      cube_ = {{"attributes",
                {{"POSITION", buffer_.addFloats(GltfBuffer::Kind::kVec3, positions, true, kVertices)},
                 {"NORMAL", buffer_.addFloats(GltfBuffer::Kind::kVec3, normals, false, kVertices)}}},
               {"indices", buffer_.addIndices(indices)}};
    }
    return cube_;
  }

  std::size_t paintOf(const Color& color) {
    const Vec3 own = linearFromSrgb(color);
    const Vec3 seen = materials_.ownColor * own + (1 - materials_.ownColor) * materials_.boxColor;
    return material(seen, materials_.boxRoughness);
  }

  std::size_t boxMesh(const Color& color) {
    const std::size_t paint = paintOf(color);
    const auto [found, isNew] = boxMeshes_.emplace(paint, meshes_.size());
    if (isNew) {
      Json primitive = cube();
      primitive["material"] = paint;
      meshes_.push_back({{"primitives", {primitive}}});
    }
    return found->second;
  }

  // With corners of its own for each triangle: its faces are flat.
  std::size_t partMesh(const TriangleMesh& mesh, std::size_t paint) {
    Json primitives = Json::array();
    for (std::size_t first = 0; first < mesh.triangles.size(); first += kTrianglesOfPrimitive) {
      std::vector<float> positions;
      std::vector<float> normals;
      std::vector<std::uint16_t> indices;
      const std::size_t end = std::min(first + kTrianglesOfPrimitive, mesh.triangles.size());
      for (std::size_t t = first; t < end; ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 normal =
            (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
        for (const std::size_t corner : {a, b, c}) {
          appendFloats(positions, mesh.points[corner]);
          appendFloats(normals, normal);
          indices.push_back(static_cast<std::uint16_t>(indices.size()));
        }
      }
      primitives.push_back(
          {{"attributes",
            {{"POSITION", buffer_.addFloats(GltfBuffer::Kind::kVec3, positions, true, kVertices)},
             {"NORMAL", buffer_.addFloats(GltfBuffer::Kind::kVec3, normals, false, kVertices)}}},
           {"indices", buffer_.addIndices(indices)},
           {"material", paint}});
    }
    meshes_.push_back({{"primitives", primitives}});
    return meshes_.size() - 1;
  }

  // All faces of the boxes of a body, in its frame.
  static TriangleMesh meshOfBoxes(const Body& body) {
    TriangleMesh mesh;
    for (int part = 0; part < body.partCount(); ++part) {
      const Pose pose = partPose(body, part, Pose{});
      const std::size_t first = mesh.points.size();
      for (int k = 0; k < kCorners; ++k) {
        mesh.points.push_back(pose.worldPoint(corner(partHalfExtents(body, part), k)));
      }
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t u = 4U >> static_cast<unsigned>((axis + 1) % 3);
        const std::size_t v = 4U >> static_cast<unsigned>((axis + 2) % 3);
        const std::size_t minus = first + (4U >> static_cast<unsigned>(axis));
        mesh.triangles.push_back({first, first + u, first + u + v});
        mesh.triangles.push_back({first, first + u + v, first + v});
        mesh.triangles.push_back({minus, minus + u + v, minus + u});
        mesh.triangles.push_back({minus, minus + v, minus + u + v});
      }
    }
    return mesh;
  }

  void addBoxes() {
    auto part = run_.stage.parts.begin();
    for (std::size_t body = 0; body < run_.tracks.size(); ++body) {
      const Body& box = run_.world.bodies[body];
      const std::size_t node = nodes_.size();
      const bool isPart = part != run_.stage.parts.end() && part->body == body;
      const bool isMesh = isPart || !box.parts.empty();
      const Color& color = run_.stage.colors[body];
      nodes_.push_back({{"name", names_.unique(box.name)},
                        {"mesh", isMesh ? partMesh(isPart ? part->mesh : meshOfBoxes(box), paintOf(color))
                                        : boxMesh(color)},
                        {"scale", floatsOf(isMesh ? Vec3(Vec3::Ones()) : box.halfExtents)},
                        {"extras", {{"name", box.name}, {"mass", box.mass.mass}}}});
      part += isPart ? 1 : 0;
      animation_.moveWithBody(node, nodes_[node], body);
    }
  }

  void addSurfaces() {
    std::size_t number = 0;
    for (const Surface& surface : surfacesOf(run_.stage, extentOf(run_), materials_, wallReachesOf(run_))) {
      if (surface.outline.empty()) {
        continue;  // it moves by itself, and begins outside
      }
      const Plane* const moving =
          surface.plane >= 0 ? &run_.stage.planes[static_cast<std::size_t>(surface.plane)] : nullptr;
      const Pose frame = moving != nullptr ? moving->frameAt(0) : Pose{};
      std::vector<float> positions;
      std::vector<float> normals;
      std::vector<std::uint16_t> indices;
      for (std::size_t i = 0; i < surface.outline.size(); ++i) {
        const Vec3& place = surface.outline[i];
        appendFloats(positions, moving == nullptr
                                    ? place
                                    : Vec3(frame.worldFromBody.transpose() * (place - frame.position)));
        appendFloats(normals, moving == nullptr ? surface.normal : moving->normal);
        if (i >= 2) {
          for (const std::size_t corner : {std::size_t{0}, i - 1, i}) {
            indices.push_back(static_cast<std::uint16_t>(corner));
          }
        }
      }
      const double roughness =
          surface.covering == Covering::kTiles ? materials_.tileRoughness : materials_.wallRoughness;
      meshes_.push_back(
          {{"primitives",
            {{{"attributes",
               {{"POSITION", buffer_.addFloats(GltfBuffer::Kind::kVec3, positions, true, kVertices)},
                {"NORMAL", buffer_.addFloats(GltfBuffer::Kind::kVec3, normals, false, kVertices)}}},
              {"indices", buffer_.addIndices(indices)},
              {"material", material(surface.color, roughness)}}}}});
      nodes_.push_back(
          {{"name", names_.unique("wall " + std::to_string(number++))}, {"mesh", meshes_.size() - 1}});
      if (moving != nullptr) {
        animation_.moveWithCourse(nodes_.size() - 1, nodes_.back(), moving->course);
      }
    }
  }

  // From 0 to 1 along z.
  std::size_t lineMesh() {
    if (!line_) {
      line_ = meshes_.size();
      const std::size_t ends =
          buffer_.addFloats(GltfBuffer::Kind::kVec3, {0, 0, 0, 0, 0, 1}, true, kVertices);
      meshes_.push_back({{"primitives",
                          {{{"attributes", {{"POSITION", ends}}},
                            {"mode", kLines},
                            {"material", material(Vec3::Constant(0.1), 1)}}}}});
    }
    return *line_;
  }

  void addLine(const std::string& name, const SpringEnd& from, const SpringEnd& to) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({{"name", names_.unique(name)}, {"mesh", lineMesh()}});
    animation_.moveWithLine(node, nodes_[node], from, to);
  }

  // Springs, rods and ropes. In glTF nothing vanishes: joints that are released are left out.
  void addLines() {
    std::size_t number = 0;
    for (const Spring& spring : run_.world.springs) {
      addLine("spring " + std::to_string(number++), spring.from, spring.to);
    }
    for (const Joint& joint : run_.world.joints) {
      const bool isLine = joint.kind == Joint::Kind::kRod || joint.kind == Joint::Kind::kRope;
      if (isLine && joint.until > run_.settings.duration) {
        addLine(joint.name, {.body = joint.from.body, .point = joint.from.point},
                {.body = joint.to.body, .point = joint.to.point});
      }
    }
  }

  void addCamera() {
    const PictureSettings& picture = run_.stage.picture;
    const CameraPath path(run_, run_.stage.timeMap.within(run_.settings.duration), picture.aspect());
    const Camera first = path.at(0);
    const View view = viewOf(first, extentOf(run_), picture.aspect());
    // Of the projection's matrix: near and far from (n+f)/(n−f) and 2nf/(n−f).
    const double sum = (view.clipFromOffset.row(2).head<3>() * view.worldFromCamera)(2);
    const double product = view.clipFromOffset(2, 3);
    camera_ = {{"type", "perspective"},
               {"perspective",
                {{"yfov", first.fovDegrees * std::numbers::pi / 180},
                 {"aspectRatio", picture.aspect()},
                 {"znear", product / (sum - 1)},
                 {"zfar", product / (sum + 1)}}}};
    const std::size_t node = nodes_.size();
    nodes_.push_back({{"name", names_.unique("camera")}, {"camera", 0}});
    animation_.moveBy(
        node, nodes_[node], [&](double time) { return path.at(time).eye; },
        [&](double time) {
          const Camera camera = path.at(time);
          return Quat(lookAt(camera.eye, camera.target, camera.up)).normalized();
        });
  }

  Json document() const {
    Json whole = {{"asset",
                   {{"version", "2.0"},
                    {"generator", settings_.program},
                    {"extras",
                     {{"within", settings_.within},
                      {"marks", materials_.marks},
                      {"position_error_m", file_.positionError},
                      {"attitude_error_rad", file_.attitudeError},
                      {"scene_hash", run_.sceneHash()},
                      {"state_hash", run_.stateHash()}}}}},
                  {"scene", 0},
                  {"scenes", {{{"nodes", {0}}}}},
                  {"nodes", nodes_},
                  {"meshes", meshes_},
                  {"materials", materialsWritten_},
                  {"cameras", {camera_}}};
    if (const Json animations = animation_.json(); !animations.is_null()) {
      whole["animations"] = animations;
    }
    return whole;
  }

  const Trajectory& run_;
  const ExportSettings& settings_;
  Materials materials_;
  GltfBuffer buffer_;
  GltfAnimation animation_;
  NodeNames names_;
  GlbFile file_;
  Json nodes_ = Json::array();
  Json meshes_ = Json::array();
  Json materialsWritten_ = Json::array();
  Json camera_;
  Json cube_;
  std::optional<std::size_t> line_;
  std::map<std::array<double, 4>, std::size_t> materialIndices_;
  std::map<std::size_t, std::size_t> boxMeshes_;  // by material
};

}  // namespace

void checkGlbError(double within) {
  if (!(within >= kLeastGlbError && within <= kMostGlbError)) {
    throw InputError("found " + brief(within) + ", expected " + brief(kLeastGlbError) + " to " +
                     brief(kMostGlbError));
  }
}

GlbFile encodeGlb(const Trajectory& run, const ExportSettings& settings) {
  checkGlbError(settings.within);
  return GlbWriter(run, settings).file();
}

constexpr Exporter kGlbExporter = {
    .suffix = ".glb",
    .about = "a film for Blender, three.js and viewers of glTF",
    .option = ExportOption::kWithin,
    .write = [](const Trajectory& run, const ExportSettings& settings, const TextSink& sink) -> ExportNotes {
      const GlbFile glb = encodeGlb(run, settings);
      sink(glb.bytes);
      return {"keys         " + std::to_string(glb.keys) + ", " + std::to_string(glb.bytes.size()) +
              " bytes; off by at most " + brief(glb.positionError, 2) + " m and " +
              brief(glb.attitudeError, 2) + " rad"};
    }};

}  // namespace careen
