#include "physics/exact/crowd_motors.h"

#include <algorithm>
#include <limits>

namespace careen {

double untilChange(const Bodies& bodies, Crowd& crowd, const Instant& time) {
  double change = std::numeric_limits<double>::infinity();
  for (const CrowdArticulations::Listed& each : crowd.articulations().joints()) {
    change = std::min(change, untilChange(bodies, *each.joint, time));
  }
  return change;
}

double workOfMotors(Crowd& crowd) {
  double work = 0;
  const CrowdArticulations& articulations = crowd.articulations();
  const auto beginOf = [&](int place) {
    if (place >= CrowdArticulations::kOutside || !crowd.moved(static_cast<std::size_t>(place))) {
      return articulations.poseOf(place);
    }
    const StepEnd begin = crowd.begin(static_cast<std::size_t>(place));
    return Pose{.position = begin.position, .worldFromBody = begin.worldFromBody.toRotationMatrix()};
  };
  for (const CrowdArticulations::Listed& each : articulations.joints()) {
    if (each.effort != 0) {
      const double from = jointCoordinate(*each.joint, beginOf(each.a), beginOf(each.b));
      const double to =
          jointCoordinate(*each.joint, articulations.poseOf(each.a), articulations.poseOf(each.b));
      work += each.effort * (inNearestTurn(*each.joint, to, from) - from);
    }
  }
  return work;
}

}  // namespace careen
