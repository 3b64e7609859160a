// Overlays at the impacts of the last few frames.
#include <algorithm>
#include <span>
#include <variant>

#include "render/overlay/frame.h"

namespace careen {
namespace {

constexpr std::ptrdiff_t kMostImpacts = 400;  // a chattering box has more impacts than can be seen
constexpr double kNormalLength = 0.45;        // of the longest arrow

std::span<const Impact> recentImpacts(const OverlayFrame& frame) {
  const std::vector<Impact>& impacts = frame.trajectory.impacts;
  const double since = frame.time - kImpactFrames * frame.frameSeconds;
  const auto first = std::upper_bound(impacts.begin(), impacts.end(), since,
                                      [](double time, const Impact& each) { return time < each.time; });
  const auto last = std::upper_bound(first, impacts.end(), frame.time,
                                     [](double time, const Impact& each) { return time < each.time; });
  return {last - std::min(last - first, kMostImpacts), last};
}

// 1 at the impact, 0 when it has faded out.
double strengthOf(const OverlayFrame& frame, const Impact& impact) {
  return 1 - (frame.time - impact.time) / (kImpactFrames * frame.frameSeconds);
}

}  // namespace

void addContacts(OverlayShapes& shapes, const OverlayFrame& frame) {
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

void addImpulses(OverlayShapes& shapes, const OverlayFrame& frame) {
  for (const Impact& impact : recentImpacts(frame)) {
    const Vec3 impulse = impact.impulse * impact.normal;
    for (const double side : {1.0, -1.0}) {  // the other box gets the opposite impulse
      if (side < 0 && impact.b.isWall()) {
        continue;
      }
      std::optional<Stroke> arrow =
          arrowFor(frame, impact.point, side * impulse, frame.scales.impulse, kAmber);
      if (arrow) {
        arrow->width *= 1.5;
        arrow->ink.alpha = strengthOf(frame, impact);
        shapes.emplace_back(*arrow);
      }
    }
  }
}

}  // namespace careen
