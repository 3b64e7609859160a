#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audit.h"
#include "runs/error_estimate.h"
#include "sweep/family.h"
#include "trajectory/trajectory.h"

namespace careen {

/// What a table has beside its usual columns.
struct OutcomesAsked {
  std::vector<std::string> questions = {};  ///< whose first moments are columns
  bool errors = false;                      ///< estimates of each run's error, which take other runs
};

/// InputError if one is no question about run 0 of the family, or asked twice.
void checkQuestions(const Family& family, const std::vector<std::string>& questions);

/// Columns of a sweep's table, with their units: a row for each run and each box of it that can move.
///   run, attempts           number of the run; starts drawn until none overlapped
///   the numbers that vary outside boxes, by their paths in the family
///   half_x … friction       the box
///   start_…, end_…          its state at both ends, columns as in poses.csv
///   face_up                 1 … 6: the face −x, +x, −y, +y, −z, +z that looks against gravity (up, without
///   it)
///   impacts, first_impact, last_impact    of the box; times are nan without one
///   rest_since              [s] when it came to rest for good; nan if it had not at the end
///   the questions           [s] the first moment at which each became true in the run (question/moments.h);
///                           nan if it never did, or if the run has no box or wall of a name in it
///   error_position, error_angle, error_until    [m], [rad], [s] the run's error, if asked for, and how far
///                           it is known: beyond it, chaos has taken over (runs/error_estimate.h)
///   run_impacts, broken     of the whole run: impacts, and promises of its method that the audit found
///   broken box                     its name
struct OutcomeColumn {
  std::string name;
  std::string unit;
};
std::vector<OutcomeColumn> outcomeColumns(const Family& family, const OutcomesAsked& asked);

/// The rows of one run, and its error if it is asked for and known, as lines of CSV, without a header; 17
/// digits, nan where there is no number. `box` is last.
std::string outcomeRows(std::uint64_t run, const Family::Member& member, const Trajectory& trajectory,
                        const Audit& audit, const std::optional<ErrorEstimate>& error,
                        const OutcomesAsked& asked);

/// The first line of the table.
std::string outcomeHeader(const Family& family, const OutcomesAsked& asked);

/// Rows as numbers.
struct OutcomeTable {
  std::vector<OutcomeColumn> columns;        ///< the last is `box`
  std::vector<std::vector<double>> numbers;  ///< of each column but the last
  std::vector<std::string> boxes;

  /// InputError, which `name` begins, if the lines are not those of outcomeRows().
  OutcomeTable(const Family& family, const OutcomesAsked& asked, std::string_view rows,
               const std::string& name);
  /// An NPZ archive: an array for each column, and `units`.
  std::string archive() const;
};

}  // namespace careen
