#pragma once

#include <cstddef>
#include <vector>

#include "audit/findings.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Where one motion of a body ends and the next begins: several segments may begin at one moment.
struct Seam {
  std::size_t before = 0;  ///< last segment that began earlier
  std::size_t after = 0;   ///< last segment that begins at this moment
};
std::vector<Seam> seamsOf(const Track& track);

/// What gave a body impulses, as indices into the run's lists, in order of time.
struct ImpulsesOfBody {
  std::vector<std::size_t> impacts;
  std::vector<std::size_t> joints;  ///< of Trajectory::jointImpulses
};
std::vector<ImpulsesOfBody> impulsesOfBodies(const Trajectory& run);

/// Looks at both sides of a seam: are both states finite, is the place the same, and did the impacts and
/// joints since the last seam give the velocity its jump? `impulses` and `fallingSpeed` are those of the
/// body.
void checkSeam(const Trajectory& run, std::size_t body, const Seam& seam, const ImpulsesOfBody& impulses,
               double fallingSpeed, Findings& findings);

/// Looks at a body's way from row to row of a table that has velocities: how much farther it is than every
/// velocity between those of the two rows takes it.
void checkSteps(const Trajectory& run, std::size_t body, Findings& findings);

/// Finiteness and |AAᵀ−1| of a state.
void checkState(const BodyState& state, std::size_t body, double time, Findings& findings);

/// [m] Rounding of a body's places.
double placeRounding(const Body& body, const Vec3& position);

/// [m/s] Of each body: the speed it gains over its size under what pulls it at the start, gravity, springs
/// and drag. A scale for speeds where it hardly moves.
std::vector<double> fallingSpeeds(const World& world);

}  // namespace careen
