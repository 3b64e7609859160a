#include "render/overlay/frame.h"

namespace careen {

constexpr OverlayKind kVelocityOverlay = {
    .shows = "the velocities of the centres of mass, as arrows there",
    .layer = OverlayLayer::kArrows,
    .legend = ArrowMeaning{.row = 0,
                           .name = "velocity",
                           .unit = "m/s",
                           .color = kTeal,
                           .ofBody = [](const MassProperties& /*mass*/, const BodyState& state) -> Vec3 {
                             return state.velocity;
                           }},
    .add = addArrows};

}  // namespace careen
