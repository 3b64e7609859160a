#include "image/row_filter_undo.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace careen {
namespace {

std::uint8_t byte(int value) { return static_cast<std::uint8_t>(value); }

// Nothing is above the first row's and left of every row's first pixel: zeros, which predict 0 for Sub, half
// of what is above for Average, and what is above for Paeth.
template <std::size_t kPixel>
void undoSub(std::span<std::uint8_t> row) {
  for (std::size_t i = kPixel; i < row.size(); ++i) {
    row[i] = byte(row[i] + row[i - kPixel]);
  }
}

void undoUp(std::span<std::uint8_t> row, std::span<const std::uint8_t> above) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    row[i] = byte(row[i] + above[i]);
  }
}

template <std::size_t kPixel>
void undoAverage(std::span<std::uint8_t> row, std::span<const std::uint8_t> above) {
  std::array<int, kPixel> left{};
  for (std::size_t i = 0; i + kPixel <= row.size(); i += kPixel) {
    for (std::size_t k = 0; k < kPixel; ++k) {
      left[k] = byte(row[i + k] + (left[k] + above[i + k]) / 2);
      row[i + k] = byte(left[k]);
    }
  }
}

using Bytes = std::uint8_t __attribute__((vector_size(8)));
using Lanes = std::int16_t __attribute__((vector_size(16)));

Lanes magnitude(Lanes value) {
  const Lanes opposite = -value;
  return value > opposite ? value : opposite;
}

// A pixel waits for the one before it; its channels go side by side in the lanes of one register, in 16 bits.
// Left a, above b, above the left one c; pa = |b - c|, pb = |a - c|, pc = |a + b - 2c| as in the
// specification.
template <std::size_t kPixel>
void undoPaeth(std::span<std::uint8_t> row, std::span<const std::uint8_t> above) {
  Lanes a{};
  Lanes c{};
  const auto advance = [&a, &c](std::uint8_t* pixel, const std::uint8_t* pixelAbove, std::size_t readable) {
    Bytes values{};
    Bytes valuesAbove{};
    std::memcpy(&values, pixel, readable);
    std::memcpy(&valuesAbove, pixelAbove, readable);
    const Lanes b = __builtin_convertvector(valuesAbove, Lanes);
    const Lanes fromLeft = b - c;
    const Lanes fromAbove = a - c;
    const Lanes pa = magnitude(fromLeft);
    const Lanes pb = magnitude(fromAbove);
    const Lanes pc = magnitude(fromLeft + fromAbove);
    const Lanes least = pa < pb ? pa : pb;
    const Lanes prediction = least < pc || least == pc ? (pa <= pb ? a : b) : c;
    a = (__builtin_convertvector(values, Lanes) + prediction) & 0xff;
    c = b;
    const Bytes undone = __builtin_convertvector(a, Bytes);
    std::memcpy(pixel, &undone, kPixel);
  };
  std::size_t i = 0;
  for (; i + sizeof(Bytes) <= row.size(); i += kPixel) {
    advance(row.data() + i, above.data() + i, sizeof(Bytes));
  }
  for (; i + kPixel <= row.size(); i += kPixel) {
    advance(row.data() + i, above.data() + i, kPixel);
  }
}

template <std::size_t kPixel>
bool undo(int type, std::span<std::uint8_t> row, std::span<const std::uint8_t> above) {
  switch (type) {
    case 0:
      return true;
    case 1:
      undoSub<kPixel>(row);
      return true;
    case 2:
      undoUp(row, above);
      return true;
    case 3:
      undoAverage<kPixel>(row, above);
      return true;
    case 4:
      undoPaeth<kPixel>(row, above);
      return true;
    default:
      return false;
  }
}

}  // namespace

bool undoFilter(int type, std::span<std::uint8_t> row, std::span<const std::uint8_t> above,
                std::size_t pixel) {
  switch (pixel) {
    case 1:
      return undo<1>(type, row, above);
    case 2:
      return undo<2>(type, row, above);
    case 3:
      return undo<3>(type, row, above);
    case 4:
      return undo<4>(type, row, above);
    case 6:
      return undo<6>(type, row, above);
    case 8:
      return undo<8>(type, row, above);
    default:
      return false;
  }
}

}  // namespace careen
