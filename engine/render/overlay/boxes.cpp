// Overlays drawn at boxes: arrows and trails.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <tuple>

#include "render/overlay/frame.h"

namespace careen {
namespace {

constexpr double kShortestArrow = 2;              // [px]
constexpr double kTrailBudget = 16000;            // states evaluated for the trails of one frame
constexpr int kTrailMostSamples = 600;            // per trail
constexpr std::ptrdiff_t kTrailMostTimes = 1200;  // sample times per trail, including impacts
constexpr double kTrailTurn = 0.15;               // [rad] largest rotation of a box between two samples
constexpr double kBehindItsBox = 0.3;             // opacity of a trail behind its own box
constexpr std::size_t kCornerFollowed = 0;        // the corner at +x +y +z

template <class Vector>
void addArrows(OverlayShapes& shapes, const OverlayFrame& frame, double largest, const Color& color,
               Vector vectorOf) {
  for (const std::size_t body : frame.farthestFirst) {
    const Vec3& centre = frame.states[body].pose.position;
    if (const std::optional<Stroke> arrow = arrowFor(frame, centre, vectorOf(body), largest, color)) {
      shapes.emplace_back(*arrow);
    }
  }
}

Vec3 spinOf(const OverlayFrame& frame, std::size_t body) {
  return angularVelocity(frame.trajectory.world.bodies[body].mass, frame.states[body]);
}

Vec3 cornerAt(const OverlayFrame& frame, std::size_t body, double time) {
  return frame.trajectory.state(body, time)
      .pose.worldPoint(corner(frame.trajectory.world.bodies[body], kCornerFollowed));
}

bool concerns(const Impact& impact, std::size_t body) {
  const int index = static_cast<int>(body);
  return impact.a.value == index || impact.b.isBody(index);
}

// Sample times of a trail: a time grid that is the same for all frames, impacts of the box, and the current
// time.
std::vector<double> trailTimes(const OverlayFrame& frame, std::size_t body) {
  const double perBox = kTrailBudget / static_cast<double>(frame.states.size());
  double step = kTrailSeconds / std::clamp(perBox, 12.0, 180.0);
  const double spin = spinOf(frame, body).norm();
  if (spin * step > kTrailTurn) {
    step = kTrailTurn / spin;
  }
  const double begin = std::max(0.0, frame.time - std::min(kTrailSeconds, kTrailMostSamples * step));
  std::vector<double> times = {begin};
  // Beyond 2⁵² steps the times of the grid would be no different ones.
  for (std::int64_t k = begin / step < 0x1p52 ? static_cast<std::int64_t>(begin / step) + 1 : 0;
       k > 0 && static_cast<double>(k) * step < frame.time; ++k) {
    times.push_back(static_cast<double>(k) * step);
  }
  const std::vector<Impact>& impacts = frame.trajectory.impacts;
  auto impact = std::lower_bound(impacts.begin(), impacts.end(), begin,
                                 [](const Impact& each, double time) { return each.time < time; });
  for (; impact != impacts.end() && impact->time < frame.time; ++impact) {
    if (concerns(*impact, body) && std::ssize(times) < kTrailMostTimes) {
      times.push_back(impact->time);
    }
  }
  times.push_back(frame.time);
  std::sort(times.begin(), times.end());
  return times;
}

bool isResting(const OverlayFrame& frame, std::size_t body) {
  const Vec3 now = cornerAt(frame, body, frame.time);
  const auto moved = [&](double ago) {
    return (cornerAt(frame, body, std::max(0.0, frame.time - ago)) - now).norm();
  };
  const double seen = 0.5 * frame.screen.metresPerPixel(now);
  return std::max({moved(kTrailSeconds), moved(0.61 * kTrailSeconds), moved(0.2 * kTrailSeconds)}) < seen;
}

// One third towards ivory: a box's own colour would not stand out against its face.
Color lightened(const Color& color) {
  const auto mixed = [](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((2 * a + b) / 3);
  };
  return {mixed(color.red, kIvory.red), mixed(color.green, kIvory.green), mixed(color.blue, kIvory.blue)};
}

// Whether a box occludes a point seen from the eye (slab method).
bool hides(const Pose& pose, const Vec3& halfExtents, const Vec3& eye, const Vec3& point) {
  const Vec3 from = pose.worldFromBody.transpose() * (eye - pose.position);
  const Vec3 way = pose.worldFromBody.transpose() * (point - eye);
  double enter = 0;
  double leave = 1 - 1e-6;  // the point itself may lie on the box
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      leave = std::abs(from[axis]) < halfExtents[axis] ? leave : -1;
      continue;
    }
    const double a = (-halfExtents[axis] - from[axis]) / way[axis];
    const double b = (halfExtents[axis] - from[axis]) / way[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

void addTrail(OverlayShapes& shapes, const OverlayFrame& frame, std::size_t body) {
  const auto visibility = [&](const Vec3& point) {
    const Body& moved = frame.trajectory.world.bodies[body];
    return hides(boxPose(moved, frame.states[body].pose), moved.halfExtents, frame.screen.eye(), point)
               ? kBehindItsBox
               : 1.0;
  };
  std::vector<Ribbon> pieces(1);
  for (const double time : trailTimes(frame, body)) {
    const Vec3 point = cornerAt(frame, body, time);
    const std::optional<Vec2> at = frame.screen.at(point);
    if (at) {
      pieces.back().points.push_back(
          {.at = *at, .strength = 1 - (frame.time - time) / kTrailSeconds, .alpha = visibility(point)});
    } else if (!pieces.back().points.empty()) {
      pieces.emplace_back();
    }
  }
  const Color color = lightened(frame.trajectory.stage.colors[body]);
  const double width = 1.25 * frame.style.line;
  for (const bool isRim : {true, false}) {
    for (Ribbon& piece : pieces) {
      piece.width = isRim ? width + 2 * frame.style.halo : width;
      piece.ink = isRim ? Ink{kSlate, 0.4} : Ink{color, 1};
      shapes.emplace_back(piece);
    }
  }
  const Vec3 now = cornerAt(frame, body, frame.time);
  if (const std::optional<Vec2> at = frame.screen.at(now)) {
    shapes.emplace_back(Stroke{.from = *at,
                               .to = *at,
                               .width = 2.2 * width,
                               .halo = frame.style.halo,
                               .ink = {color, visibility(now)}});
  }
}

}  // namespace

std::optional<Stroke> arrowFor(const OverlayFrame& frame, const Vec3& point, const Vec3& vector,
                               double largest, const Color& color) {
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

void addTrails(OverlayShapes& shapes, const OverlayFrame& frame) {
  for (const std::size_t body : frame.farthestFirst) {
    if (!isImmovable(frame.trajectory.world.bodies[body].mass) && !isResting(frame, body)) {
      addTrail(shapes, frame, body);
    }
  }
}

void addVelocities(OverlayShapes& shapes, const OverlayFrame& frame) {
  addArrows(shapes, frame, frame.scales.speed, kTeal,
            [&](std::size_t body) { return frame.states[body].velocity; });
}

void addAngularMomenta(OverlayShapes& shapes, const OverlayFrame& frame) {
  addArrows(shapes, frame, frame.scales.angularMomentum, kViolet,
            [&](std::size_t body) { return frame.states[body].angularMomentum; });
}

void addSpinAxes(OverlayShapes& shapes, const OverlayFrame& frame) {
  // The axis continues backwards as a thin line to show that it passes through the centre.
  for (const std::size_t body : frame.farthestFirst) {
    const Vec3& centre = frame.states[body].pose.position;
    std::optional<Stroke> back =
        arrowFor(frame, centre, -spinOf(frame, body), frame.scales.angularSpeed, kMoss);
    if (back) {
      back->head = 0;
      back->width *= 0.6;
      shapes.emplace_back(*back);
    }
  }
  addArrows(shapes, frame, frame.scales.angularSpeed, kMoss,
            [&](std::size_t body) { return spinOf(frame, body); });
}

}  // namespace careen
