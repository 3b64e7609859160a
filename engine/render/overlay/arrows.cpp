// Arrows, and what other overlays share with them.
#include <algorithm>
#include <iterator>
#include <tuple>

#include "render/overlay/frame.h"

namespace careen {

std::optional<Stroke> arrowFor(const OverlayFrame& frame, const Vec3& point, const Vec3& vector,
                               double largest, const Color& color) {
  constexpr double kShortestArrow = 2;  // [px]
  const double size = vector.norm();
  if (!(largest > 0) || !(size > 0) || !frame.screen.at(point)) {
    return std::nullopt;
  }
  const double pixels = frame.style.longestArrow * size / largest;
  if (pixels < kShortestArrow) {
    return std::nullopt;
  }
  const Vec3 end = point + pixels * frame.screen.metresPerPixel(point) / size * vector;
  const auto line = frame.screen.line(point, end);
  if (!line) {
    return std::nullopt;
  }
  return Stroke{.from = line->first,
                .to = line->second,
                .width = frame.style.line,
                .head = std::min(frame.style.head, (line->second - line->first).norm()),
                .halo = frame.style.halo,
                .ink = {color, 1}};
}

std::vector<std::size_t> farthestFirst(const Screen& screen, std::span<const Vec3> places) {
  std::vector<std::tuple<double, double, double, double, std::size_t>> sorted;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3& at = places[i];
    sorted.emplace_back(-screen.depth(at), at.x(), at.y(), at.z(), i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> order;
  std::transform(sorted.begin(), sorted.end(), std::back_inserter(order),
                 [](const auto& each) { return std::get<std::size_t>(each); });
  return order;
}

Plate plateFor(const OverlayStyle& style, const Vec2& min, const Vec2& max) {
  return {.min = min.array().round(),
          .max = max.array().round(),
          .rounding = 0.35 * style.text,
          .ink = {kSlate, kPlateAlpha}};
}

void addArrows(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown) {
  for (const std::size_t body : frame.farthestFirst) {
    const BodyState& state = frame.states[body];
    const Vec3 vector = shown.kind->legend->ofBody(frame.trajectory.world.bodies[body].mass, state);
    if (const std::optional<Stroke> arrow =
            arrowFor(frame, state.pose.position, vector, shown.largest, shown.kind->legend->color)) {
      shapes.emplace_back(*arrow);
    }
  }
}

}  // namespace careen
