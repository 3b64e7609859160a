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
constexpr std::array<NamedAdd, 6> kInOrder = {{{Overlay::kTrail, addTrails},
                                               {Overlay::kSpinAxis, addSpinAxes},
                                               {Overlay::kAngularMomentum, addAngularMomenta},
                                               {Overlay::kVelocity, addVelocities},
                                               {Overlay::kContacts, addContacts},
                                               {Overlay::kImpulses, addImpulses}}};

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
  if (shown.has(Overlay::kNames)) {
    names_.emplace(trajectory, frameSeconds);
  }
}

// The data of a moment, and what they refer to.
class Overlays::Frame {
 public:
  Frame(const Overlays& of, const OverlayMoment& moment, int width, int height)
      : states_(statesAt(of.trajectory_, moment.sceneTime)),
        screen_(moment.view, width, height),
        order_(orderOf(states_, screen_)),
        data_{.trajectory = of.trajectory_,
              .time = moment.sceneTime,
              .frameSeconds = of.frameSeconds_,
              .states = states_,
              .farthestFirst = order_,
              .scales = of.scales_,
              .fonts = of.fonts_ ? &*of.fonts_ : nullptr,
              .energy = of.energy_ ? &*of.energy_ : nullptr,
              .ghost = of.ghost_,
              .screen = screen_,
              .style = OverlayStyle(height)} {}
  ~Frame() = default;
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  Frame(Frame&&) = delete;
  Frame& operator=(Frame&&) = delete;

  const OverlayFrame& data() const { return data_; }

 private:
  static std::vector<std::size_t> orderOf(const std::vector<BodyState>& states, const Screen& screen) {
    std::vector<Vec3> centres;
    std::transform(states.begin(), states.end(), std::back_inserter(centres),
                   [](const BodyState& state) { return state.pose.position; });
    return farthestFirst(screen, centres);
  }

  std::vector<BodyState> states_;
  Screen screen_;
  std::vector<std::size_t> order_;
  OverlayFrame data_;
};

// Names avoid the panels at the edges and what belongs to them.
std::vector<Plate> Overlays::panelsAt(const OverlayFrame& frame) const {
  OverlayShapes shapes;
  addPanels(shapes, frame, shown_);
  std::vector<Plate> panels;
  for (const OverlayShape& shape : shapes) {
    if (const Plate* const plate = std::get_if<Plate>(&shape)) {
      panels.push_back(*plate);
    }
  }
  return panels;
}

FreeNamePlaces Overlays::freePlacesAt(const OverlayMoment& moment, int width, int height) const {
  const Frame frame(*this, moment, width, height);
  return freeNamePlaces(frame.data(), names_->bodies(), panelsAt(frame.data()));
}

OverlayShapes Overlays::shapesAt(double filmTime, const MomentAt& momentAt, int width, int height) {
  const Frame now(*this, momentAt(filmTime), width, height);
  const OverlayFrame& frame = now.data();
  OverlayShapes shapes;
  if (ghost_ != nullptr) {
    addGhost(shapes, frame);
  }
  for (const NamedAdd& each : kInOrder) {
    if (shown_.has(each.overlay)) {
      each.add(shapes, frame);
    }
  }
  addPanels(shapes, frame, shown_);
  if (names_) {
    names_->add(shapes, frame, filmTime, momentAt,
                [&](const OverlayMoment& moment) { return freePlacesAt(moment, width, height); });
  }
  return shapes;
}

}  // namespace careen
