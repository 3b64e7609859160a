#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "audit/kinds.h"
#include "trajectory/trajectory.h"

namespace careen {

/// How much of a run is looked at.
enum class AuditDepth : int {
  kUsual,  ///< moments and seams within a budget that depends on the run alone, never on the clock
  kFull,   ///< also both ends and the middle of every segment
  kNone
};
inline constexpr std::array<std::string_view, 3> kAuditDepthNames = {"usual", "full", "none"};

/// What a run is held to, in place of what its method promises.
struct AuditLimits {
  /// [1] Of a run that comes from a table of poses: boxes may overlap and jump by this part of half the
  /// diagonal of the smallest box that can move, and momenta and energies may be off by this part.
  double table = 0.01;
  /// Of single kinds, in the kind's unit; nullopt: whatever is found is only reported.
  std::map<AuditKind, std::optional<double>> sizes = {};
};

/// The largest finding of one kind.
struct AuditFigure {
  double size = 0;                  ///< in the kind's unit; 0: nothing found
  double time = 0;                  ///< [s]
  std::vector<std::string> bodies;  ///< walls and joints, by name
  bool promised = false;            ///< the method promises a bound for this kind at this time
};

/// A promise of the method that the run breaks, where it first does.
struct AuditBreach {
  AuditKind kind{};
  double size = 0;     ///< there, in the kind's unit
  double allowed = 0;  ///< likewise
  double largest = 0;  ///< likewise, of the whole run
  double time = 0;     ///< [s]
  std::vector<std::string> bodies;
};

/// What a run is worth, measured by code that shares with the methods only the definition of the world and
/// the motions of the trajectory.
struct Audit {
  AuditDepth depth = AuditDepth::kNone;
  std::array<AuditFigure, kAuditKindCount> figures;  ///< in the order of AuditKind
  std::vector<AuditBreach> breaches;                 ///< the first of each kind, in order of time
  std::size_t looks = 0;                             ///< states that were looked at

  const AuditFigure& figure(AuditKind kind) const { return figures[indexOf(kind)]; }
};

/// The same for the same run, on every machine. A run that comes from a table of poses is looked at only at
/// the times of its rows, and is taken to touch whatever it may have met between two of them. Throws
/// Interrupted.
Audit audit(const Trajectory& run, AuditDepth depth, const std::stop_token& stop = {},
            const AuditLimits& limits = {});

/// "at 0.4284 s a, b: boxes overlap: 1.451e-05 m, later 0.092 m, where method exact promises at most 4e-06
/// m"; of a table, "… where at most 4e-06 m is allowed".
std::string describe(const AuditBreach& breach, const Trajectory& run);

/// "box_overlap 0.092 m; no promise concerns impulse 0.84", "BROKEN: …" if a promise is; "nothing found".
std::string inWords(const Audit& audit);

}  // namespace careen
