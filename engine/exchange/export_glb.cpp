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
#include <variant>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "exchange/animation_keys.h"
#include "exchange/gltf_buffer.h"
#include "view/camera.h"
#include "view/camera_path.h"
#include "view/materials.h"
#include "view/scene_extent.h"
#include "view/surfaces.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVertices = 34962;  // target of a view
constexpr int kLines = 1;         // mode of a primitive

void append(std::vector<float>& numbers, const Vec3& value) {
  for (const double number : {value.x(), value.y(), value.z()}) {
    numbers.push_back(static_cast<float>(number));
  }
}

Json jsonOf(const Vec3& value) {
  return {static_cast<float>(value.x()), static_cast<float>(value.y()), static_cast<float>(value.z())};
}
Json jsonOf(const Quat& value) {
  return {static_cast<float>(value.x()), static_cast<float>(value.y()), static_cast<float>(value.z()),
          static_cast<float>(value.w())};
}

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
  GlbWriter(const Trajectory& run, const GlbSettings& settings)
      : run_(run),
        settings_(settings),
        clock_(run.stage.timeMap.within(run.settings.duration)),
        materials_(materialsOf(run.stage.picture.look)) {}

  GlbFile file() {
    nodes_.push_back({{"name", ""}, {"rotation", jsonOf(Quat(std::sqrt(0.5), -std::sqrt(0.5), 0, 0))}});
    addBoxes();
    addSurfaces();
    addSprings();
    addCamera();
    nodes_[0]["name"] = names_.unique(run_.stage.name);
    for (std::size_t node = 1; node < nodes_.size(); ++node) {
      nodes_[0]["children"].push_back(node);
    }
    file_.bytes = buffer_.pack(document());
    return std::move(file_);
  }

 private:
  // ---- Times

  double sceneTime(double filmTime) const { return clock_.sceneTime(filmTime); }

  // The film times at which these scene times are shown.
  std::vector<double> filmTimes(const std::vector<double>& sceneTimes) const {
    std::vector<double> times;
    for (std::size_t i = 0; i + 1 < clock_.keys.size(); ++i) {
      const TimeKey& from = clock_.keys[i];
      const TimeKey& to = clock_.keys[i + 1];
      if (to.scene > from.scene) {
        const auto first = std::lower_bound(sceneTimes.begin(), sceneTimes.end(), from.scene);
        const auto last = std::upper_bound(first, sceneTimes.end(), to.scene);
        for (auto time = first; time != last; ++time) {
          times.push_back(from.film + (*time - from.scene) / (to.scene - from.scene) * (to.film - from.film));
        }
      }
    }
    return times;
  }

  AnimatedSpan span(std::vector<double> sceneKinks, const std::vector<double>& sceneSeams) const {
    std::sort(sceneKinks.begin(), sceneKinks.end());
    AnimatedSpan span{
        .duration = clock_.duration(), .kinks = filmTimes(sceneKinks), .seams = filmTimes(sceneSeams)};
    for (const TimeKey& key : clock_.keys) {
      span.kinks.push_back(key.film);
    }
    std::sort(span.kinks.begin(), span.kinks.end());
    return span;
  }

  void addKinks(std::size_t body, std::vector<double>& kinks, std::vector<double>& seams) const {
    if (impactsOf_.empty()) {
      impactsOf_.resize(run_.tracks.size());
      for (const Impact& impact : run_.impacts) {
        impactsOf_[static_cast<std::size_t>(impact.a.value)].push_back(impact.time);
        if (!impact.b.isWall()) {
          impactsOf_[static_cast<std::size_t>(impact.b.body())].push_back(impact.time);
        }
      }
    }
    kinks.insert(kinks.end(), impactsOf_[body].begin(), impactsOf_[body].end());
    const std::vector<Segment>& segments = run_.tracks[body].segments;
    for (std::size_t i = 1; i < segments.size(); ++i) {
      const bool rests = std::holds_alternative<Rest>(segments[i].motion) ||
                         std::holds_alternative<Rest>(segments[i - 1].motion);
      (rests ? kinks : seams).push_back(segments[i].start);
    }
  }

  // ---- Animation

  std::size_t timesAccessor(const std::vector<float>& times) {
    return buffer_.addFloats(GltfBuffer::Kind::kScalar, times, true);
  }

  void addChannel(std::size_t node, const char* path, std::size_t times, std::size_t values) {
    const std::size_t sampler = samplers_.size();
    samplers_.push_back({{"input", times}, {"output", values}, {"interpolation", "LINEAR"}});
    channels_.push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  void animate(std::size_t node, const AnimationKeys<Vec3>& keys) {
    nodes_[node]["translation"] = jsonOf(keys.values.front());
    file_.positionError = std::max(file_.positionError, keys.error);
    if (keys.isConstant()) {
      return;
    }
    std::vector<float> numbers;
    for (const Vec3& value : keys.values) {
      append(numbers, value);
    }
    addChannel(node, "translation", timesAccessor(keys.times),
               buffer_.addFloats(GltfBuffer::Kind::kVec3, numbers, false));
    file_.keys += keys.times.size();
  }

  static void append4(std::vector<float>& numbers, const Quat& value) {
    append(numbers, value.vec());
    numbers.push_back(static_cast<float>(value.w()));
  }

  void animate(std::size_t node, const AnimationKeys<Quat>& keys) {
    nodes_[node]["rotation"] = jsonOf(keys.values.front());
    file_.attitudeError = std::max(file_.attitudeError, keys.error);
    if (keys.isConstant()) {
      return;
    }
    std::vector<float> numbers;
    for (const Quat& value : keys.values) {
      append4(numbers, value);
    }
    addChannel(node, "rotation", timesAccessor(keys.times),
               buffer_.addFloats(GltfBuffer::Kind::kVec4, numbers, false));
    file_.keys += keys.times.size();
  }

  void animate(std::size_t node, const AnimationKeys<LinePlacement>& keys) {
    const LinePlacement& first = keys.values.front();
    nodes_[node]["translation"] = jsonOf(first.from);
    nodes_[node]["rotation"] = jsonOf(first.worldFromLine);
    nodes_[node]["scale"] = jsonOf(Vec3(1, 1, first.length));
    file_.positionError = std::max(file_.positionError, keys.error);
    if (keys.isConstant()) {
      return;
    }
    std::vector<float> places;
    std::vector<float> turns;
    std::vector<float> scales;
    for (const LinePlacement& line : keys.values) {
      append(places, line.from);
      append4(turns, line.worldFromLine);
      append(scales, Vec3(1, 1, line.length));
    }
    const std::size_t times = timesAccessor(keys.times);
    addChannel(node, "translation", times, buffer_.addFloats(GltfBuffer::Kind::kVec3, places, false));
    addChannel(node, "rotation", times, buffer_.addFloats(GltfBuffer::Kind::kVec4, turns, false));
    addChannel(node, "scale", times, buffer_.addFloats(GltfBuffer::Kind::kVec3, scales, false));
    file_.keys += keys.times.size();
  }

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
          append(positions, normal + u * across + v * along);
          append(normals, normal);
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

  std::size_t boxMesh(const Color& color) {
    const Vec3 own = linearFromSrgb(color);
    const Vec3 seen = materials_.ownColor * own + (1 - materials_.ownColor) * materials_.boxColor;
    const std::size_t paint = material(seen, materials_.boxRoughness);
    const auto [found, isNew] = boxMeshes_.emplace(paint, meshes_.size());
    if (isNew) {
      Json primitive = cube();
      primitive["material"] = paint;
      meshes_.push_back({{"primitives", {primitive}}});
    }
    return found->second;
  }

  void addBoxes() {
    for (std::size_t body = 0; body < run_.tracks.size(); ++body) {
      const Body& box = run_.world.bodies[body];
      const std::size_t node = nodes_.size();
      nodes_.push_back({{"name", names_.unique(box.name)},
                        {"mesh", boxMesh(run_.stage.colors[body])},
                        {"scale", jsonOf(box.halfExtents)},
                        {"extras", {{"name", box.name}, {"mass", box.mass.mass}}}});
      std::vector<double> kinks;
      std::vector<double> seams;
      addKinks(body, kinks, seams);
      const AnimatedSpan times = span(std::move(kinks), seams);
      const auto pose = [this, body](double time) { return run_.state(body, sceneTime(time)).pose; };
      animate(node, positionKeys(times, settings_.within, [&](double time) { return pose(time).position; }));
      animate(node, rotationKeys(times, settings_.within,
                                 [&](double time) { return Quat(pose(time).worldFromBody).normalized(); }));
    }
  }

  void addSurfaces() {
    std::size_t number = 0;
    for (const Surface& surface : surfacesOf(run_.stage, extentOf(run_), materials_)) {
      std::vector<float> positions;
      std::vector<float> normals;
      std::vector<std::uint16_t> indices;
      for (std::size_t i = 0; i < surface.outline.size(); ++i) {
        append(positions, surface.outline[i]);
        append(normals, surface.normal);
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
    }
  }

  void addSprings() {
    std::optional<std::size_t> mesh;
    std::size_t number = 0;
    for (const Spring& spring : run_.world.springs) {
      if (!mesh) {
        mesh = meshes_.size();
        const std::size_t ends =
            buffer_.addFloats(GltfBuffer::Kind::kVec3, {0, 0, 0, 0, 0, 1}, true, kVertices);
        meshes_.push_back({{"primitives",
                            {{{"attributes", {{"POSITION", ends}}},
                              {"mode", kLines},
                              {"material", material(Vec3::Constant(0.1), 1)}}}}});
      }
      const std::size_t node = nodes_.size();
      nodes_.push_back({{"name", names_.unique("spring " + std::to_string(number++))}, {"mesh", *mesh}});
      std::vector<double> kinks;
      std::vector<double> seams;
      for (const SpringEnd& end : {spring.from, spring.to}) {
        if (end.body) {
          addKinks(static_cast<std::size_t>(*end.body), kinks, seams);
        }
      }
      std::sort(seams.begin(), seams.end());
      const auto end = [this](const SpringEnd& of, double time) {
        return of.body ? run_.state(static_cast<std::size_t>(*of.body), time).pose.worldPoint(of.point)
                       : of.point;
      };
      animate(node, lineKeys(span(std::move(kinks), seams), settings_.within, [&](double time) {
                const double moment = sceneTime(time);
                return linePlacement(end(spring.from, moment), end(spring.to, moment));
              }));
    }
  }

  void addCamera() {
    const PictureSettings& picture = run_.stage.picture;
    const CameraPath path(run_, clock_, picture.aspect());
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
    const AnimatedSpan times = span({}, {});
    animate(node, positionKeys(times, settings_.within, [&](double time) { return path.at(time).eye; }));
    animate(node, rotationKeys(times, settings_.within, [&](double time) {
              const Camera camera = path.at(time);
              return Quat(lookAt(camera.eye, camera.target, camera.up)).normalized();
            }));
  }

  Json document() const {
    Json whole = {{"asset",
                   {{"version", "2.0"},
                    {"generator", settings_.program},
                    {"extras",
                     {{"within", settings_.within},
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
    if (!channels_.empty()) {
      whole["animations"] = {{{"name", "film"}, {"samplers", samplers_}, {"channels", channels_}}};
    }
    return whole;
  }

  const Trajectory& run_;
  const GlbSettings& settings_;
  TimeMap clock_;
  Materials materials_;
  GltfBuffer buffer_;
  NodeNames names_;
  GlbFile file_;
  mutable std::vector<std::vector<double>> impactsOf_;  // times, of each body; made when first asked for
  Json nodes_ = Json::array();
  Json meshes_ = Json::array();
  Json materialsWritten_ = Json::array();
  Json samplers_ = Json::array();
  Json channels_ = Json::array();
  Json camera_;
  Json cube_;
  std::map<std::array<double, 4>, std::size_t> materialIndices_;
  std::map<std::size_t, std::size_t> boxMeshes_;  // by material
};

}  // namespace

GlbFile encodeGlb(const Trajectory& run, const GlbSettings& settings) {
  if (!(settings.within >= kLeastGlbError && settings.within <= kMostGlbError)) {
    throw InputError("found " + brief(settings.within) + ", expected " + brief(kLeastGlbError) + " to " +
                     brief(kMostGlbError));
  }
  return GlbWriter(run, settings).file();
}

}  // namespace careen
