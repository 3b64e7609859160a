#include "render/overlay/overlays.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace careen {
namespace {

using Add = void (*)(OverlayShapes&, const OverlayFrame&);
struct NamedAdd {
  Overlay overlay;
  Add add;
};

// Back to front.
constexpr std::array<NamedAdd, 8> kInOrder = {{{Overlay::kTrail, addTrails},
                                               {Overlay::kSpinAxis, addSpinAxes},
                                               {Overlay::kAngularMomentum, addAngularMomenta},
                                               {Overlay::kVelocity, addVelocities},
                                               {Overlay::kContacts, addContacts},
                                               {Overlay::kImpulses, addImpulses},
                                               {Overlay::kEnergy, addEnergy},
                                               {Overlay::kTime, addTimeCode}}};

constexpr std::array kArrows = {Overlay::kVelocity, Overlay::kAngularMomentum, Overlay::kSpinAxis,
                                Overlay::kImpulses};

bool hasAny(const OverlaySet& shown, std::span<const Overlay> overlays) {
  return std::any_of(overlays.begin(), overlays.end(), [&](Overlay each) { return shown.has(each); });
}

bool isWritten(const OverlaySet& shown) {
  constexpr std::array kWritten = {Overlay::kNames, Overlay::kTime, Overlay::kEnergy};
  return hasAny(shown, kWritten) || hasAny(shown, kArrows);
}

// Sampled over the whole run, with fewer samples if there are many boxes.
OverlayScales scalesOf(const Trajectory& trajectory) {
  OverlayScales scales;
  const int samples = 100'000 / static_cast<int>(std::max<std::size_t>(1, trajectory.tracks.size()));
  const int steps = std::clamp(samples, 16, 512);
  for (int step = 0; step <= steps; ++step) {
    const std::vector<BodyState> states = statesAt(trajectory, trajectory.settings.duration * step / steps);
    for (std::size_t body = 0; body < states.size(); ++body) {
      const double spin = angularVelocity(trajectory.world.bodies[body].mass, states[body]).norm();
      scales.speed = std::max(scales.speed, states[body].velocity.norm());
      scales.angularMomentum = std::max(scales.angularMomentum, states[body].angularMomentum.norm());
      scales.angularSpeed = std::max(scales.angularSpeed, spin);
    }
  }
  for (const Impact& impact : trajectory.impacts) {
    scales.impulse = std::max(scales.impulse, impact.impulse);
  }
  return scales;
}

}  // namespace

Overlays::Overlays(const Trajectory& trajectory, const OverlaySet& shown, double frameSeconds,
                   const Trajectory* ghost, std::span<const std::filesystem::path> folders)
    : trajectory_(trajectory), shown_(shown), frameSeconds_(frameSeconds), ghost_(ghost) {
  if (hasAny(shown, kArrows)) {
    scales_ = scalesOf(trajectory);
  }
  if (isWritten(shown) || ghost != nullptr) {
    fonts_ = OverlayFonts{.plain = findFont(kPlainFont, folders),
                          .monospaced = findFont(kMonospacedFont, folders)};
  }
  if (shown.has(Overlay::kEnergy)) {
    energy_.emplace(trajectory);
  }
}

OverlayShapes Overlays::shapesAt(double time, const View& view, int width, int height) const {
  const std::vector<BodyState> states = statesAt(trajectory_, time);
  const Screen screen(view, width, height);
  std::vector<Vec3> centres;
  std::transform(states.begin(), states.end(), std::back_inserter(centres),
                 [](const BodyState& state) { return state.pose.position; });
  const std::vector<std::size_t> order = farthestFirst(screen, centres);
  const OverlayFrame frame{.trajectory = trajectory_,
                           .time = time,
                           .frameSeconds = frameSeconds_,
                           .states = states,
                           .farthestFirst = order,
                           .scales = scales_,
                           .fonts = fonts_ ? &*fonts_ : nullptr,
                           .energy = energy_ ? &*energy_ : nullptr,
                           .ghost = ghost_,
                           .screen = screen,
                           .style = OverlayStyle(height)};
  OverlayShapes shapes;
  if (ghost_ != nullptr) {
    addGhost(shapes, frame);
  }
  for (const NamedAdd& each : kInOrder) {
    if (shown_.has(each.overlay)) {
      each.add(shapes, frame);
    }
  }
  if (hasAny(shown_, kArrows)) {
    addLegend(shapes, frame, shown_);
  }
  if (shown_.has(Overlay::kNames)) {  // last, because names avoid the panels at the edges
    addNames(shapes, frame);
  }
  return shapes;
}

}  // namespace careen
