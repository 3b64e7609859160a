#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// Parameters of a test's box; density of the 1997 sample.
struct BoxSpec {
  Vec3 halfExtents = Vec3::Constant(0.2);
  Vec3 position = Vec3::Zero();
  Mat3 worldFromBody = Mat3::Identity();
  Vec3 velocity = Vec3::Zero();
  Vec3 angularVelocity = Vec3::Zero();
  double restitution = 0;
  double density = 0.4;
  std::string name = "crate";
};

inline Body makeBox(const BoxSpec& spec) {
  Body body;
  body.name = spec.name;
  body.halfExtents = spec.halfExtents;
  body.mass = solidBox(spec.halfExtents, 8 * spec.density * spec.halfExtents.prod());
  body.material.restitution = spec.restitution;
  body.initial.pose = {.position = spec.position, .worldFromBody = spec.worldFromBody};
  body.initial.velocity = spec.velocity;
  body.initial.angularMomentum = angularMomentum(body.mass, spec.worldFromBody, spec.angularVelocity);
  return body;
}

/// Six walls facing inward, in the order of the scene file.
inline std::vector<Wall> roomWalls(const Vec3& min, const Vec3& max) {
  static constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  std::vector<Wall> walls;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter = kAxes.at(static_cast<std::size_t>(axis));
    walls.push_back(
        {.name = "room-" + letter, .normal = Vec3::Unit(axis), .offset = min[axis], .material = {}});
    walls.push_back(
        {.name = "room+" + letter, .normal = -Vec3::Unit(axis), .offset = -max[axis], .material = {}});
  }
  return walls;
}

inline Wall floorAt(double height) {
  return {.name = "floor", .normal = Vec3::UnitZ(), .offset = height, .material = {}};
}

/// Room of the 1997 sample, 8 m wide and centred.
inline World sampleRoom(Body body) {
  World world;
  world.walls = roomWalls(Vec3::Constant(-4), Vec3::Constant(4));
  world.bodies.push_back(std::move(body));
  return world;
}

/// Records everything it receives.
class Memory : public Recorder {
 public:
  struct Move {
    int body;
    double time;
    Motion motion;
  };
  void moves(BodyIndex body, double time, const Motion& motion) override {
    moved.push_back({.body = body.value, .time = time, .motion = motion});
    if (onMove) {
      onMove();
    }
  }
  void strikes(const Impact& impact) override { impacts.push_back(impact); }

  /// Last recorded state of a body: its final one after a run.
  BodyState last(int body = 0) const {
    const auto move =
        std::find_if(moved.rbegin(), moved.rend(), [body](const Move& each) { return each.body == body; });
    return move == moved.rend() ? BodyState{} : stateAt(move->motion, {}, 0);
  }

  std::vector<Move> moved;
  std::vector<Impact> impacts;
  std::function<void()> onMove;
};

}  // namespace careen
