#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// A body that can move just before and just after a moment. Of a body in a step of a crowd, whose velocities
/// are means over steps, these are those of the steps on both sides.
struct StruckBody {
  std::size_t body = 0;
  BodyState before;
  BodyState after;
};

/// Those that can move of the bodies that impacts and impulses of joints name, in any order and repeated:
/// each once, ascending.
std::vector<StruckBody> struckBodies(const Trajectory& run, std::vector<int> named, double time);

/// Adds the bodies that it names.
void addNamed(const Impact& impact, std::vector<int>& named);
void addNamed(const Joint& joint, std::vector<int>& named);

/// How an impact was resolved, as far as the record of a run tells.
enum class ImpactLaw {
  kOneContact,       ///< of boxes that flew
  kSeveralContacts,  ///< likewise; joints are contacts too
  kInSteps,          ///< a box moved in steps: in contact, joined, or under springs or drag
  kInCrowd,          ///< a box was in a crowd
  kLoop1997,
  kStepped  ///< by a study method, box by box
};

/// What was resolved at once: the impacts and impulses of joints at one moment that bodies which can move
/// have in common.
struct ImpactMoment {
  double time = 0;                         ///< [s]
  std::vector<std::size_t> impacts;        ///< indices in the run, ascending
  std::vector<std::size_t> joints;         ///< indices in the world, ascending
  std::vector<std::size_t> atTheSameTime;  ///< impacts that have nothing to do with it
  std::vector<StruckBody> bodies;          ///< ascending
  ImpactLaw law{};
};
/// `index`: of an impact, from 0. InputError if there are not so many.
ImpactMoment impactMoment(const Trajectory& run, int index);

/// [m/s] Of the point of the body that the normal points to, relative to the other's, or to its surface if
/// that moves along itself.
struct PointVelocities {
  Vec3 before = Vec3::Zero();
  Vec3 after = Vec3::Zero();
};
PointVelocities pointVelocities(const Impact& impact, const std::vector<StruckBody>& bodies,
                                const World& world);

/// What friction did at a contact: as the slip was where compression ends, before restitution.
enum class FrictionOutcome {
  kNone,    ///< the pair has none
  kIdle,    ///< nothing to do
  kSticks,  ///< less than its limit ended the slip
  kSlides   ///< at its limit
};
FrictionOutcome frictionOutcome(const Impact& impact, const World& world);

/// Of what touched, from materials of the run's world.
Material pairOf(const Impact& impact, const World& world);

}  // namespace careen
