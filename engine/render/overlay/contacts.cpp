#include "render/overlay/frame.h"

namespace careen {
namespace {

void addContacts(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& /*shown*/) {
  constexpr double kNormalLength = 0.45;  // of the longest arrow
  for (const Impact& impact : recentImpacts(frame)) {
    const std::optional<Vec2> at = frame.screen.at(impact.point);
    if (!at) {
      continue;
    }
    const Ink ink{kIvory, strengthOf(frame, impact)};
    const double length =
        kNormalLength * frame.style.longestArrow * frame.screen.metresPerPixel(impact.point);
    if (const auto line = frame.screen.line(impact.point, impact.point + length * impact.normal)) {
      shapes.emplace_back(Stroke{.from = line->first,
                                 .to = line->second,
                                 .width = 0.6 * frame.style.line,
                                 .halo = frame.style.halo,
                                 .ink = ink});
    }
    shapes.emplace_back(Stroke{
        .from = *at, .to = *at, .width = 3.4 * frame.style.line, .halo = frame.style.halo, .ink = ink});
  }
}

}  // namespace

constexpr OverlayKind kContactsOverlay = {
    .shows = "contact points and normals of impacts, fading over eight frames",
    .layer = OverlayLayer::kImpacts,
    .add = addContacts};

}  // namespace careen
