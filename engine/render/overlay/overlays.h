#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "render/overlay/frame.h"
#include "stage/overlay.h"

namespace careen {

/// What explains a film: shapes over its pictures, made from the run alone. What the whole film decides, such
/// as the longest arrow, is found once; only what is shown is looked for.
class Overlays {
 public:
  /// The run must live as long; `frameSeconds` [s] from one frame to the next. MachineError,
  /// which names the package to install, if something is to be written and there is no font in the folders.
  Overlays(const Trajectory& trajectory, const OverlaySet& shown, double frameSeconds,
           std::span<const std::filesystem::path> folders = fontFolders());

  /// At a time within the run [s], for a picture of this size [px] that is seen so.
  OverlayShapes shapesAt(double time, const View& view, int width, int height) const;
  const OverlayScales& scales() const { return scales_; }

 private:
  const Trajectory& trajectory_;
  OverlaySet shown_;
  double frameSeconds_;
  OverlayScales scales_;
  std::optional<OverlayFonts> fonts_;
  std::optional<EnergyBook> energy_;
};

}  // namespace careen
