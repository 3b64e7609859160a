#include "compare/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace careen {
namespace {

constexpr int kMostReach = 5;  // [px] of the window, either way
constexpr float kC1 = 0.01F * 255 * 0.01F * 255;
constexpr float kC2 = 0.03F * 255 * 0.03F * 255;
// Variances do not depend on an offset, and squares of smaller numbers have smaller rounding errors.
constexpr float kOffset = 128;

/// One side of the window's weights along one direction: [0] at the centre, [reach] at the end.
struct Window {
  explicit Window(int size) : reach(std::min(kMostReach, (size - 1) / 2)) {
    double sum = 0;
    std::array<double, kMostReach + 1> exact{};
    for (int i = 0; i <= reach; ++i) {
      exact.at(static_cast<std::size_t>(i)) = std::exp(-i * i / (2 * 1.5 * 1.5));
      sum += (i == 0 ? 1 : 2) * exact.at(static_cast<std::size_t>(i));
    }
    std::transform(exact.begin(), exact.end(), weights.begin(),
                   [sum](double weight) { return static_cast<float>(weight / sum); });
  }
  int reach;
  std::array<float, kMostReach + 1> weights{};
};

/// A range of columns of window centres, excluding `end`.
struct Range {
  int begin;
  int end;
};

/// The rows of the windows at hand.
class Rows {
 public:
  Rows(int width, int windowHeight, const RowReader& read)
      : width_(static_cast<std::size_t>(width)), held_(windowHeight), read_(read) {
    one_.resize(width_ * static_cast<std::size_t>(held_));
    other_.resize(one_.size());
  }
  /// Takes the place of the row that is a window's height above it.
  void read(int y) { read_(y, rowOf(one_, y), rowOf(other_, y)); }
  std::span<const float> one(int y) { return rowOf(one_, y); }
  std::span<const float> other(int y) { return rowOf(other_, y); }

 private:
  std::span<float> rowOf(std::vector<float>& values, int y) const {
    return std::span(values).subspan(static_cast<std::size_t>(y % held_) * width_, width_);
  }

  std::size_t width_;
  int held_;
  const RowReader& read_;
  std::vector<float> one_;
  std::vector<float> other_;
};

/// Finds the windows that contain a difference; all others have an SSIM of exactly 1.
class Differing {
 public:
  Differing(Rows& rows, int width) : rows_(rows), counts_(static_cast<std::size_t>(width)) {}

  /// Adds or removes a row of the next windows.
  void enter(int y) {
    rows_.read(y);
    count(y, 1);
  }
  void leave(int y) { count(y, -1); }

  const std::vector<Range>& ranges(int reach) {
    ranges_.clear();
    const int width = static_cast<int>(counts_.size());
    for (int x = 0; x < width; ++x) {
      if (counts_[static_cast<std::size_t>(x)] == 0) {
        continue;
      }
      const Range around{std::max(x - reach, reach), std::min(x + reach + 1, width - reach)};
      if (!ranges_.empty() && around.begin <= ranges_.back().end) {
        ranges_.back().end = around.end;
      } else {
        ranges_.push_back(around);
      }
    }
    return ranges_;
  }

 private:
  void count(int y, int by) {
    const std::span<const float> one = rows_.one(y);
    const std::span<const float> other = rows_.other(y);
    for (std::size_t x = 0; x < one.size(); ++x) {
      counts_[x] += one[x] != other[x] ? by : 0;
    }
  }

  Rows& rows_;
  std::vector<int> counts_;  ///< per column: number of differing rows in the windows
  std::vector<Range> ranges_;
};

/// Weighted sums over the height of a window: of each plane, of both squared, of the product. There is
/// padding on both sides, for windows whose outer weights are zero.
struct Sums {
  explicit Sums(std::size_t width)
      : one(width + std::size_t{2} * kMostReach),
        other(one.size()),
        squares(one.size()),
        product(one.size()) {}
  void clear(Range range) {
    for (std::vector<float>* sum : {&one, &other, &squares, &product}) {
      std::fill(sum->begin() + range.begin, sum->begin() + range.end + std::ptrdiff_t{2} * kMostReach, 0.0F);
    }
  }
  std::vector<float> one, other, squares, product;
};

void addRow(Sums& sums, std::span<const float> one, std::span<const float> other, float weight, Range range) {
  float* const sumOne = sums.one.data() + kMostReach;
  float* const sumOther = sums.other.data() + kMostReach;
  float* const sumSquares = sums.squares.data() + kMostReach;
  float* const sumProduct = sums.product.data() + kMostReach;
  for (int x = range.begin; x < range.end; ++x) {
    const float a = one[static_cast<std::size_t>(x)] - kOffset;
    const float b = other[static_cast<std::size_t>(x)] - kOffset;
    sumOne[x] += weight * a;
    sumOther[x] += weight * b;
    sumSquares[x] += weight * (a * a + b * b);
    sumProduct[x] += weight * (a * b);
  }
}

// Equal planes make the squares exactly twice the product, and the numerator exactly the denominator.
void similarities(const Sums& sums, const Window& window, Range range, float* result) {
  const auto across = [&window](const float* column) {
    float sum = window.weights[0] * column[0];
    for (int i = 1; i <= kMostReach; ++i) {
      sum += window.weights[static_cast<std::size_t>(i)] * (column[-i] + column[i]);
    }
    return sum;
  };
  for (int x = range.begin; x < range.end; ++x) {
    const float a = across(sums.one.data() + kMostReach + x);
    const float b = across(sums.other.data() + kMostReach + x);
    const float squares = across(sums.squares.data() + kMostReach + x) - (a * a + b * b);
    const float product = across(sums.product.data() + kMostReach + x) - a * b;
    const float meanA = a + kOffset;
    const float meanB = b + kOffset;
    const float above = (2 * (meanA * meanB) + kC1) * (2 * product + kC2);
    const float below = (meanA * meanA + meanB * meanB + kC1) * (squares + kC2);
    result[x] = above / below;
  }
}

// Of all windows' centres, how many count.
double countedWindows(int width, int height, int wide, int high, const PixelMask& ignored) {
  std::size_t count =
      static_cast<std::size_t>(width - 2 * wide) * static_cast<std::size_t>(height - 2 * high);
  for (int y = high; !ignored.empty() && y < height - high; ++y) {
    for (int x = wide; x < width - wide; ++x) {
      count -= ignored.at(x, y) ? 1 : 0;
    }
  }
  return static_cast<double>(count);
}

}  // namespace

StructuralSimilarity similarityOf(int width, int height, const RowReader& read, const PixelMask& ignored) {
  const Window wide(width);
  const Window high(height);
  Rows rows(width, 2 * high.reach + 1, read);
  Differing differing(rows, width);
  for (int y = 0; y < 2 * high.reach; ++y) {
    differing.enter(y);
  }
  Sums sums(static_cast<std::size_t>(width));
  std::vector<float> result(static_cast<std::size_t>(width));
  StructuralSimilarity similarity;
  double missing = 0;  // sum of 1 - SSIM over all windows
  for (int y = high.reach; y < height - high.reach; ++y) {
    differing.enter(y + high.reach);
    for (const Range& range : differing.ranges(wide.reach)) {
      const Range columns{range.begin - wide.reach, range.end + wide.reach};
      sums.clear(range);
      for (int i = -high.reach; i <= high.reach; ++i) {
        addRow(sums, rows.one(y + i), rows.other(y + i), high.weights[static_cast<std::size_t>(std::abs(i))],
               columns);
      }
      similarities(sums, wide, range, result.data());
      for (int x = range.begin; x < range.end; ++x) {
        if (ignored.at(x, y)) {
          continue;
        }
        const auto value = static_cast<double>(result[static_cast<std::size_t>(x)]);
        missing += 1 - value;
        if (value < similarity.worst) {
          similarity.worst = value;
          similarity.worstX = x;
          similarity.worstY = y;
        }
      }
    }
    differing.leave(y - high.reach);
  }
  const double windows = countedWindows(width, height, wide.reach, high.reach, ignored);
  similarity.mean = windows > 0 ? 1 - missing / windows : 1;
  return similarity;
}

}  // namespace careen
