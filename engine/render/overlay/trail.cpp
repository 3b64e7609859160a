#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/overlay/frame.h"

namespace careen {
namespace {

constexpr double kTrailBudget = 16000;            // states evaluated for the trails of one frame
constexpr int kTrailMostSamples = 600;            // per trail
constexpr std::ptrdiff_t kTrailMostTimes = 1200;  // sample times per trail, including impacts
constexpr double kTrailTurn = 0.15;               // [rad] largest rotation of a box between two samples
constexpr double kBehindItsBox = 0.3;             // opacity of a trail behind its own box
constexpr std::size_t kCornerFollowed = 0;        // the corner at +x +y +z

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
  const double spin = angularVelocity(frame.trajectory.world.bodies[body].mass, frame.states[body]).norm();
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

void addTrails(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& /*shown*/) {
  for (const std::size_t body : frame.farthestFirst) {
    if (!isImmovable(frame.trajectory.world.bodies[body].mass) && !isResting(frame, body)) {
      addTrail(shapes, frame, body);
    }
  }
}

}  // namespace

constexpr OverlayKind kTrailOverlay = {
    .shows = "the path of one corner of each moving box over the last 1.5 s",
    .layer = OverlayLayer::kTrails,
    .add = addTrails};

}  // namespace careen
