#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "core/system/file.h"
#include "library/careen.h"
#include "library/translated.h"
#include "physics/world/control.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "runs/source.h"

namespace careen::v1 {
namespace {

using Json = nlohmann::ordered_json;

// Of a box or a wall, if it moves.
template <class Part>
void addSurface(const Part& part, Json& json) {
  if (part.surfaceVelocity != Vector{}) {
    json["surface_velocity"] = part.surfaceVelocity;
  }
  if (part.surfaceSpin != 0) {
    json["surface_spin"] = part.surfaceSpin;
  }
}

Json pathOf(const std::vector<std::pair<double, Vector>>& path) {
  Json points = Json::array();
  for (const auto& [time, vector] : path) {
    points.push_back({time, vector[0], vector[1], vector[2]});
  }
  return points;
}

Json motionOf(const Motion& motion) {
  Json json = Json::object();
  const auto add = [](Json& to, const char* key, const Vector& vector) {
    if (vector != Vector{}) {
      to[key] = vector;
    }
  };
  if (!motion.path.empty()) {
    json["path"] = pathOf(motion.path);
  }
  add(json, "velocity", motion.velocity);
  add(json, "angular_velocity", motion.angularVelocity);
  if (motion.about) {
    json["about"] = *motion.about;
  }
  if (motion.amplitude != Vector{} || motion.angularAmplitude != Vector{} || motion.frequency != 0 ||
      motion.phase != 0) {
    Json& swing = json["oscillation"] = {{"frequency", motion.frequency}, {"phase", motion.phase}};
    add(swing, "amplitude", motion.amplitude);
    add(swing, "angular_amplitude", motion.angularAmplitude);
  }
  return json;
}

// Whose path tells the place, which is the key `place`.
void addMotion(const std::optional<Motion>& motion, const char* place, Json& json) {
  if (!motion) {
    return;
  }
  json["motion"] = motionOf(*motion);
  if (!motion->path.empty() && json[place] == Json(Vector{})) {
    json.erase(place);
  }
}

}  // namespace

Scene::Scene(double duration, Vector gravity) : name_("scene"), built_(true) {
  text_ = Json{{"careen", 1}, {"duration", duration}, {"gravity", gravity}}.dump();
}

Scene Scene::read(const std::filesystem::path& path) {
  return translated(path.string(), [&] {
    std::vector<std::string> notes;
    SceneText read =
        sceneTextOf(path, readFile(path), [&](const std::string& note) { notes.push_back(note); });
    Scene scene(std::move(read.name), std::move(read.text));
    scene.notes_ = std::move(notes);
    return scene;
  });
}

Scene Scene::parse(std::string text, std::string name) { return {std::move(name), std::move(text)}; }

void Scene::requireBuilt() const {
  if (!built_) {
    throw Error(name_ + ": found a scene of a file, expected one that was begun in code");
  }
}

Scene& Scene::gravity(const std::vector<std::pair<double, Vector>>& path) {
  requireBuilt();
  Json json = Json::parse(text_);
  json["gravity"] = {{"path", pathOf(path)}};
  text_ = json.dump();
  return *this;
}

Scene& Scene::gravityThrough(const std::vector<std::pair<double, Vector>>& path) {
  gravity(path);
  Json json = Json::parse(text_);
  json["gravity"]["linear"] = true;
  text_ = json.dump();
  return *this;
}

Scene& Scene::add(const Box& box) {
  requireBuilt();
  Json json = {{"mass", box.mass},
               {"position", box.position},
               {"orientation", box.orientation},
               {"velocity", box.velocity},
               {"angular_velocity", box.angularVelocity},
               {"restitution", box.restitution},
               {"friction", box.friction},
               {"fixed", box.fixed}};
  if (box.parts.empty()) {
    json["half_extents"] = box.halfExtents;
  }
  for (const BoxPart& part : box.parts) {
    json["parts"].push_back(
        {{"half_extents", part.halfExtents}, {"position", part.position}, {"orientation", part.orientation}});
  }
  if (box.inertia) {
    json["inertia"] = *box.inertia;
  }
  if (box.center != Vector{}) {
    json["center"] = box.center;
  }
  addSurface(box, json);
  addMotion(box.motion, "position", json);
  if (!box.name.empty()) {
    json["name"] = box.name;
  }
  boxes_.push_back(json.dump());
  return *this;
}

Scene& Scene::add(const Wall& wall) {
  requireBuilt();
  Json json = {{"point", wall.point},
               {"normal", wall.normal},
               {"restitution", wall.restitution},
               {"friction", wall.friction}};
  addSurface(wall, json);
  addMotion(wall.motion, "point", json);
  if (!wall.name.empty()) {
    json["name"] = wall.name;
  }
  walls_.push_back(json.dump());
  return *this;
}

Scene& Scene::method(const std::string& name) {
  if (!methodNamed(name)) {
    throw SceneError("found the unknown method '" + name + "'", "", 0, 0);
  }
  method_ = name;
  return *this;
}

Scene& Scene::tolerance(double metres) {
  if (!(metres > 0 && metres < 1)) {
    throw SceneError(
        "found the tolerance " + std::to_string(metres) + ", expected more than 0 and less than 1 m", "", 0,
        0);
  }
  tolerance_ = metres;
  return *this;
}

Scene& Scene::step(double seconds) {
  step_ = seconds;
  return *this;
}

Scene& Scene::duration(double seconds) {
  duration_ = seconds;
  return *this;
}

Scene& Scene::allowOverlap() {
  allowsOverlap_ = true;
  return *this;
}

Scene& Scene::until(const std::string& statement) {
  until_ = statement;
  return *this;
}

Scene& Scene::threads(int count) {
  if (count < 1 || count > kMostThreadsOfCrowds) {
    throw Error("found " + std::to_string(count) + " threads, expected 1 to " +
                std::to_string(kMostThreadsOfCrowds));
  }
  threads_ = count;
  return *this;
}

Scene& Scene::control(double period, Controller controller) {
  if (!(period > 0 && std::isfinite(period))) {
    throw Error("found the period " + std::to_string(period) + " s of a controller, expected more than 0");
  }
  period_ = period;
  controller_ = std::move(controller);
  return *this;
}

std::string Scene::text() const {
  if (!built_) {
    return text_;
  }
  Json json = Json::parse(text_);
  const auto list = [&json](const char* key, const std::vector<std::string>& items) {
    for (const std::string& item : items) {
      json[key].push_back(Json::parse(item));
    }
  };
  list("walls", walls_);
  list("boxes", boxes_);
  return json.dump(1);
}

}  // namespace careen::v1
