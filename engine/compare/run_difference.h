#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/math/pose_difference.h"
#include "trajectory/trajectory.h"

namespace careen {

/// How far two runs lie apart at a moment: the worst of the boxes that can move.
struct RunSample {
  double time = 0;  ///< [s]
  PoseDifference difference;
  std::string body;  ///< the one that is farthest apart, relative to its size
};

/// The impacts that are at one place of both lists; an impact that only one of the runs has counts as not the
/// same.
struct ImpactDifference {
  std::size_t index = 0;  ///< counted from 0
  std::optional<Impact> expected;
  std::optional<Impact> actual;
  std::string expectedBodies;  ///< "crate against room-x"; empty where there is none
  std::string actualBodies;
  std::string what;  ///< how they differ, in words, with names; empty if they are the same
};

/// What the motion of two runs has in common, and from when on it has not.
struct RunDifference {
  std::vector<std::string> incomparable;  ///< why the two cannot be the same scene, in words; else
  bool sameBits = false;                  ///< every motion and every impact
  std::optional<double> until;            ///< [s] what came later was left out, as asked for
  std::optional<double> firstTime;        ///< [s] from here on a state differs, by however little
  std::vector<RunSample> growth;          ///< kRunSamples + 1 moments, evenly spread
  RunSample worst;                        ///< of those moments, up to the horizon
  /// [s] before kHorizonDifference is exceeded. What small difference there was has grown so large that from
  /// here on places say nothing any more: compare energies and counts.
  std::optional<double> horizon;
  /// By how much a difference grew from impact to impact, on average; if there were some to grow by, and it
  /// became ten times as large as time alone makes it. Then chaos made it grow; else it was large at once, or
  /// a speed differs.
  std::optional<double> growthPerImpact;
  std::optional<ImpactDifference> firstImpact;      ///< any bit of it
  std::optional<ImpactDifference> firstOtherEvent;  ///< other bodies, or not there
  std::vector<ImpactDifference> impactsAround;      ///< kImpactsBefore the first and kImpactsAfter it
  std::size_t expectedImpacts = 0;
  std::size_t actualImpacts = 0;
  double expectedDuration = 0;  ///< [s]; states are compared up to the end of the shorter
  double actualDuration = 0;    ///< [s]
  double expectedEnergy = 0;    ///< [J] kinetic, there
  double actualEnergy = 0;      ///< [J] likewise
};

/// Moments at which states are compared, besides the ends of their segments.
inline constexpr int kRunSamples = 1000;

/// Impacts that are told beside the first that differs.
inline constexpr std::size_t kImpactsBefore = 3;
inline constexpr std::size_t kImpactsAfter = 8;

/// Compares what moved, not how it was computed, up to a moment [s]: impacts and states later than that do
/// not count. InputError, naming the run, where a number is not finite.
RunDifference differenceOf(const Trajectory& expected, const Trajectory& actual,
                           double until = std::numeric_limits<double>::infinity());

/// An impact in words: time, bodies, impulse.
std::string describe(const Impact& impact, const Trajectory& run);

}  // namespace careen
