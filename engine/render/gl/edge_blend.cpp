#include "render/gl/edge_blend.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "image/srgb.h"

namespace careen {
namespace {

constexpr std::size_t kBytes = 4;

constexpr int kWhole = 2 * kEdgeSteps;  // distance to the next pixel

struct Crossing {
  int direction = 0;
  int at = 0;  // [1/kWhole] of the distance, middle of the step
};

std::optional<Crossing> crossingOf(std::uint8_t alpha) {
  if (alpha == 0 || alpha > 4 * kEdgeSteps) {
    return std::nullopt;
  }
  const int code = alpha - 1;
  return Crossing{.direction = code / kEdgeSteps, .at = 2 * (code % kEdgeSteps) + 1};
}

// Blends `other` into a pixel with weight `part` / (2 kWhole).
void blend(std::uint8_t* pixel, const std::uint8_t* other, int part) {
  const SrgbTables& tables = SrgbTables::get();
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const int mixed =
        (2 * kWhole - part) * tables.linear(pixel[channel]) + part * tables.linear(other[channel]);
    pixel[channel] = tables.encoded(static_cast<std::uint16_t>((mixed + kWhole) / (2 * kWhole)));
  }
}

class EdgeBlend {
 public:
  EdgeBlend(std::span<std::uint8_t> rgba, int width, int height, const PixelRectangle& within,
            std::span<const std::uint8_t> before)
      : rgba_(rgba), before_(before), width_(width), height_(height), within_(within) {}

  void at(int x, int y) {
    const std::size_t here = placeOf(x, y);
    const std::optional<Crossing> crossing = crossingOf(before_[here + 3]);
    if (!crossing) {
      return;
    }
    const auto d = static_cast<std::size_t>(crossing->direction);
    const int otherX = x + kRight.at(d);
    const int otherY = y + kUp.at(d);
    if (otherX < 0 || otherX >= width_ || otherY < 0 || otherY >= height_) {
      return;
    }
    const std::size_t there = placeOf(otherX, otherY);
    int edge = 2 * crossing->at;  // [1/(2 kWhole)]
    const std::optional<Crossing> back = crossingOf(before_[there + 3]);
    if (back && back->direction == crossing->direction && crossing->at == kWhole - 1 && back->at == 1) {
      return;  // the edge is just beyond the other pixel
    }
    if (back && back->direction == (crossing->direction ^ 1)) {
      if (there < here) {
        return;  // handled from the other pixel
      }
      edge = crossing->at + kWhole - back->at;  // the same edge, up to rounding
    }
    if (edge < kWhole ? isWithin(x, y) : isWithin(otherX, otherY)) {
      if (edge < kWhole) {
        blend(&rgba_[here], &before_[there], kWhole - edge);
      } else {
        blend(&rgba_[there], &before_[here], edge - kWhole);
      }
    }
  }

 private:
  static constexpr std::array<int, 4> kRight{1, -1, 0, 0};
  static constexpr std::array<int, 4> kUp{0, 0, 1, -1};

  bool isWithin(int x, int y) const {
    return x >= within_.left && x < within_.right && y >= within_.bottom && y < within_.top;
  }
  std::size_t placeOf(int x, int y) const {
    return kBytes *
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }

  std::span<std::uint8_t> rgba_;
  std::span<const std::uint8_t> before_;
  int width_;
  int height_;
  PixelRectangle within_;
};

}  // namespace

void blendEdges(std::span<const std::uint8_t> drawn, int width, int height, const PixelRectangle& within,
                std::span<std::uint8_t> blended) {
  const auto placeOf = [&](int x, int y) {
    return kBytes *
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  };
  for (int y = within.bottom; y < within.top; ++y) {
    const std::uint8_t* const row = &drawn[placeOf(within.left, y)];
    std::copy_n(row, placeOf(within.right - within.left, 0), &blended[placeOf(within.left, y)]);
  }
  EdgeBlend blend(blended, width, height, within, drawn);
  const int right = std::min(within.right + 1, width);  // pixels beside it blend into it, too
  const int top = std::min(within.top + 1, height);
  for (int y = std::max(within.bottom - 1, 0); y < top; ++y) {
    const std::uint8_t* const row = &drawn[placeOf(0, y)];
    for (int x = std::max(within.left - 1, 0); x < right; ++x) {
      if (row[kBytes * static_cast<std::size_t>(x) + 3] != kNoEdge) {
        blend.at(x, y);
      }
    }
  }
}

}  // namespace careen
