#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/math/pose_difference.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Difference of two runs at one time: the largest over the movable boxes.
struct RunSample {
  double time = 0;  ///< [s]
  PoseDifference difference;
  std::string body;  ///< the box with the largest difference relative to its size
};

/// The impacts with the same index in both lists; an impact that only one run has counts as different.
struct ImpactDifference {
  std::size_t index = 0;  ///< counted from 0
  std::optional<Impact> expected;
  std::optional<Impact> actual;
  std::string expectedBodies;  ///< "crate against room-x"; empty if there is no impact
  std::string actualBodies;
  std::string what;  ///< the difference in words, with names; empty if they are the same
};

/// How far the motion of two runs agrees, and from when on it differs.
struct RunDifference {
  std::vector<std::string>
      incomparable;                 ///< why the two cannot be the same scene, in words; empty if they can
  bool sameBits = false;            ///< of every motion and every impact
  std::optional<double> until;      ///< [s] later times were left out on request
  std::optional<double> firstTime;  ///< [s] from here on a state differs, by any bit; of a table a pose, by
                                    ///< more than the tolerance
  std::vector<RunSample> growth;    ///< kRunSamples + 1 times, evenly spaced; of a table as many of its rows
  RunSample worst;                  ///< largest of `growth` up to the horizon
  /// [s] until kHorizonDifference is exceeded. By then a small difference has grown so large that positions
  /// mean nothing any more: compare energies and counts.
  std::optional<double> horizon;
  /// Mean growth factor of a difference per impact; absent unless there were enough impacts and the
  /// difference became ten times as large as time alone makes it. If present, chaos made it grow; else it
  /// was large at once, or a speed differs.
  std::optional<double> growthPerImpact;
  std::optional<ImpactDifference> firstImpact;      ///< differs in any bit
  std::optional<ImpactDifference> firstOtherEvent;  ///< other bodies, or missing
  /// If one of the runs comes from a table, which has no impacts: the other's last one before firstTime.
  std::optional<ImpactDifference> lastImpact;
  /// What the audit of a run that comes from a table found first to be beyond what is allowed, in words. Left
  /// empty here, for who audits it.
  std::string firstBroken;
  std::vector<ImpactDifference>
      impactsAround;  ///< kImpactsBefore before the first different one and kImpactsAfter after it
  std::size_t expectedImpacts = 0;
  std::size_t actualImpacts = 0;
  double expectedDuration = 0;  ///< [s]; states are compared up to the end of the shorter run
  double actualDuration = 0;    ///< [s]
  double expectedEnergy = 0;    ///< [J] kinetic, at that end
  double actualEnergy = 0;      ///< [J] likewise
};

/// Number of times at which states are compared, besides the ends of their segments.
inline constexpr int kRunSamples = 1000;

/// Impacts reported before and after the first that differs.
inline constexpr std::size_t kImpactsBefore = 3;
inline constexpr std::size_t kImpactsAfter = 8;

/// Of a run that comes from a table, differences up to this [1] are rounding, not another motion.
inline constexpr double kTableRounding = 1e-12;

/// Compares the motion, not how it was computed, up to the time `until` [s]: later impacts and states do not
/// count. A run that comes from a table is compared at the times of its rows, and only by its poses, up to
/// `tolerance` [1]; see PoseDifference. InputError, naming the run, if a number is not finite.
RunDifference differenceOf(const Trajectory& expected, const Trajectory& actual,
                           double until = std::numeric_limits<double>::infinity(),
                           double tolerance = kTableRounding);

/// An impact in words: time, bodies, impulse.
std::string describe(const Impact& impact, const Trajectory& run);

}  // namespace careen
