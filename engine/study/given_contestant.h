#pragma once

#include <optional>
#include <string>

#include "study/case.h"
#include "study/contestant.h"

namespace careen {

/// What somebody's engine made of one case: a table of poses.
struct GivenAnswer {
  std::string label;              ///< its name in tables and plots
  std::string file;               ///< CSV or NPZ
  std::optional<double> seconds;  ///< [s] of one core that it took; absent: unknown
};

/// Takes part in the study with the poses of a table, as they are: any fineness gives the same answer.
/// InputError if the table is none of the case's boxes, does not last as long as the case, or the case asks
/// for a second run.
std::unique_ptr<Contestant> givenContestant(const GivenAnswer& answer, const Case& study);

}  // namespace careen
