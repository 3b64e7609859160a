#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "physics/exact/exact_world.h"
#include "physics/simulate.h"

namespace careen {

/// What a run sent to its recorder.
struct Recorded {
  RunFigures figures;
  std::vector<Impact> impacts;
  std::vector<JointImpulse> passed;
  std::vector<JointEffort> driven;
  std::vector<std::vector<std::pair<double, Motion>>> motions;  // of each body

  /// Number of different impact times: a face that lands is one, its corners are four rows.
  std::size_t moments() const {
    std::set<double> times;
    for (const Impact& impact : impacts) {
      times.insert(impact.time);
    }
    return times.size();
  }
  BodyState last(const World& world, std::size_t body, double duration) const {
    const auto& [start, motion] = motions[body].back();
    return stateAt(motion, world.bodies[body].mass, duration - start);
  }
  BodyState at(const World& world, std::size_t body, double time) const {
    const auto next = std::upper_bound(motions[body].begin() + 1, motions[body].end(), time,
                                       [](double moment, const auto& each) { return moment < each.first; });
    const auto& [start, motion] = *(next - 1);
    return stateAt(motion, world.bodies[body].mass, time - start);
  }
};

class Notes : public Recorder {
 public:
  explicit Notes(Recorded& run) : run_(run) {}
  void moves(BodyIndex body, double time, const Motion& motion) override {
    run_.motions[static_cast<std::size_t>(body.value)].emplace_back(time, motion);
  }
  void strikes(const Impact& impact) override { run_.impacts.push_back(impact); }
  void drives(const JointEffort& effort) override { run_.driven.push_back(effort); }
  void passes(const JointImpulse& impulse) override { run_.passed.push_back(impulse); }

 private:
  Recorded& run_;
};

inline Recorded runBy(const World& world, const RunSettings& settings) {
  Recorded run;
  run.motions.resize(world.bodies.size());
  Notes notes(run);
  run.figures = simulate(world, settings, notes);
  return run;
}
inline Recorded runFor(const World& world, double duration) { return runBy(world, {.duration = duration}); }
/// All that touch step as a crowd.
inline Recorded runInCrowd(const World& world, double duration) {
  return runBy(world, {.duration = duration, .crowds = {.when = CrowdSettings::When::kAbove}});
}

inline Body box(const std::string& name, const Vec3& halfExtents, double mass, const Vec3& position,
                const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero(),
                double restitution = 1) {
  Body body;
  body.name = name;
  body.halfExtents = halfExtents;
  body.mass = solidBox(halfExtents, mass);
  body.material.restitution = restitution;
  body.initial.pose.position = position;
  body.initial.velocity = velocity;
  body.initial.angularMomentum = angularMomentum(body.mass, body.initial.pose.worldFromBody, spin);
  return body;
}

inline Wall wall(const std::string& name, const Vec3& normal, double offset, double restitution = 1) {
  return {.name = name,
          .normal = normal,
          .offset = offset,
          .material = {.restitution = restitution, .friction = 0}};
}

/// One crate in a closed room, e = 1.
inline World elasticRoom() {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {wall("-x", Vec3(1, 0, 0), -3), wall("+x", Vec3(-1, 0, 0), -3),
                 wall("-y", Vec3(0, 1, 0), -2), wall("+y", Vec3(0, -1, 0), -2),
                 wall("-z", Vec3(0, 0, 1), 0),  wall("+z", Vec3(0, 0, -1), -6)};
  world.bodies = {box("crate", Vec3(0.5, 0.3, 0.2), 1, Vec3(0, 0, 3), Vec3(3, 2, 1), Vec3(3, 7, -2))};
  return world;
}

/// Kinetic and potential [J].
inline double energyOf(const World& world, std::size_t body, const BodyState& state) {
  const MassProperties& mass = world.bodies[body].mass;
  return 0.5 * mass.mass * state.velocity.squaredNorm() +
         0.5 * angularVelocity(mass, state).dot(state.angularMomentum) -
         mass.mass * world.gravity.dot(state.pose.position);
}

}  // namespace careen
