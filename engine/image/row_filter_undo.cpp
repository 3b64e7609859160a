#include "image/row_filter_undo.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace careen {
namespace {

constexpr int kPaeth = 4;

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

/// What Paeth's filter adds in each lane. Left a, above b, above the left one c; pa = |b - c|, pb = |a - c|,
/// pc = |a + b - 2c| as in the specification.
Lanes paethPrediction(Lanes a, Lanes b, Lanes c) {
  const Lanes fromLeft = b - c;
  const Lanes fromAbove = a - c;
  const Lanes pa = magnitude(fromLeft);
  const Lanes pb = magnitude(fromAbove);
  const Lanes pc = magnitude(fromLeft + fromAbove);
  const Lanes least = pa < pb ? pa : pb;
  return least < pc || least == pc ? (pa <= pb ? a : b) : c;
}

// A pixel waits for the one before it; its channels go side by side in the lanes of one register, in 16 bits.
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
    a = (__builtin_convertvector(values, Lanes) + paethPrediction(a, b, c)) & 0xff;
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

template <std::size_t kBytes>
std::uint32_t load(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, kBytes);
  return value;
}

// Two rows at once, the second a pixel behind: in half the time, for one row does not wait for the other.
template <std::size_t kPixel>
void undoPaeth(std::span<std::uint8_t> first, std::span<std::uint8_t> second,
               std::span<const std::uint8_t> above) {
  static_assert(kPixel <= 4);
  constexpr std::size_t kReadable = kPixel == 1 ? 1 : 4;  // before the last pixel of a row
  Lanes a{};
  Lanes c{};
  // In one register each way: memory would have to wait for two halves.
  const auto lanesOf = [](std::uint64_t ofFirst, std::uint64_t ofSecond) {
    return __builtin_convertvector(std::bit_cast<Bytes>(ofFirst | ofSecond << 32U), Lanes);
  };
  const auto advance = [&](std::uint32_t ofFirst, std::uint32_t aboveFirst, std::uint32_t ofSecond) {
    const Lanes b = __builtin_shufflevector(lanesOf(aboveFirst, 0), a, 0, 1, 2, 3, 8, 9, 10, 11);
    a = (lanesOf(ofFirst, ofSecond) + paethPrediction(a, b, c)) & 0xff;
    c = b;
    return std::bit_cast<std::uint64_t>(__builtin_convertvector(a, Bytes));
  };
  const auto store = [](std::uint64_t value, std::uint8_t* pixel) { std::memcpy(pixel, &value, kPixel); };
  const auto advanceBoth = [&](std::size_t i, auto loadFirst) {
    const std::uint64_t undone =
        advance(loadFirst(&first[i]), loadFirst(&above[i]), load<kReadable>(&second[i - kPixel]));
    store(undone, &first[i]);
    store(undone >> 32U, &second[i - kPixel]);
  };
  const std::size_t last = first.size() / kPixel * kPixel - kPixel;
  store(advance(load<kPixel>(first.data()), load<kPixel>(above.data()), 0), first.data());
  for (std::size_t i = kPixel; i < last; i += kPixel) {
    advanceBoth(i, load<kReadable>);
  }
  if (last > 0) {
    advanceBoth(last, load<kPixel>);
  }
  store(advance(0, 0, load<kPixel>(&second[last])) >> 32U, &second[last]);
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
    case kPaeth:
      undoPaeth<kPixel>(row, above);
      return true;
    default:
      return false;
  }
}

template <std::size_t kPixel>
std::optional<int> undoAll(std::span<std::uint8_t> rows, std::size_t rowBytes) {
  const std::vector<std::uint8_t> nothing(rowBytes);
  std::span<const std::uint8_t> above(nothing);
  const std::size_t stride = rowBytes + 1;
  for (; !rows.empty(); rows = rows.subspan(stride)) {
    const int type = rows[0];
    std::span<std::uint8_t> row = rows.subspan(1, rowBytes);
    if constexpr (kPixel <= 4) {
      if (type == kPaeth && rows.size() > stride && rows[stride] == kPaeth) {
        rows = rows.subspan(stride);
        const std::span<std::uint8_t> second = rows.subspan(1, rowBytes);
        undoPaeth<kPixel>(row, second, above);
        above = second;
        continue;
      }
    }
    if (!undo<kPixel>(type, row, above)) {
      return type;
    }
    above = row;
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> undoFilters(std::span<std::uint8_t> rows, std::size_t rowBytes, std::size_t pixel) {
  switch (pixel) {
    case 1:
      return undoAll<1>(rows, rowBytes);
    case 2:
      return undoAll<2>(rows, rowBytes);
    case 3:
      return undoAll<3>(rows, rowBytes);
    case 4:
      return undoAll<4>(rows, rowBytes);
    case 6:
      return undoAll<6>(rows, rowBytes);
    default:
      return undoAll<8>(rows, rowBytes);
  }
}

}  // namespace careen
