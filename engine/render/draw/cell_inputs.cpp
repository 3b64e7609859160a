#include "render/draw/cell_inputs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace careen {
namespace {

// Both steps are one-to-one: numbers that differ in one place have different results.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15U;
  return hash ^ (hash >> 32U);
}

}  // namespace

std::uint64_t digest(std::span<const float> numbers, std::uint64_t before) {
  std::uint64_t hash = mixed(before, numbers.size());
  const auto at = [&](std::size_t i) { return std::uint64_t{std::bit_cast<std::uint32_t>(numbers[i])}; };
  std::size_t i = 0;
  for (; i + 1 < numbers.size(); i += 2) {
    hash = mixed(hash, at(i) | at(i + 1) << 32U);
  }
  return i < numbers.size() ? mixed(hash, at(i)) : hash;
}

CellInputs::CellInputs(View view, int width, int height)
    : view_(std::move(view)), width_(width), height_(height) {}

std::size_t CellInputs::add(std::span<const Vec3> outline, double reach, std::uint64_t records) {
  const std::size_t begin = cells_.size();
  // Cells end at whole pixels.
  const Vec2 margin((reach + 1) * PictureCells::kColumns / width_,
                    (reach + 1) * PictureCells::kRows / height_);
  PictureCells::append(view_, outline, margin, cells_);
  pieces_.push_back({.begin = begin, .end = cells_.size()});
  for (const std::uint16_t cell : cellsOf(pieces_.back())) {
    inputs_.at(cell) = mixed(inputs_.at(cell), records);
  }
  return pieces_.size() - 1;
}

std::size_t CellInputs::addAt(std::size_t piece, std::uint64_t records) {
  pieces_.push_back(pieces_[piece]);
  for (const std::uint16_t cell : cellsOf(pieces_.back())) {
    inputs_.at(cell) = mixed(inputs_.at(cell), records);
  }
  return pieces_.size() - 1;
}

void CellInputs::addTo(int column, int row, std::uint64_t records) {
  std::uint64_t& input = inputs_.at(PictureCells::indexOf(column, row));
  input = mixed(input, records);
}

void CellInputs::addEverywhere(std::uint64_t records) {
  for (std::uint64_t& input : inputs_) {
    input = mixed(input, records);
  }
}

PictureCells::Set CellInputs::changedSince(const CellInputs& before) const {
  PictureCells::Set changed;
  for (std::size_t cell = 0; cell < inputs_.size(); ++cell) {
    changed[cell] = inputs_.at(cell) != before.inputs_.at(cell);
  }
  return changed;
}

bool CellInputs::isIn(std::size_t piece, const PictureCells::Set& cells) const {
  const std::span<const std::uint16_t> own = cellsOf(pieces_[piece]);
  return std::any_of(own.begin(), own.end(), [&](std::uint16_t cell) { return cells[cell]; });
}

std::vector<std::uint32_t> PieceVertices::trianglesIn(std::span<const std::uint32_t> triangles,
                                                      const CellInputs& inputs,
                                                      const PictureCells::Set& cells) const {
  std::vector<std::uint32_t> kept;
  auto piece = ends_.begin();
  bool isDrawn = piece != ends_.end() && inputs.isIn(piece->piece, cells);
  for (std::size_t corner = 0; corner < triangles.size(); corner += 3) {
    while (triangles[corner] >= piece->vertex) {
      ++piece;
      isDrawn = inputs.isIn(piece->piece, cells);
    }
    if (isDrawn) {
      kept.insert(kept.end(), {triangles[corner], triangles[corner + 1], triangles[corner + 2]});
    }
  }
  return kept;
}

}  // namespace careen
