#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/overlay/frame.h"
#include "render/overlay/names.h"
#include "stage/overlay.h"

namespace careen {

/// Overlay shapes for the pictures of a film, made from the run alone. Values of the whole film, such as the
/// longest arrow, are computed once, and only for the overlays shown.
class Overlays {
 public:
  /// Keeps references to the runs. `frameSeconds` [s]: from one frame to the next. `ghost`, if not null, is
  /// another run of the boxes: shown as outlines, with their distance. MachineError, naming the package to
  /// install, if there is text and no font in the folders.
  Overlays(const Trajectory& trajectory, const OverlaySet& shown, double frameSeconds,
           const Trajectory* ghost = nullptr, std::span<const std::filesystem::path> folders = fontFolders());

  /// With the titles of the stage. At this time of the film [s]; names ask for the moments around it too.
  /// `width`, `height` of the picture [px]. The same moments give the same shapes, whatever was asked before.
  OverlayShapes shapesAt(double filmTime, const MomentAt& momentAt, int width, int height);

 private:
  class Frame;
  std::vector<Plate> panelsAt(const OverlayFrame& frame) const;
  FreeNamePlaces freePlacesAt(const OverlayMoment& moment, int width, int height) const;

  const Trajectory& trajectory_;
  double frameSeconds_;
  const Trajectory* ghost_;
  std::vector<ShownOverlay> shown_;  // back to front
  std::optional<OverlayFonts> fonts_;
  std::optional<EnergyBook> energy_;
  std::optional<ForceSamples> forces_;
  std::optional<Names> names_;
};

/// Those that a run's stage asks for, and its titles, with that ghost; none if there is nothing to draw.
std::unique_ptr<Overlays> overlaysOf(const Trajectory& run, const Trajectory* ghost = nullptr);

}  // namespace careen
