// Impacts of the last few frames, for the overlays that mark them.
#include <algorithm>

#include "render/overlay/frame.h"

namespace careen {

std::span<const Impact> recentImpacts(const OverlayFrame& frame) {
  constexpr std::ptrdiff_t kMostImpacts = 400;  // a chattering box has more impacts than can be seen
  const std::vector<Impact>& impacts = frame.trajectory.impacts;
  const double since = frame.time - kImpactFrames * frame.frameSeconds;
  const auto first = std::upper_bound(impacts.begin(), impacts.end(), since,
                                      [](double time, const Impact& each) { return time < each.time; });
  const auto last = std::upper_bound(first, impacts.end(), frame.time,
                                     [](double time, const Impact& each) { return time < each.time; });
  return {last - std::min(last - first, kMostImpacts), last};
}

double strengthOf(const OverlayFrame& frame, const Impact& impact) {
  return 1 - (frame.time - impact.time) / (kImpactFrames * frame.frameSeconds);
}

}  // namespace careen
