#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/forces.h"

namespace careen {

/// What the steps of a crowd remember for the next, beside the members and the impulses of their contacts.
struct CrowdMemory {
  static constexpr double kMostBent = 6;
  static constexpr double kTell = 0x1p-12;

  /// Of the way in a part of a step.
  struct Rates {
    Vec3 velocity = Vec3::Zero();
    Vec3 omega = Vec3::Zero();
  };
  struct OfPlace {
    Rates rates;                                       ///< at the end of the step before
    double past = std::numeric_limits<double>::max();  ///< [s] its last step, if it was no member then
    int untouchedSteps = 0;
    int quietChecks = 0;  ///< since when it and all that is near it could sleep
  };

  double length = 0;           ///< [s] of the step before
  double sinceProjection = 0;  ///< [s]
  std::int64_t effort = 1;     ///< [1] of the usual sweeps
  double tell = kTell;   ///< [1] of the smallest size: change per step above which neighbours are re-solved
  int directWait = 0;    ///< solves until a direct one is tried again,
  int directPause = 1;   ///< and as many after the next failure
  int mendingWait = 0;   ///< steps until mending is tried again,
  int mendingPause = 0;  ///< and as many after the next failure
  double bent = kMostBent;     ///< [1] of the tolerance: how far corners may leave their tangents
  int checks = 0;              ///< of parts of clusters
  std::vector<int> disturbed;  ///< clusters that the step before pushed otherwise than when they fell asleep
  std::vector<Load> loads;     ///< by index in the world, in the step before
  std::vector<OfPlace> places;
};

}  // namespace careen
