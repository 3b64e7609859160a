#include "render/overlay/frame.h"

namespace careen {

constexpr OverlayKind kAngularMomentumOverlay = {
    .shows = "the angular momenta about the centres of mass, as arrows there",
    .layer = OverlayLayer::kArrows,
    .legend = ArrowMeaning{.row = 1,
                           .name = "angular momentum",
                           .unit = "kg m²/s",
                           .color = kViolet,
                           .ofBody = [](const MassProperties& mass, const BodyState& state) -> Vec3 {
                             return isImmovable(mass) ? Vec3(Vec3::Zero()) : state.angularMomentum;
                           }},
    .add = addArrows};

}  // namespace careen
