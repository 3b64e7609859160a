#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "audit/findings.h"
#include "core/math/linear_algebra.h"
#include "physics/world/partner.h"
#include "trajectory/trajectory.h"

namespace careen {

/// What a body did from one row to the next.
struct Passage {
  enum class Kind { kUnknown, kFlew, kTouched };
  Kind kind = Kind::kUnknown;
  Vec3 impulse = Vec3::Zero();         // [N s] unexplained
  Vec3 angularImpulse = Vec3::Zero();  // [N m s]
  Vec3 way = Vec3::Zero();             // [m] aside of where it flies
  Vec3 turn = Vec3::Zero();            // [rad] likewise
  std::optional<double> missing = {};  // [N s] of friction
  double surplus = 0;                  // [N s] likewise
  std::optional<Partner> met = {};     // the only thing that it may have touched
};

/// Adds up what a body was not given from row to row, as long as it flies, or touches, without a break:
/// impulses, and places and attitudes aside of where it flies. Of friction counts what lasts for a step of
/// the program that made the table, as speeds may be means over one.
void addUp(const Trajectory& run, std::size_t body, const std::vector<Passage>& passages, double fallingSpeed,
           Findings& findings);

}  // namespace careen
