#include "render/overlay/frame.h"

namespace careen {
namespace {

void addImpulses(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown) {
  for (const Impact& impact : recentImpacts(frame)) {
    const Vec3 impulse = impact.impulse * impact.normal;
    for (const double side : {1.0, -1.0}) {  // the other box gets the opposite impulse
      if (side < 0 && impact.b.isWall()) {
        continue;
      }
      std::optional<Stroke> arrow = arrowFor(frame, impact.point, side * impulse, shown.largest, kAmber);
      if (arrow) {
        arrow->width *= 1.5;
        arrow->ink.alpha = strengthOf(frame, impact);
        shapes.emplace_back(*arrow);
      }
    }
  }
}

}  // namespace

constexpr OverlayKind kImpulsesOverlay = {
    .shows = "the normal impulses, as arrows of proportional length, fading likewise",
    .layer = OverlayLayer::kImpacts,
    .legend = ArrowMeaning{.row = 3,
                           .name = "impulse",
                           .unit = "N s",
                           .color = kAmber,
                           .ofImpact = [](const Impact& impact) { return impact.impulse; }},
    .add = addImpulses};

}  // namespace careen
