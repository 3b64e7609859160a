#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "audit/cone.h"
#include "audit/groups.h"
#include "audit/overlap.h"
#include "audit/samples.h"
#include "trajectory/trajectory.h"

namespace careen {

/// What acted on a group of bodies from outside over some time.
struct External {
  Vec3 impulse = Vec3::Zero();         ///< [N s] of gravity, drag, springs to the world and recorded impacts
  Vec3 angularImpulse = Vec3::Zero();  ///< [N m s] likewise, about the group's origin
  double friction = 0;                 ///< [N s] of recorded impacts; its direction is not recorded
  double angularFriction = 0;          ///< [N m s] likewise
  std::vector<WallForce> walls;        ///< that bodies of the group lay on, each once
  bool lies = false;                   ///< on a wall or an immovable body, or on another of the group
  bool liesOnImmovable = false;
  bool isHeld = false;          ///< by a joint to the world or an immovable body
  bool isStruck = false;        ///< by walls or immovable bodies
  bool losesInImpacts = false;  ///< of restitution or friction
  /// [m/s] Of the surfaces that it touched, if all move alike: 0 if they are still. And whether they do not,
  /// or turn or swing, or are those of belts on boxes: then it is not known what they did.
  std::optional<Vec3> belt;
  bool hasUnknownBelts = false;
  double work = 0;  ///< [J] of recorded impacts with boxes that move evenly, along their normals
  double rise = 0;  ///< [J] of the energy of gravity while that slopes, heights from the group's origin
};

/// Follows a group through its run, from moment to moment.
class ExternalOf {
 public:
  /// Torques are about `origin` [m]. Keeps references.
  ExternalOf(const Trajectory& run, const ExchangeGroup& group, Vec3 origin);

  /// From the last moment (at first 0 s) to this one [s]; torques of gravity are right to rounding if it does
  /// not change between them, or grows evenly.
  External until(double time);

 private:
  void follow(std::size_t member, double time, External& external);
  void addLoads(std::size_t body, const Segment& segment, double from, double to, External& external);
  void addTouches(std::size_t member, std::size_t segment, External& external);
  void addImpacts(double time, External& external);
  enum class Of { kWall, kBox };
  static void addBelt(const SurfaceMotion& surface, Of of, External& external);
  void addFixed(std::size_t fixed, double time, External& external) const;
  static void addSurface(const Wall& wall, double time, External& external);
  static void addCourse(const Course& course, double time, External& external);
  void addWall(std::size_t wall, double friction, External& external) const;

  /// What a body touches while it does not fly.
  struct Touches {
    std::vector<std::size_t> walls = {};
    std::vector<std::size_t> immovables = {};  // bodies
    std::optional<bool> other = {};            // of the group; unknown until asked for
  };
  Touches touchesOf(std::size_t body, std::size_t segment) const;
  bool touchesOther(std::size_t body, std::size_t segment) const;
  Pose placeOf(std::size_t body, std::size_t segment, double elapsed) const;
  double lengthOf(std::size_t body, std::size_t segment) const;
  bool isHeldByJoint() const;
  bool meets(const Body& owner, const Pose& place, double near, std::size_t other, double time) const;
  double wayWithin(std::size_t body, std::size_t segment) const;

  struct Follower {
    std::size_t segment = 0;
    std::size_t known = 0;  // segment that `touches` is of, plus 1
    Touches touches;
  };

  const Trajectory& run_;
  const ExchangeGroup& group_;
  Vec3 origin_;
  double time_ = 0;
  std::vector<Follower> followers_;  // of each member
  std::size_t nextImpact_ = 0;
  std::vector<std::size_t> immovables_;  // bodies
  std::vector<BodyState> states_;        // of all bodies, for springs: only those at its ends are up to date
  bool integrates_ = false;              // springs or drag need quadrature
};

}  // namespace careen
