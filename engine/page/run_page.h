#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "audit/audit.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A run's film, for its page.
struct PageFilm {
  std::string bytes;
  std::string type;  ///< "video/mp4"
};

/// So many impacts are on a page at most, the hardest ones; the rest is in tables.
inline constexpr std::size_t kMostImpactsOnPage = 2000;
/// Energies and momenta are told at so many moments, besides just before and after each of the impacts.
inline constexpr std::size_t kMomentsOnPage = 600;

/// A page that tells of a run: its film, its energies and momenta over time, its impacts, each of which leads
/// to its moment of the film, and its audit. One file of HTML that opens without a network. `program`: name
/// and version.
std::string runPage(const Trajectory& run, const Audit& audit, const PageFilm& film,
                    const std::string& program);

/// Text of a part of that page, a file of assets/page; empty if there is none of that name.
std::string_view embeddedRunPage(std::string_view name);

}  // namespace careen
