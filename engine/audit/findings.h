#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "audit/kinds.h"
#include "audit/promises.h"
#include "physics/world/run_settings.h"

namespace careen {

/// What an audit found of one kind: the largest, or the first that broke a promise.
struct Finding {
  double size = 0;                  ///< in the kind's unit
  double time = 0;                  ///< [s]
  std::vector<std::size_t> bodies;  ///< indices in the world
  std::optional<std::size_t> wall;  ///< index in the world
  double length = 1;                ///< [m] for kinds that have no unit: what the tolerance is compared with
  bool promised = true;             ///< false: reported, whatever the method promises for the kind
};

/// Collects findings.
class Findings {
 public:
  /// From `pileFrom` [s] on the run is a pile's, of which `after` is promised.
  Findings(const RunSettings& settings, const Promises& before, const Promises& after,
           std::optional<double> pileFrom);
  /// With what the method promises.
  Findings(const RunSettings& settings, std::optional<double> pileFrom)
      : Findings(settings, promisesOf(settings.method, false), promisesOf(settings.method, true), pileFrom) {}

  /// `rounding`: up to this the size says nothing; in the kind's unit.
  void add(AuditKind kind, double rounding, const Finding& found);

  /// Sizes 0 where nothing was found.
  const Finding& largest(AuditKind kind) const { return largest_[indexOf(kind)]; }
  /// The first in time that is larger than promised.
  const std::optional<Finding>& firstBreach(AuditKind kind) const { return breaches_[indexOf(kind)]; }
  /// What is promised at a time.
  const std::optional<Promise>& promise(AuditKind kind, double time) const;
  bool isPile(double time) const { return time >= pileFrom_; }

 private:
  RunSettings settings_;
  double pileFrom_;
  Promises before_;
  Promises after_;
  std::array<Finding, kAuditKindCount> largest_;
  std::array<std::optional<Finding>, kAuditKindCount> breaches_;
};

}  // namespace careen
