#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "core/system/team.h"
#include "physics/pile/body.h"
#include "physics/pile/index.h"
#include "physics/world/world.h"

namespace careen {

/// The bodies of a crowd, by place, the walls of the world first: now, when its last step began, and what
/// they did in it. The places of those that left are used again.
struct CrowdMembers {
  static constexpr double kUsualTolerance = 3e-4;    ///< [m] what penetration and steps were measured for
  static constexpr double kLongestStep = 1.0 / 180;  ///< [s] at that tolerance

  /// The way of a body in the step. Where it did not move, only `moved` and `shifted` are of that step.
  struct Way {
    Vec3 position = Vec3::Zero();  ///< at its begin, as are these
    Quat attitude = Quat::Identity();
    Vec3 velocity = Vec3::Zero();
    Vec3 omega = Vec3::Zero();
    Vec3 angularMomentum = Vec3::Zero();
    Vec3 endVelocity = Vec3::Zero();  ///< at its end, before it bounces
    Vec3 endOmega = Vec3::Zero();
    double unrest = std::numeric_limits<double>::max();  ///< [m/s] net change of velocity, if it was pushed
    double kinetic = 0;                                  ///< [J] after impulses
    double shifted = 0;  ///< [m] how far shifts moved points of it, at the most
    bool pushed = false;
    bool projected = false;
    bool moved = false;
  };

  /// `from`: walls are driven as from that time [s] on.
  CrowdMembers(const World& inWorld, double toTolerance, std::shared_ptr<Team> withTeam, double from = 0);

  std::size_t add(const PileBody& body, std::size_t index);
  void remove(std::size_t place);
  /// The step begins where they are.
  void begin() {
    forEach([&](std::size_t i) { start[i] = bodies[i]; });
  }
  /// What is driven has from now on the velocities with which it gets to where it is after the step.
  void drive();
  /// To where it began, but for what it woke and the ways gone.
  void goBack();

  std::size_t size() const { return bodies.size(); }
  PileBody& operator[](std::size_t place) { return bodies[place]; }
  const PileBody& operator[](std::size_t place) const { return bodies[place]; }
  PileBody& operator[](int place) { return bodies[at(place)]; }
  const PileBody& operator[](int place) const { return bodies[at(place)]; }
  /// [m] From b's centre to a's.
  Vec3 apart(int a, int b) const { return (*this)[a].position - (*this)[b].position; }
  double longestStep() const { return kLongestStep * scale; }
  /// On the way of the step, straight between its ends, at that part of it.
  Pose between(std::size_t place, double part) const;
  /// work(place), which the team shares.
  template <class Work>
  void forEach(const Work& work) const {
    team->share(bodies.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        work(i);
      }
    });
  }

  const World& world;
  std::shared_ptr<Team> team;
  double tolerance = 0;          ///< [m]
  double scale = 1;              ///< [1] root of the tolerance over the usual one
  double gravity = 0;            ///< [m/s²] its size, at most
  double time = 0;               ///< [s] when it begins
  double h = 0;                  ///< [s] length of the step
  double span = 0;               ///< [s] to its middle from that of the step before: its impulses
  std::vector<PileBody> bodies;  ///< now
  std::vector<PileBody> start;   ///< at the start of the step
  std::vector<Way> ways;
  std::vector<std::size_t> listed;  ///< index in the world, among bodies or walls
  std::vector<int> free;            ///< places that were left
  std::vector<std::size_t> driven;  ///< places of what is
};

}  // namespace careen
