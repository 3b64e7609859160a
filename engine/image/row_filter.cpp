#include "image/row_filter.h"

#include <algorithm>
#include <cstddef>

namespace careen {
namespace {

// a is to the left, b above, c above a, as in the specification; with p = a + b - c the distances are pa = |p
// - a| = |b - c|, pb = |p - b| = |a - c| and pc = |p - c| = |(b - c) + (a - c)|. All arithmetic is in bytes,
// so that many fit a register: where b - c and a - c have the same sign, pc is only known to be no less than
// either, which is sufficient.
[[gnu::always_inline]] inline std::uint8_t paeth(std::uint8_t a, std::uint8_t b, std::uint8_t c) {
  const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
  const std::uint8_t bAbove = byte(std::max(b, c) - c);  // b - c if positive
  const std::uint8_t bBelow = byte(std::max(b, c) - b);  // c - b if positive
  const std::uint8_t aAbove = byte(std::max(a, c) - c);
  const std::uint8_t aBelow = byte(std::max(a, c) - a);
  const std::uint8_t pa = bAbove | bBelow;
  const std::uint8_t pb = aAbove | aBelow;
  const std::uint8_t sameSide = std::min(aAbove, bAbove) | std::min(aBelow, bBelow);
  const std::uint8_t nearer = std::min(pa, pb);
  const std::uint8_t pc = byte(std::max(pa, pb) - nearer + sameSide);
  const std::uint8_t leftOrAbove = pa == nearer ? a : b;
  return std::min(pc, nearer) == nearer ? leftOrAbove : c;
}

// Inlined into each caller, so that it uses the caller's instruction set.
[[gnu::always_inline]] inline void subtract(std::span<const std::uint8_t> row,
                                            std::span<const std::uint8_t> above, std::size_t pixelBytes,
                                            std::span<std::uint8_t> difference) {
  const std::size_t first = std::min(pixelBytes, row.size());
  for (std::size_t i = 0; i < first; ++i) {  // nothing to the left: the prediction is the byte above
    difference[i] = static_cast<std::uint8_t>(row[i] - above[i]);
  }
  for (std::size_t i = first; i < row.size(); ++i) {
    difference[i] =
        static_cast<std::uint8_t>(row[i] - paeth(row[i - pixelBytes], above[i], above[i - pixelBytes]));
  }
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void subtractByAvx2(std::span<const std::uint8_t> row,
                                            std::span<const std::uint8_t> above, std::size_t pixelBytes,
                                            std::span<std::uint8_t> difference) {
  subtract(row, above, pixelBytes, difference);
}
#endif

}  // namespace

void subtractPaeth(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                   std::size_t pixelBytes, std::span<std::uint8_t> difference) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") != 0) {
    subtractByAvx2(row, above, pixelBytes, difference);
    return;
  }
#endif
  subtract(row, above, pixelBytes, difference);
}

void subtractPaethBaseline(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                           std::size_t pixelBytes, std::span<std::uint8_t> difference) {
  subtract(row, above, pixelBytes, difference);
}

}  // namespace careen
