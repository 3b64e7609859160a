#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "library/careen.h"
#include "runs/run.h"

namespace careen::v1 {

inline Vector vectorOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// What copies of a run share.
struct Run::Data {
  explicit Data(careen::Run of) : run(std::move(of)), trajectory(run.trajectory) {
    for (const Body& body : trajectory.world.bodies) {
      names.push_back(body.name);
    }
    for (const careen::Impact& each : trajectory.impacts) {
      impacts.push_back({.time = each.time,
                         .a = trajectory.world.bodies.at(static_cast<std::size_t>(each.a.value)).name,
                         .b = trajectory.partnerName(each),
                         .point = vectorOf(each.point),
                         .normal = vectorOf(each.normal),
                         .approach = each.approach,
                         .impulse = each.impulse,
                         .tangential = each.tangential});
    }
  }

  /// Audits it, the first time.
  const careen::Run& audited() {
    std::call_once(once, [this] { auditRun(run, AuditDepth::kUsual, {}); });
    return run;
  }

  careen::Run run;
  Trajectory& trajectory;
  std::once_flag once;
  std::vector<std::string> names;
  std::vector<Impact> impacts;
};

}  // namespace careen::v1
