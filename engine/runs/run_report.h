#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runs/run.h"

namespace careen {

/// Time [s] that a body spent in flight, in contact and at rest.
struct Life {
  double flight = 0;
  double contact = 0;
  double crowd = 0;
  double rest = 0;
  std::size_t steps = 0;  // of Contact and of crowds

  double whole() const { return flight + contact + crowd + rest; }
};

/// Of all boxes that can move.
Life lifeOf(const Trajectory& trajectory);

/// report.json of a run: keys as assets/manual/scenes.md has them; the renderer adds its own part.
/// `wallSeconds` [s]: what all of the command took.
nlohmann::ordered_json runReport(const Run& run, double wallSeconds);
/// Without that part, as text.
std::string runReportText(const Run& run, double wallSeconds);

}  // namespace careen
