#include "render/overlay/frame.h"

namespace careen {
namespace {

void addSpinAxes(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown) {
  // The axis continues backwards as a thin line to show that it passes through the centre.
  for (const std::size_t body : frame.farthestFirst) {
    const BodyState& state = frame.states[body];
    const Vec3 spin = angularVelocity(frame.trajectory.world.bodies[body].mass, state);
    std::optional<Stroke> back = arrowFor(frame, state.pose.position, -spin, shown.largest, kMoss);
    if (back) {
      back->head = 0;
      back->width *= 0.6;
      shapes.emplace_back(*back);
    }
  }
  addArrows(shapes, frame, shown);
}

}  // namespace

constexpr OverlayKind kSpinAxisOverlay = {
    .shows = "the instantaneous axis of rotation, with an arrow for the angular speed",
    .layer = OverlayLayer::kAxes,
    .legend =
        ArrowMeaning{.row = 2, .name = "spin", .unit = "rad/s", .color = kMoss, .ofBody = angularVelocity},
    .add = addSpinAxes};

}  // namespace careen
