#include "render/draw/changed_cells.h"

#include <cstring>

namespace careen {

void ChangedCells::begin(const View& view, const FrameBlock& block, int width, int height,
                         bool mayBeCompared) {
  static_assert(sizeof(FrameBlock) % sizeof(float) == 0 && alignof(FrameBlock) == alignof(float));
  const bool isSame = std::memcmp(&block, &block_, sizeof(block)) == 0 && view.eye == eye_;
  block_ = block;
  eye_ = view.eye;
  inputs_.reset();
  if (isSame && mayBeCompared) {
    inputs_.emplace(view, width, height);
  }
}

void ChangedCells::find(const PictureCells& shaded, const PictureCells& occluded) {
  cells_.set();
  if (!inputs_) {
    return;
  }
  for (int row = 0; row < PictureCells::kRows; ++row) {
    for (int column = 0; column < PictureCells::kColumns; ++column) {
      inputs_->addTo(column, row,
                     (shaded.isMarked(column, row) ? 1 : 0) + (occluded.isMarked(column, row) ? 2 : 0));
    }
  }
  if (before_) {
    cells_ = inputs_->changedSince(*before_);
  }
}

}  // namespace careen
