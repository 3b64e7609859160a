#pragma once

#include <optional>

#include "render/draw/cell_inputs.h"
#include "render/draw/frame_block.h"
#include "render/draw/picture_cells.h"

namespace careen {

/// Which cells of a picture differ from the one that was drawn before: those that are drawn from something
/// else. While the eye moves, or anything else that all cells have in common, all of them do, and nothing is
/// compared.
class ChangedCells {
 public:
  /// Begins a picture of this size [px]. If it may be compared, what it is drawn from is to be added to
  /// inputs(), which there are once a picture has the same block as the one before.
  void begin(const View& view, const FrameBlock& block, int width, int height, bool mayBeCompared);
  CellInputs* inputs() { return inputs_ ? &*inputs_ : nullptr; }
  /// Where surfaces need something to be drawn belongs to the inputs, too.
  void find(const PictureCells& shaded, const PictureCells& occluded);
  /// The picture is not the one before until it is drawn.
  void beginDrawing() { before_.reset(); }
  void endDrawing() { before_ = std::move(inputs_); }

  const PictureCells::Set& cells() const { return cells_; }

 private:
  FrameBlock block_;
  Vec3 eye_ = Vec3::Zero();
  std::optional<CellInputs> inputs_;
  std::optional<CellInputs> before_;  // of the picture that was drawn last, if known
  PictureCells::Set cells_;
};

}  // namespace careen
