#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace careen {

/// A = L U of a matrix of 6×6 blocks whose pattern is symmetric but whose values need not be. No pivoting:
/// the matrices are M + Jᵀ D J with M positive and D nearly positive semidefinite.
///
/// Right-looking block elimination on the filled pattern (J. A. George, J. W. H. Liu, Computer Solution of
/// Large Sparse Positive Definite Systems, 1981). Scaling rows and columns by powers of two changes no bit of
/// the result.
class BlockLu {
 public:
  static constexpr std::size_t kSize = 6;
  using Block = std::array<double, kSize * kSize>;  ///< row-major

  /// Blocks (i, j) and (j, i) for each edge i ≠ j, the diagonal, and their fill. Rows are eliminated from 0
  /// on. Repeated edges count once.
  void setPattern(std::size_t rows, std::span<const std::pair<int, int>> edges);

  std::size_t rows() const { return diagonal_.size(); }
  std::size_t diagonal(std::size_t row) const { return diagonal_[row]; }
  /// Index of block (i, j), to be given to block().
  std::size_t find(int i, int j) const;
  Block& block(std::size_t index) { return blocks_[index]; }
  void setZero();

  /// In place. Returns false if a pivot is no number, or nothing but rounding errors far below what was there
  /// before.
  bool factorise();
  /// Whether the determinant of what was factorised is negative.
  bool isNegative() const;
  /// A x = b in place, six numbers per row.
  void solve(std::span<double> x) const;

 private:
  struct Entry {  // row i > k of column k, and column i of row k
    int row;
    std::size_t lower;  // block (i, k)
    std::size_t upper;  // block (k, i)
  };
  void eliminate(std::size_t k);

  std::vector<Block> blocks_;
  std::vector<std::size_t> diagonal_;
  std::vector<double> before_;  // the numbers on the diagonal
  std::vector<std::vector<Entry>> columns_;
  std::vector<std::vector<std::size_t>>
      updated_;  // per column k: index of block (i, j), for all entries i, then j
};

}  // namespace careen
