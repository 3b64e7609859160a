#include "render/draw/changed_cells.h"

#include <array>
#include <bit>
#include <cstdint>

namespace careen {

void ChangedCells::begin(const View& view, const FrameBlock& block, int width, int height,
                         bool mayBeCompared) {
  using Bits = std::array<std::uint32_t, sizeof(FrameBlock) / sizeof(std::uint32_t)>;
  const bool isSame = std::bit_cast<Bits>(block) == std::bit_cast<Bits>(block_) && view.eye == eye_;
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
