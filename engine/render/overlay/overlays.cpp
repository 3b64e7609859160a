#include "render/overlay/overlays.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "render/overlay/titles.h"

namespace careen {
namespace {

#define CAREEN_OVERLAY_ADDRESS(Name, name) &k##Name##Overlay,
constexpr std::array kKinds = {CAREEN_OVERLAYS(CAREEN_OVERLAY_ADDRESS)};  // in the order of Overlay

std::vector<ShownOverlay> backToFront(const OverlaySet& set) {
  std::vector<ShownOverlay> shown;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (set.has(static_cast<Overlay>(i))) {
      shown.push_back({.kind = kKinds.at(i)});
    }
  }
  std::stable_sort(shown.begin(), shown.end(), [](const ShownOverlay& a, const ShownOverlay& b) {
    return a.kind->layer < b.kind->layer;
  });
  return shown;
}

// Sampled over the whole run, with fewer samples if there are many boxes.
void findLargestOfBodies(std::span<ShownOverlay* const> arrows, const Trajectory& trajectory) {
  if (arrows.empty()) {
    return;
  }
  const int samples = 100'000 / static_cast<int>(std::max<std::size_t>(1, trajectory.tracks.size()));
  const int steps = std::clamp(samples, 16, 512);
  for (int step = 0; step <= steps; ++step) {
    const std::vector<BodyState> states = trajectory.states(trajectory.settings.duration * step / steps);
    for (std::size_t body = 0; body < states.size(); ++body) {
      for (ShownOverlay* const each : arrows) {
        const MassProperties& mass = trajectory.world.bodies[body].mass;
        each->largest = std::max(each->largest, each->kind->legend->ofBody(mass, states[body]).norm());
      }
    }
  }
}

// [N] Of the film, at some moments: to find the forces of one takes long.
double largestForce(const ArrowMeaning& legend, const Trajectory& trajectory) {
  constexpr int kMoments = 64;
  const ForceSamples samples(trajectory);
  double largest = 0;
  for (int k = 0; k <= kMoments; ++k) {
    for (const ContactPush& push : samples.at(trajectory.settings.duration * k / kMoments)) {
      largest = std::max(largest, legend.ofPush(push));
    }
  }
  return largest;
}

void findLargest(std::vector<ShownOverlay>& shown, const Trajectory& trajectory) {
  std::vector<ShownOverlay*> ofBodies;
  for (ShownOverlay& each : shown) {
    if (each.kind->legend && each.kind->legend->ofBody != nullptr) {
      ofBodies.push_back(&each);
    } else if (each.kind->legend && each.kind->legend->ofEffort != nullptr) {
      for (const JointEffort& effort : trajectory.jointEfforts) {
        each.largest = std::max(each.largest, each.kind->legend->ofEffort(effort));
      }
    } else if (each.kind->legend && each.kind->legend->ofPush != nullptr) {
      each.largest = largestForce(*each.kind->legend, trajectory);
    } else if (each.kind->legend) {
      for (const Impact& impact : trajectory.impacts) {
        each.largest = std::max(each.largest, each.kind->legend->ofImpact(impact));
      }
    }
  }
  findLargestOfBodies(ofBodies, trajectory);
}

bool isWritten(const ShownOverlay& shown) {
  return shown.kind->needs != OverlayNeeds::kNothing || shown.kind->legend;
}

}  // namespace

Overlays::Overlays(const Trajectory& trajectory, const OverlaySet& shown, double frameSeconds,
                   const Trajectory* ghost, std::span<const std::filesystem::path> folders)
    : trajectory_(trajectory), frameSeconds_(frameSeconds), ghost_(ghost), shown_(backToFront(shown)) {
  findLargest(shown_, trajectory);
  if (std::any_of(shown_.begin(), shown_.end(), isWritten) || ghost != nullptr ||
      !trajectory.stage.scenery.titles.empty()) {
    fonts_ = OverlayFonts{.plain = findFont(kPlainFont, folders),
                          .monospaced = findFont(kMonospacedFont, folders)};
  }
  for (const ShownOverlay& each : shown_) {
    if (each.kind->needs == OverlayNeeds::kEnergy) {
      energy_.emplace(trajectory);
    } else if (each.kind->needs == OverlayNeeds::kNames) {
      names_.emplace(trajectory, frameSeconds);
    } else if (each.kind->needs == OverlayNeeds::kForces) {
      forces_.emplace(trajectory);
    }
  }
}

// The data of a moment, and what they refer to.
class Overlays::Frame {
 public:
  Frame(const Overlays& of, const OverlayMoment& moment, int width, int height)
      : states_(of.trajectory_.states(moment.sceneTime)),
        screen_(moment.view, width, height),
        order_(orderOf(states_, screen_)),
        data_{.trajectory = of.trajectory_,
              .time = moment.sceneTime,
              .frameSeconds = of.frameSeconds_,
              .states = states_,
              .farthestFirst = order_,
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
  OverlayFrame frame = now.data();
  const Names::FreeAt freeAt = [&](const OverlayMoment& moment) {
    return freePlacesAt(moment, width, height);
  };
  std::optional<NamesNow> names;
  if (names_) {
    names.emplace(NamesNow{*names_, filmTime, momentAt, freeAt});
    frame.names = &*names;
  }
  std::vector<ContactPush> forces;
  if (forces_) {
    forces = forces_->at(frame.time);
    frame.forces = &forces;
  }
  OverlayShapes shapes;
  if (ghost_ != nullptr) {
    addGhost(shapes, frame);
  }
  const auto addLayers = [&](OverlayLayer first, OverlayLayer last) {
    for (const ShownOverlay& each : shown_) {
      if (each.kind->layer >= first && each.kind->layer <= last) {
        each.kind->add(shapes, frame, each);
      }
    }
  };
  addLayers(OverlayLayer::kTrails, OverlayLayer::kImpacts);
  addPanels(shapes, frame, shown_);
  addLayers(OverlayLayer::kNames, OverlayLayer::kNames);
  addTitles(shapes, frame, trajectory_.stage.scenery.titles, filmTime);
  return shapes;
}

std::unique_ptr<Overlays> overlaysOf(const Trajectory& run, const Trajectory* ghost) {
  const PictureSettings& picture = run.stage.picture;
  return picture.overlays.any() || ghost != nullptr || !run.stage.scenery.titles.empty()
             ? std::make_unique<Overlays>(run, picture.overlays, picture.rate.frameTime(1), ghost)
             : nullptr;
}

}  // namespace careen
