#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "audit/kinds.h"
#include "audit/promises.h"
#include "physics/world/run_settings.h"

namespace careen {

/// What an audit found of one kind: the largest, or the first that broke a promise.
struct Finding {
  double size = 0;                        ///< in the kind's unit
  double time = 0;                        ///< [s]
  std::vector<std::size_t> bodies;        ///< indices in the world
  std::optional<std::size_t> wall;        ///< index in the world
  std::optional<std::size_t> joint = {};  ///< likewise
  double length = 1;     ///< [m] for kinds that have no unit: what the tolerance is compared with
  bool promised = true;  ///< false: reported, whatever the method promises for the kind
};

/// Collects findings.
class Findings {
 public:
  /// `crowdFrom` [s], by body: from when on `after` is promised of it, see crowdBeginnings.
  Findings(const RunSettings& settings, const Promises& before, const Promises& after,
           std::vector<double> crowdFrom);
  /// With what the method promises.
  Findings(const RunSettings& settings, std::vector<double> crowdFrom)
      : Findings(settings, promisesOf(settings.method, false), promisesOf(settings.method, true),
                 std::move(crowdFrom)) {}

  /// `rounding`: up to this the size says nothing; in the kind's unit.
  void add(AuditKind kind, double rounding, const Finding& found);

  /// Sizes 0 where nothing was found.
  const Finding& largest(AuditKind kind) const { return largest_[indexOf(kind)]; }
  /// The first in time that is larger than promised.
  const std::optional<Finding>& firstBreach(AuditKind kind) const { return breaches_[indexOf(kind)]; }
  /// What is promised of the finding's bodies at its time.
  const std::optional<Promise>& promise(AuditKind kind, const Finding& finding) const;
  /// Whether one of the bodies is in a crowd at that time, or was before.
  bool isCrowd(double time, std::span<const std::size_t> bodies) const;

 private:
  RunSettings settings_;
  std::vector<double> crowdFrom_;
  Promises before_;
  Promises after_;
  std::array<Finding, kAuditKindCount> largest_;
  std::array<std::optional<Finding>, kAuditKindCount> breaches_;
};

}  // namespace careen
