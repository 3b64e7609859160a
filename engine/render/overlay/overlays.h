#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "render/overlay/frame.h"
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

  /// `time` within the run [s]; `width`, `height` of the picture [px].
  OverlayShapes shapesAt(double time, const View& view, int width, int height) const;
  const OverlayScales& scales() const { return scales_; }

 private:
  const Trajectory& trajectory_;
  OverlaySet shown_;
  double frameSeconds_;
  const Trajectory* ghost_;
  OverlayScales scales_;
  std::optional<OverlayFonts> fonts_;
  std::optional<EnergyBook> energy_;
};

}  // namespace careen
