#include <cmath>
#include <vector>

#include "render/overlay/frame.h"

namespace careen {
namespace {

// By joint of the world, at the time of the frame.
std::vector<double> effortsOf(const OverlayFrame& frame) {
  std::vector<double> efforts(frame.trajectory.world.joints.size(), 0);
  for (const JointEffort& each : frame.trajectory.jointEfforts) {
    if (each.time > frame.time) {
      break;
    }
    efforts[static_cast<std::size_t>(each.joint)] = each.effort;
  }
  return efforts;
}

void addEfforts(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown) {
  const std::vector<double> efforts = effortsOf(frame);
  const auto poseOf = [&](const JointEnd& end) {
    return end.body ? frame.states[static_cast<std::size_t>(*end.body)].pose : Pose{};
  };
  for (std::size_t j = 0; j < efforts.size(); ++j) {
    const Joint& joint = frame.trajectory.world.joints[j];
    const Vec3 axis = joint.to.axesAt(poseOf(joint.to)).col(2);
    const Vec3 point = joint.from.pointAt(poseOf(joint.from));
    if (const auto arrow = arrowFor(frame, point, efforts[j] * axis, shown.largest, kRose)) {
      shapes.emplace_back(*arrow);
    }
  }
}

}  // namespace

constexpr OverlayKind kEffortsOverlay = {
    .shows =
        "the efforts of motors, as arrows along the axes of their joints: a force, or a torque about the "
        "arrow by the right hand",
    .layer = OverlayLayer::kArrows,
    .legend = ArrowMeaning{.row = 4,
                           .name = "effort",
                           .unit = "N m or N",
                           .color = kRose,
                           .ofEffort = [](const JointEffort& effort) { return std::fabs(effort.effort); }},
    .add = addEfforts};

}  // namespace careen
