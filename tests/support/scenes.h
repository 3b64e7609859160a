#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace careen {

/// A scene that uses every key.
inline const std::string kEveryKey = R"({
  "$schema": "../scene.schema.json",
  "careen": 1,
  "name": "every key",
  "duration": 2.5,
  "gravity": [0, 0, -9.81],
  "room": { "min": [-3, -2, 0], "max": [3, 2, 4], "open": ["-y", "+z"], "restitution": 0.5, "friction": 0.25 },
  "walls": [
    { "name": "ramp", "point": [-3, 0, 1], "normal": [1, 0, 2], "restitution": 1, "friction": 0.125 },
    { "point": [0, 0, 4], "normal": [0, 0, -0.5] }
  ],
  "boxes": [
    { "name": "crate", "half_extents": [0.5, 0.25, 0.125], "mass": 2, "position": [1, 0.5, 2],
      "orientation": { "axis": [0, 0, 2], "angle_deg": 90 }, "velocity": [6, 1.5, 0], "angular_velocity": [3, 7, -2],
      "restitution": 0.75, "friction": 0.5, "fixed": false, "color": "#C8553d" },
    { "half_extents": [0.5, 0.5, 0.5], "density": 8, "inertia": [1, 2, 2.25], "position": [0, 0, 2],
      "orientation": [2, 0, 0, 0] },
    { "name": "post", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [2, 1, 0.5], "velocity": [0, 0, 0] }
  ],
  "springs": [
    { "from": ["crate", [0.5, 0.25, 0.125]], "to": [-1.5, 0, 3], "stiffness": 0.75, "damping": 0.5, "rest_length": 1 },
    { "from": ["box-1", [0, 0, 0]], "to": ["post", [0, 0, 0.1]], "stiffness": 2 }
  ],
  "drag": { "linear": 0.5, "angular": 0.25 },
  "method": "listing1",
  "dt": 0.001,
  "tolerance": 1e-9,
  "camera": { "eye": [6, -8, 4], "target": [0, 0, 1], "up": [0, 0, 4], "fov_deg": 35,
              "orbit": { "deg_per_s": 20 }, "follow": "crate" },
  "film": { "size": [640, 360], "fps": 23.976, "antialiasing": "4x", "time": [[0, 0.75], [1, 0.75], [3, 2.25]],
            "shutter_deg": 90, "shutter_samples": 4 },
  "look": "clay",
  "overlays": ["time", "energy"]
})";

/// A scene with every type of joint, and all their keys.
inline const std::string kJoints = R"({
  "careen": 1,
  "duration": 2,
  "boxes": [
    { "name": "crate", "half_extents": [0.5, 0.25, 0.125], "mass": 2, "position": [1, 0.5, 2],
      "orientation": { "axis": [0, 0, 1], "angle_deg": 90 }, "center": [0.125, 0, 0] },
    { "name": "lid", "half_extents": [0.5, 0.25, 0.125], "mass": 1, "position": [1, 0.5, 2.125] },
    { "name": "bob", "half_extents": [0.125, 0.125, 0.125], "mass": 1, "position": [1, 0.5, 4] },
    { "name": "post", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [3, 1, 0.5] },
    { "name": "rock", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [5, 1, 0.5] }
  ],
  "joints": [
    { "name": "knee", "type": "hinge", "between": ["lid", "crate"], "at": [1, 1, 2], "axis": [0, 0, 2],
      "range": [-0.5, 2.25], "start": 0, "spring": { "stiffness": 20, "rest": 0.3 }, "damping": 0.7, "friction": 1.25,
      "restitution": 0.5, "collide": false },
    { "type": "slider", "between": ["world", "bob"], "at": [1, 0.5, 4], "axis": [1, 0, 0], "range": [0, 2],
      "drive": { "speed": -0.375, "max": 45 }, "until": 1.5 },
    { "type": "ball", "between": ["bob", "post"], "at": [2, 1, 3], "collide": true },
    { "name": "weld", "type": "fixed", "between": ["post", "lid"] },
    { "name": "stick", "type": "rod", "between": ["crate", "bob"], "points": [[0, 0, 0.125], [0, 0, -0.125]],
      "length": 1.75, "until": 1 },
    { "name": "string", "type": "rope", "between": ["world", "bob"], "points": [[1, 0.5, 6], [0, 0, 0]],
      "length": 2.5, "restitution": 0.25 }
  ],
  "pass_through": [["bob", "crate", "lid"], ["rock", "bob"]],
  "control": { "period": 0.125, "motors": [
    { "joint": "knee", "max": 40, "target": { "sine": [0, 0.2, 2, 1], "ramp": 0.75 }, "kp": 120, "kd": 4 },
    { "joint": "joint-1", "target": { "path": [[0, 0], [1, 0.1]] }, "gains": { "knee": [-3, 1], "joint-1": [2, 0] } },
    { "joint": "knee", "target": 0.3, "kd": 1 } ] }
})";

/// A scene with all that may be said of how it is shown and that the first one leaves out.
inline const std::string kShown = R"({
  "careen": 1,
  "duration": 2,
  "boxes": [ { "name": "crate", "half_extents": [0.5, 0.25, 0.125], "mass": 2, "color": "skyblue", "material": "metal" } ],
  "room": { "min": [-3, -3, -3], "max": [3, 3, 3], "material": { "modulus": 1e9, "density": 500, "damping": 0.125 } },
  "walls": [ { "name": "ramp", "point": [0, 0, -2], "normal": [0, 1, 1], "material": "plastic" } ],
  "camera": { "keys": [ { "time": 0, "eye": [6, -8, 4], "target": [0, 0, 1] },
                        { "time": 2, "eye": [6, -4, 4], "target": [0, 0, 1] } ],
              "easing": "linear", "f_stop": 0.125, "focus": "crate", "focus_samples": 5 },
  "light": { "parts": ["shadows"], "direction": [0, 3, -4], "size_deg": 8, "color": "#ffe0c0",
             "ambient": ["#405060", "black"] },
  "background": "ivory",
  "marks": false,
  "gloss": 0.75,
  "titles": [ { "time": [0, 1.5], "text": "A box careens\noff a wall", "place": "top" },
              { "time": [0.5, 1], "text": "Part 4" } ]
})";

/// A scene with all that moves by itself, bodies of other shapes, and the rest of the keys.
inline const std::string kMoved = R"({
  "careen": 1,
  "duration": 2,
  "gravity": { "path": [[0, 0, 0, -10], [1, 1, 0, -9]], "linear": true },
  "crowds": { "when": 40, "tolerance": 1e-3 },
  "walls": [
    { "name": "belt", "point": [0, 0, 0], "normal": [0, 0, 1], "surface_velocity": [0.5, 0, 0], "surface_spin": 2 },
    { "name": "press", "normal": [0, 0, -1], "motion": { "path": [[0, 0, 0, 9], [2, 0, 0, 8]] } }
  ],
  "boxes": [
    { "name": "beam", "half_extents": [1, 0.1, 0.1], "fixed": true, "position": [0, 0, 5],
      "motion": { "velocity": [0, 0, 0.25], "angular_velocity": [0, 0, 1], "about": [1, 0, 5] } },
    { "name": "sieve", "half_extents": [1, 1, 0.1], "fixed": true, "position": [4, 0, 5],
      "motion": { "oscillation": { "frequency": 2, "phase": 0.5, "amplitude": [0.1, 0, 0],
                                   "angular_amplitude": [0, 0.1, 0] } } },
    { "name": "tee", "density": 500, "position": [-4, 0, 5],
      "parts": [ { "half_extents": [0.5, 0.1, 0.1] },
                 { "half_extents": [0.1, 0.1, 0.5], "position": [0, 0, -0.5],
                   "orientation": { "axis": [0, 0, 1], "angle_deg": 45 } } ] },
    { "name": "duck", "half_extents": [0.5, 0.5, 0.5], "density": 500, "position": [-4, 4, 5],
      "mass_from": "duck.obj", "draw": "duck.obj" }
  ]
})";

/// A scene with one piece of text, which must occur exactly once, replaced by another.
inline std::string sceneBut(const std::string& scene, const std::string& piece, const std::string& instead) {
  const std::size_t at = scene.find(piece);
  if (at == std::string::npos || scene.find(piece, at + 1) != std::string::npos) {
    throw std::logic_error("not there exactly once: " + piece);
  }
  return std::string(scene).replace(at, piece.size(), instead);
}
inline std::string everyKeyBut(const std::string& piece, const std::string& instead) {
  return sceneBut(kEveryKey, piece, instead);
}

/// An edit that makes the scene invalid, and the resulting message.
struct BadPiece {
  const char* piece;
  const char* instead;  ///< '@' marks the place the message points at
  std::string message;
};

/// A text with a place marked by '@': the text without it, and the place as in messages. ASCII up to there.
struct MarkedText {
  explicit MarkedText(const std::string& marked) : text(marked) {
    const std::size_t at = marked.find('@');
    if (at == std::string::npos) {
      throw std::logic_error("no place is marked");
    }
    text.erase(at, 1);
    std::size_t line = 1;
    std::size_t column = 1;
    for (std::size_t i = 0; i < at; ++i) {
      const bool ends = marked[i] == '\n';
      line += ends ? 1 : 0;
      column = ends ? 1 : column + 1;
    }
    place = std::to_string(line) + ":" + std::to_string(column);
  }

  std::string text;
  std::string place;
};

}  // namespace careen
