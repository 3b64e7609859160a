#include "render/overlay/frame.h"

namespace careen {
namespace {

void addForces(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown) {
  for (const ContactPush& push : *frame.forces) {
    for (const double side : {1.0, -1.0}) {  // the other box is pushed the opposite way
      if (side < 0 && (!push.b || push.b->isWall())) {
        continue;
      }
      if (const auto arrow = arrowFor(frame, push.point, side * push.force, shown.largest, kCoral)) {
        shapes.emplace_back(*arrow);
      }
    }
  }
}

}  // namespace

constexpr OverlayKind kForcesOverlay = {
    .shows =
        "the forces of contact with friction, as arrows at the points at which they push; where contacts are "
        "redundant, those with the least sum of squares",
    .layer = OverlayLayer::kArrows,
    .needs = OverlayNeeds::kForces,
    .legend = ArrowMeaning{.row = 5,
                           .name = "force",
                           .unit = "N",
                           .color = kCoral,
                           .ofPush = [](const ContactPush& push) { return push.force.norm(); }},
    .add = addForces};

}  // namespace careen
