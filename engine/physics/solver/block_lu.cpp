#include "physics/solver/block_lu.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace careen {
namespace {

constexpr std::size_t kSize = BlockLu::kSize;
using Block = BlockLu::Block;

/// [1] Smaller pivots would overflow sooner or later.
constexpr double kLeastPivot = 0x1p-64;

/// L U of a block, with ones on L's diagonal and reciprocals on U's; `before` as in factorise().
bool factoriseBlock(Block& a, const double* before) {
  for (std::size_t k = 0; k < kSize; ++k) {
    const double pivot = a[k * kSize + k];
    if (!(std::fabs(pivot) > kLeastPivot * std::fabs(before[k])) || !std::isfinite(pivot)) {
      return false;
    }
    const double inverse = 1 / pivot;
    a[k * kSize + k] = inverse;
    for (std::size_t i = k + 1; i < kSize; ++i) {
      const double factor = a[i * kSize + k] * inverse;
      a[i * kSize + k] = factor;
      for (std::size_t j = k + 1; j < kSize; ++j) {
        a[i * kSize + j] -= factor * a[k * kSize + j];
      }
    }
  }
  return true;
}

/// b ← L⁻¹ b.
void divideByLower(const Block& lu, Block& b) {
  for (std::size_t i = 1; i < kSize; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double factor = lu[i * kSize + k];
      for (std::size_t j = 0; j < kSize; ++j) {
        b[i * kSize + j] -= factor * b[k * kSize + j];
      }
    }
  }
}

/// b ← b U⁻¹.
void divideByUpper(const Block& lu, Block& b) {
  for (std::size_t i = 0; i < kSize; ++i) {
    double* row = &b[i * kSize];
    for (std::size_t k = 0; k < kSize; ++k) {
      row[k] *= lu[k * kSize + k];
      for (std::size_t j = k + 1; j < kSize; ++j) {
        row[j] -= row[k] * lu[k * kSize + j];
      }
    }
  }
}

/// c −= a b.
void subtractProduct(const Block& a, const Block& b, Block& c) {
  for (std::size_t i = 0; i < kSize; ++i) {
    std::array<double, kSize> row;
    std::copy_n(&c[i * kSize], kSize, row.begin());
    for (std::size_t k = 0; k < kSize; ++k) {
      const double factor = a[i * kSize + k];
      for (std::size_t j = 0; j < kSize; ++j) {
        row[j] -= factor * b[k * kSize + j];
      }
    }
    std::copy_n(row.begin(), kSize, &c[i * kSize]);
  }
}

/// y −= a x.
void subtractProduct(const Block& a, const double* x, double* y) {
  for (std::size_t i = 0; i < kSize; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < kSize; ++k) {
      sum += a[i * kSize + k] * x[k];
    }
    y[i] -= sum;
  }
}

}  // namespace

void BlockLu::setPattern(std::size_t rows, std::span<const std::pair<int, int>> edges) {
  std::vector<std::set<int>> below(rows);
  for (const auto& [i, j] : edges) {
    below[static_cast<std::size_t>(std::min(i, j))].insert(std::max(i, j));
  }
  for (std::size_t k = 0; k < rows; ++k) {  // what column k fills
    if (!below[k].empty()) {
      const int parent = *below[k].begin();
      below[static_cast<std::size_t>(parent)].insert(std::next(below[k].begin()), below[k].end());
    }
  }
  diagonal_.resize(rows);
  before_.resize(rows * kSize);
  columns_.assign(rows, {});
  std::size_t next = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    diagonal_[k] = next++;
    for (const int i : below[k]) {
      columns_[k].push_back({.row = i, .lower = next, .upper = next + 1});
      next += 2;
    }
  }
  blocks_.resize(next);
  updated_.assign(rows, {});
  for (std::size_t k = 0; k < rows; ++k) {
    for (const Entry& i : columns_[k]) {
      for (const Entry& j : columns_[k]) {
        updated_[k].push_back(find(i.row, j.row));
      }
    }
  }
}

std::size_t BlockLu::find(int i, int j) const {
  const auto column = static_cast<std::size_t>(std::min(i, j));
  if (i == j) {
    return diagonal_[column];
  }
  const std::vector<Entry>& entries = columns_[column];
  const auto entry = std::lower_bound(entries.begin(), entries.end(), std::max(i, j),
                                      [](const Entry& candidate, int row) { return candidate.row < row; });
  return i > j ? entry->lower : entry->upper;
}

void BlockLu::setZero() {
  for (Block& block : blocks_) {
    block.fill(0);
  }
}

bool BlockLu::factorise() {
  for (std::size_t k = 0; k < rows(); ++k) {
    for (std::size_t i = 0; i < kSize; ++i) {
      before_[k * kSize + i] = blocks_[diagonal_[k]][i * kSize + i];
    }
  }
  for (std::size_t k = 0; k < rows(); ++k) {
    if (!factoriseBlock(blocks_[diagonal_[k]], &before_[k * kSize])) {
      return false;
    }
    eliminate(k);
  }
  return true;
}

void BlockLu::eliminate(std::size_t k) {
  const Block& pivot = blocks_[diagonal_[k]];
  const std::vector<Entry>& entries = columns_[k];
  for (const Entry& entry : entries) {
    divideByLower(pivot, blocks_[entry.upper]);
    divideByUpper(pivot, blocks_[entry.lower]);
  }
  const std::size_t* updated = updated_[k].data();
  for (const Entry& i : entries) {
    for (const Entry& j : entries) {
      subtractProduct(blocks_[i.lower], blocks_[j.upper], blocks_[*updated++]);
    }
  }
}

bool BlockLu::isNegative() const {
  bool negative = false;
  for (const std::size_t diagonal : diagonal_) {
    for (std::size_t i = 0; i < kSize; ++i) {
      negative = negative != (blocks_[diagonal][i * kSize + i] < 0);
    }
  }
  return negative;
}

void BlockLu::solve(std::span<double> x) const {
  for (std::size_t k = 0; k < rows(); ++k) {
    const Block& lu = blocks_[diagonal_[k]];
    double* part = &x[k * kSize];
    for (std::size_t i = 1; i < kSize; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        part[i] -= lu[i * kSize + j] * part[j];
      }
    }
    for (const Entry& entry : columns_[k]) {
      subtractProduct(blocks_[entry.lower], part, &x[static_cast<std::size_t>(entry.row) * kSize]);
    }
  }
  for (std::size_t k = rows(); k-- > 0;) {
    const Block& lu = blocks_[diagonal_[k]];
    double* part = &x[k * kSize];
    for (const Entry& entry : columns_[k]) {
      subtractProduct(blocks_[entry.upper], &x[static_cast<std::size_t>(entry.row) * kSize], part);
    }
    for (std::size_t i = kSize; i-- > 0;) {
      for (std::size_t j = i + 1; j < kSize; ++j) {
        part[i] -= lu[i * kSize + j] * part[j];
      }
      part[i] *= lu[i * kSize + i];
    }
  }
}

}  // namespace careen
