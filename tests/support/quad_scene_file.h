#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "support/quad_scene.h"

namespace careen::oracle {

inline std::string textOf(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) {
    throw std::runtime_error("no file " + path.string());
  }
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// JSON with // comments.
inline nlohmann::json jsonIn(const std::filesystem::path& path) {
  return nlohmann::json::parse(textOf(path), nullptr, true, true);
}

inline QuadVector vectorIn(const nlohmann::json& object, const char* key) {
  if (!object.contains(key)) {
    return {Quad(0), Quad(0), Quad(0)};
  }
  const nlohmann::json& v = object[key];
  return {Quad(v.at(0).get<double>()), Quad(v.at(1).get<double>()), Quad(v.at(2).get<double>())};
}

/// Places or vectors from each time on: [[time, x, y, z], …].
inline std::vector<std::pair<Quad, QuadVector>> pathIn(const nlohmann::json& object) {
  std::vector<std::pair<Quad, QuadVector>> path;
  for (const nlohmann::json& each : object.value("path", nlohmann::json::array())) {
    const nlohmann::json vector = {{"v", {each.at(1), each.at(2), each.at(3)}}};
    path.emplace_back(Quad(each.at(0).get<double>()), vectorIn(vector, "v"));
  }
  return path;
}

/// Of a fixed box; without turning.
inline void readMotion(const nlohmann::json& motion, QuadBox& box) {
  box.velocity = vectorIn(motion, "velocity");
  box.path = pathIn(motion);
  if (!box.path.empty()) {
    box.position = box.path.front().second;
  }
  const nlohmann::json swing = motion.value("oscillation", nlohmann::json::object());
  box.amplitude = vectorIn(swing, "amplitude");
  box.rate = 2 * quadPi() * Quad(swing.value("frequency", 0.0));
  box.phase = swing.value("phase", 0.0);
}

inline QuadBox boxIn(const nlohmann::json& object) {
  QuadBox box;
  box.name = object.at("name").get<std::string>();
  box.halfExtents = vectorIn(object, "half_extents");
  box.mass = object.value("mass", 0.0);
  box.restitution = object.value("restitution", 0.0);
  box.friction = object.value("friction", 0.0);
  box.fixed = object.value("fixed", false);
  box.position = vectorIn(object, "position");
  box.velocity = vectorIn(object, "velocity");
  if (object.contains("motion")) {
    readMotion(object["motion"], box);
  }
  if (object.contains("orientation")) {
    const nlohmann::json& q = object["orientation"];
    for (std::size_t i = 0; i < 4; ++i) {
      box.attitude.at(i) = q.at(i).get<double>();
    }
    box.attitude = normalized(box.attitude);
  }
  const QuadVector squares = box.halfExtents.cwiseProduct(box.halfExtents);
  const QuadVector spin = turned(inverse(box.attitude), vectorIn(object, "angular_velocity"));
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    box.moments.at(at) = object.contains("inertia")
                             ? Quad(object["inertia"].at(at).get<double>())
                             : Quad(box.mass / 3 * (squares[(i + 1) % 3] + squares[(i + 2) % 3]));
    box.momentum.at(at) = box.moments.at(at) * spin[i];
  }
  return box;
}

/// Joints, and the one motor.
inline void readJoints(const nlohmann::json& file, QuadScene& scene) {
  for (const nlohmann::json& each : file.value("joints", nlohmann::json::array())) {
    QuadJoint joint{.at = vectorIn(each, "at")};
    if (each.contains("points")) {
      joint.at = vectorIn(nlohmann::json{{"end", each["points"].at(1)}}, "end");
    }
    joint.length = each.value("length", 0.0);
    joint.restitution = each.value("restitution", 0.0);
    joint.start = each.value("start", 0.0);
    joint.stiffness = each.value("/spring/stiffness"_json_pointer, 0.0);
    joint.damping = each.value("damping", 0.0);
    scene.joints.push_back(joint);
  }
  if (file.contains("control")) {
    scene.period = file["control"].at("period").get<double>();
    const nlohmann::json& motor = file["control"].at("motors").at(0);
    for (const nlohmann::json& joint : file["joints"]) {
      const nlohmann::json gains = motor.value("gains", nlohmann::json::object());
      for (const nlohmann::json& gain : gains.value(joint.value("name", ""), nlohmann::json::array())) {
        scene.gains.emplace_back(gain.get<double>());
      }
    }
    scene.target = motor.value("target", 0.0);
    scene.kp = motor.value("kp", 0.0);
    scene.kd = motor.value("kd", 0.0);
  }
}

/// Reads the part of the format used by the hard cases: orientations as quaternions, every box with a mass
/// or fixed, inertia as three moments. The numbers are exactly the doubles to which the file's decimals
/// round.
inline QuadScene sceneIn(const std::filesystem::path& path) {
  const nlohmann::json file = jsonIn(path);
  QuadScene scene;
  scene.duration = file.at("duration").get<double>();
  if (file.contains("/gravity/path"_json_pointer)) {
    scene.gravities = pathIn(file["gravity"]);
    scene.gravity = scene.gravities.front().second;
  } else {
    scene.gravity = vectorIn(file, "gravity");
  }
  if (file.contains("room")) {
    const nlohmann::json& room = file["room"];
    const nlohmann::json open = room.value("open", nlohmann::json::array());
    const std::array<const char*, 6> sides = {"-x", "+x", "-y", "+y", "-z", "+z"};
    for (std::size_t side = 0; side < sides.size(); ++side) {
      if (std::find(open.begin(), open.end(), sides.at(side)) != open.end()) {
        continue;
      }
      const bool isMin = side % 2 == 0;
      const auto axis = static_cast<Eigen::Index>(side / 2);
      const Quad sign = isMin ? 1 : -1;
      QuadWall wall;
      wall.normal = QuadVector(Quad(0), Quad(0), Quad(0));
      wall.normal[axis] = sign;
      wall.offset = sign * vectorIn(room, isMin ? "min" : "max")[axis];
      wall.restitution = room.value("restitution", 0.0);
      wall.friction = room.value("friction", 0.0);
      scene.walls.push_back(wall);
    }
  }
  for (const nlohmann::json& each : file.value("walls", nlohmann::json::array())) {
    QuadWall wall;
    wall.normal = vectorIn(each, "normal");
    wall.normal /= wall.normal.norm();
    wall.offset = wall.normal.dot(vectorIn(each, "point"));
    wall.restitution = each.value("restitution", 0.0);
    wall.friction = each.value("friction", 0.0);
    wall.belt = vectorIn(each, "surface_velocity");
    wall.spin = each.value("surface_spin", 0.0);
    scene.walls.push_back(wall);
  }
  for (const nlohmann::json& each : file.at("boxes")) {
    scene.boxes.push_back(boxIn(each));
  }
  readJoints(file, scene);
  return scene;
}

}  // namespace careen::oracle
