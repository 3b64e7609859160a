#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/system/team.h"
#include "physics/geometry/box_at.h"
#include "physics/motion/hermite_step.h"
#include "physics/pile/body.h"
#include "physics/pile/crowd_apart.h"
#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_bounce.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_depth.h"
#include "physics/pile/crowd_impulses.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/crowd_path.h"
#include "physics/pile/crowd_seams.h"
#include "physics/pile/crowd_sleep.h"
#include "physics/world/world.h"

namespace careen {

/// Many boxes in contact that advance together in steps: the fast kind of contact group, of bounded error.
/// Not exact: impacts are placed at the ends of steps, and the impulses of more than a few hundred contact
/// points come from a Gauss–Seidel solver that stops early; those of fewer from the ContactSolver, but in
/// violent motion, where it takes too long. What
/// holds: linear momentum is exchanged to rounding, restitution adds no energy, penetration stays near
/// `tolerance`, and members at rest cost nothing.
///
/// A step consists of: broad and narrow phase; gravity, springs and drag; solve for impulses such that no gap
/// becomes negative within the step, v_n ≥ −(gap + its second order, of bodies that turn)/h; integrate
/// positions; restitution. The velocities solved for are those of the middle of the step, and forces act from
/// the middle of one step to that of the next (leapfrog); those of springs and drag are those in the middle
/// of each step, for all members alike, so that they keep momentum. Where one point of a manifold strikes,
/// all its points within a few tolerances strike, with v_n ≥ 0: else the corners of one edge would strike in
/// different steps, and each would turn the body. Bodies that went deep into each other in a step, or into a
/// wall, are pushed apart at its end, with those around them; where they are too deep for that, it is taken
/// again with half its length, and with more sweeps where it gained energy; where there is no place for them,
/// as among wedged boxes, they are held about as deep as they were before it. Penetration that is left at the
/// rates found is undone by shifts in the same step, the rest by a position projection every few steps; none
/// of it becomes velocity (no Baumgarte stabilisation, no slop).
///
/// `tolerance` [m] scales all of it: the length of steps with its root, penetration in proportion.
///
/// Members are added and removed at any time; they are identified by places, in the order in which they came.
/// A place that was left is used again.
///
/// Known limits. A box spinning on a single contact point has no torsional friction to stop it and keeps
/// everything it touches awake. Position projection lifts the bodies above: in 99 of 100 small pours the
/// energy rose by less than 2e-5 of the initial energy per 1/60 s, in the last one, a shaft of 38 layers, by
/// 5e-4.
///
/// A member that nothing touches follows its parabola to rounding; its attitude has an error of O(h³).
class Crowd {
 public:
  static constexpr double kUsualTolerance = CrowdMembers::kUsualTolerance;  ///< [m]
  using Extent = CrowdExtent;
  using Struck = CrowdBounces::Struck;

  /// The steps of large crowds are shared among the team; nothing else depends on its size. `time` [s] is that
  /// from which on walls are driven.
  Crowd(const World& world, double tolerance, std::shared_ptr<Team> team = std::make_shared<Team>(1),
        double time = 0);

  /// Adds a body of the world, by its index in it; returns its place. `past` [s] is that of JoinedSteps: how
  /// long its last step was; `part`: by what it is driven, if it is.
  std::size_t admit(std::size_t body, const BodyState& state, const Quat& attitude,
                    double past = std::numeric_limits<double>::max(), const CoursePart* part = nullptr);
  /// Adds one that sleeps until it is pushed, together with its `cluster`: a place, perhaps its own.
  std::size_t admitAtRest(std::size_t body, const Pose& pose, std::optional<std::size_t> cluster);
  void dismiss(std::size_t place);

  /// Advances by one step of at most `most` [s] and returns its length. What is driven is so from that time
  /// [s] on.
  double step(double most, double time = 0);
  /// Takes the last step again with that length [s], shorter than it was, and with those admitted since, who
  /// begin where it began. Returns its length, perhaps shorter still.
  double stepAgain(double length);

  /// [s] What step() would take.
  double nextLength(double most) const { return std::min(chooseLength(), most); }
  /// [m/s] Of the fastest member, its centre.
  double fastest() const;
  /// The space that members that are awake or asleep can reach within that time [s]; that the last step took.
  CrowdExtent extent(double length) const { return path_.extent(length); }
  CrowdExtent swept() const { return path_.swept(); }
  /// Whether a member came that near [m] to another body, as far as that can be said before a search.
  bool cameNear(std::size_t place, const Body& body, const Pose& pose, double distance) const {
    return path_.cameNear(place, body, pose, distance);
  }

  /// Asleep: its pose is bitwise constant until another body pushes it.
  bool sleeps(std::size_t place) const { return members_[place].asleep; }
  BodyState state(std::size_t place) const { return stateOf(members_[place]); }
  /// With the velocity that forces give it until where it is.
  BodyState stateAtEnd(std::size_t place) const;
  /// Where it had the velocity of state(), half a step ago if it was pushed: so its energy is that of one
  /// moment.
  BodyState stateAtVelocity(std::size_t place) const;
  const Quat& attitude(std::size_t place) const { return members_[place].attitude; }
  const PileBody& body(std::size_t place) const { return members_[place]; }
  const Body& listedBody(std::size_t place) const { return members_.world.bodies[members_.listed[place]]; }
  /// Whether it moved in the last step; then where that step began and ended: as in CrowdPath.
  bool moved(std::size_t place) const { return members_.ways[place].moved; }
  StepEnd begin(std::size_t place) const { return path_.begin(place); }
  StepEnd beginAsItCame(std::size_t place) const { return path_.beginAsItCame(place); }
  StepEnd end(std::size_t place) const { return path_.end(place); }
  /// By place, of the last step: whether its velocity changed by more than lasting forces do, or that of one
  /// which it pushed, directly or through others.
  std::vector<char> changedSuddenly() const { return path_.changedSuddenly(); }
  double length() const { return members_.h; }
  /// Its begin is to be met: JoinedSteps would lead members through each other there.
  bool isSharp() const { return isSharp_; }
  /// Nothing was near it for a few steps.
  bool isFree(std::size_t place) const { return memory_.places[place].untouchedSteps > kStepsAlone; }
  /// All members are asleep or fixed.
  bool atRest() const { return atRest_; }
  /// [m] The deepest that was seen and left, by a projection or as not deep enough for one, in the steps that
  /// were taken.
  double deepest() const { return deepest_; }
  /// [m] Deepest current penetration, by all 15 axes of every pair: costs more than a step.
  double penetration() const;
  const std::vector<Struck>& impacts() const { return bounces_.impacts(); }
  /// Of the solves of steps since it was last asked, before bounces and shifts.
  ContactResiduals takeResiduals() { return impulses_.takeResiduals(); }

  struct Figures {
    std::int64_t steps = 0;
    std::int64_t retaken = 0;      ///< times that one was taken again
    std::int64_t rows = 0;         ///< contact points in the solver, over all steps
    std::int64_t projections = 0;  ///< passes
  };
  Figures figures() const;
  /// What the next step will start from; nothing else of the last one shows in it but members and contacts.
  CrowdMemory& memory() { return memory_; }
  /// To be listed before a step, and after admissions.
  CrowdArticulations& articulations() { return articulations_; }

 private:
  static constexpr int kStepsAlone = 2;
  enum class Shifts : char { kMay, kMayNot };
  std::size_t place(const PileBody& body, std::size_t listed);
  double chooseLength() const;
  void take(double length, Shifts shifts);
  void goBack();
  double keepApart();
  double pushApart();

  CrowdMembers members_;
  CrowdMemory memory_;
  CrowdLoads loads_;
  CrowdContacts contacts_;
  CrowdArticulations articulations_;
  CrowdImpulses impulses_;
  CrowdBounces bounces_;
  CrowdDepth depth_;
  CrowdApart apart_;
  CrowdSleep sleep_;
  CrowdPath path_;
  CrowdSeams seams_;
  Figures figures_;    // but for what the stages count
  double chosen_ = 0;  // [s] what the last step would be if nothing outside cut it
  bool isSharp_ = false;
  bool atRest_ = false;
  double deepest_ = 0;
};

}  // namespace careen
