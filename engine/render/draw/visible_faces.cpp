#include "render/draw/visible_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace careen {
namespace {

constexpr float kRounding = 1e-4F;   // [1] of a depth buffer's depths
constexpr int kTile = 8;             // [px]
constexpr double kTileMargin = 0.5;  // [1] of a tile, around an outline
constexpr double kLeastArea = 1e-3;  // [px^2] of a face whose depth is known well enough

// A face in the picture: the pixels where a x + b y + c >= 0 for all its edges, and the inverse of the depth,
// which is linear there.
struct Flat {
  bool isKnown = false;  // else it may be anywhere, and hides nothing
  std::array<Vec3, 4> edges;
  Vec3 nearness = Vec3::Zero();
  Vec2 least = Vec2::Zero();
  Vec2 most = Vec2::Zero();
};

Flat flatOf(const DrawnFace& face, const View& view, const PixelSamples& samples) {
  Flat flat;
  std::array<Vec3, 4> corners;  // x, y [px], inverse depth
  constexpr std::array<std::array<int, 2>, 4> kSigns = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec4 clip =
        view.clipFromWorld(face.centre + kSigns.at(i)[0] * face.across + kSigns.at(i)[1] * face.along);
    if (clip.w() <= 0 || clip.z() < -clip.w()) {
      return flat;
    }
    corners.at(i) = Vec3((0.5 + 0.5 * clip.x() / clip.w()) * samples.width,
                         (0.5 + 0.5 * clip.y() / clip.w()) * samples.height, 1 / clip.w());
    const Vec2 at = corners.at(i).head<2>();
    flat.least = i == 0 ? at : Vec2(flat.least.cwiseMin(at));
    flat.most = i == 0 ? at : Vec2(flat.most.cwiseMax(at));
  }
  const Vec3 plane = (corners[1] - corners[0]).cross(corners[3] - corners[0]);
  if (std::abs(plane.z()) < kLeastArea) {
    return flat;
  }
  flat.isKnown = true;
  flat.nearness = Vec3(-plane.x() / plane.z(), -plane.y() / plane.z(), plane.dot(corners[0]) / plane.z());
  const double turn = plane.z() > 0 ? 1 : -1;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = corners.at(i);
    const Vec3 along = turn * (corners.at((i + 1) % 4) - from);
    flat.edges.at(i) = Vec3(-along.y(), along.x(), along.y() * from.x() - along.x() * from.y());
  }
  return flat;
}

// Calls with each row of a face, `margin` [px] less of it, and the pixels from first to end there, until that
// says to stop.
template <class Do>
void forRows(const Flat& flat, double margin, const PixelSamples& samples, const Do& doWith) {
  const auto clampTo = [](double x, int end) { return static_cast<int>(std::clamp<double>(x, 0, end)); };
  const double beyond = std::max(-margin, 0.0);
  const int low = clampTo(std::ceil(flat.least.y() - beyond - 0.5), samples.height);
  const int high = clampTo(std::floor(flat.most.y() + beyond - 0.5) + 1, samples.height);
  for (int row = low; row < high; ++row) {
    const double y = row + 0.5;
    double from = flat.least.x() - beyond;
    double to = flat.most.x() + beyond;
    for (const Vec3& edge : flat.edges) {
      const double rest = edge.y() * y + edge.z() - margin * (std::abs(edge.x()) + std::abs(edge.y()));
      if (edge.x() > 0) {
        from = std::max(from, -rest / edge.x());
      } else if (edge.x() < 0) {
        to = std::min(to, -rest / edge.x());
      } else if (rest < 0) {
        to = from - 1;
      }
    }
    const int first = clampTo(std::ceil(from - 0.5), samples.width);
    const int end = clampTo(std::floor(to - 0.5) + 1, samples.width);
    if (first < end && !doWith(row, first, end)) {
      return;
    }
  }
}

}  // namespace

HiddenTiles::HiddenTiles(View view, const PixelSamples& samples, const std::vector<float>& nearest)
    : view_(std::move(view)),
      columns_((samples.width + kTile - 1) / kTile),
      rows_((samples.height + kTile - 1) / kTile),
      width_(samples.width),
      height_(samples.height),
      farthest_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                std::numeric_limits<float>::infinity()) {
  std::vector<float> strip(static_cast<std::size_t>(width_));  // the farthest of a row of tiles' columns
  for (int row = 0; row < rows_; ++row) {
    std::fill(strip.begin(), strip.end(), std::numeric_limits<float>::infinity());
    for (int y = row * kTile; y < std::min((row + 1) * kTile, height_); ++y) {
      const float* const pixels =
          nearest.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
      for (std::size_t x = 0; x < strip.size(); ++x) {
        const float here = pixels[x];
        const float there = strip[x];
        strip[x] = here < there ? here : there;
      }
    }
    float* const tiles =
        farthest_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    for (int x = 0; x < width_; ++x) {
      tiles[x / kTile] = std::min(tiles[x / kTile], strip[static_cast<std::size_t>(x)]);
    }
  }
}

bool HiddenTiles::hide(const std::vector<Vec3>& outline) const {
  if (farthest_.empty()) {
    return false;
  }
  std::vector<Vec3> corners;  // [tiles] from the lower left, inverse depth
  for (const Vec3& point : outline) {
    const Vec4 clip = view_.clipFromWorld(point);
    if (clip.w() <= 0 || clip.z() < -clip.w()) {
      return false;
    }
    corners.emplace_back((0.5 + 0.5 * clip.x() / clip.w()) * width_ / kTile,
                         (0.5 + 0.5 * clip.y() / clip.w()) * height_ / kTile, 1 / clip.w());
  }
  // The largest of the triangles at a corner knows best how the inverse depth falls.
  Vec3 plane = Vec3::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 other = (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    plane = std::abs(other.z()) > std::abs(plane.z()) ? other : plane;
  }
  if (std::abs(plane.z()) < kLeastArea) {
    return false;
  }
  const Vec3 nearness(-plane.x() / plane.z(), -plane.y() / plane.z(), plane.dot(corners[0]) / plane.z());
  double low = corners[0].y();
  double high = low;
  double most = corners[0].z();
  for (const Vec3& corner : corners) {
    low = std::min(low, corner.y());
    high = std::max(high, corner.y());
    most = std::max(most, corner.z());
  }
  const int last = static_cast<int>(std::clamp<double>(std::floor(high + kTileMargin), -1, rows_ - 1));
  for (int row = static_cast<int>(std::clamp<double>(std::floor(low - kTileMargin), 0, rows_)); row <= last;
       ++row) {
    double from = columns_;
    double to = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3& a = corners[i];
      const Vec3& b = corners[(i + 1) % corners.size()];
      const double bottom = std::max(std::min(a.y(), b.y()), row - kTileMargin);
      const double top = std::min(std::max(a.y(), b.y()), row + 1 + kTileMargin);
      if (bottom > top) {
        continue;
      }
      const double slope = b.y() == a.y() ? 0 : (b.x() - a.x()) / (b.y() - a.y());
      for (const double x :
           {b.y() == a.y() ? b.x() : a.x() + (bottom - a.y()) * slope, a.x() + (top - a.y()) * slope}) {
        from = std::min(from, x);
        to = std::max(to, x);
      }
    }
    const int end = static_cast<int>(std::clamp<double>(std::floor(to + kTileMargin) + 1, 0, columns_));
    for (int column = static_cast<int>(std::clamp<double>(std::floor(from - kTileMargin), 0, columns_));
         column < end; ++column) {
      const double here =
          nearness.dot(Vec3(column + (nearness.x() > 0 ? 1 : 0), row + (nearness.y() > 0 ? 1 : 0), 1));
      if (std::min(here, most) >=
          (1 - kRounding) * static_cast<double>(
                                farthest_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                          static_cast<std::size_t>(column)])) {
        return false;
      }
    }
  }
  return true;
}

Visible visibleFaces(std::span<const DrawnFace> faces, const View& view, const PixelSamples& samples) {
  std::vector<Flat> flats;
  flats.reserve(faces.size());
  for (const DrawnFace& face : faces) {
    flats.push_back(flatOf(face, view, samples));
  }
  const auto width = static_cast<std::size_t>(samples.width);
  std::vector<float> nearest(width * static_cast<std::size_t>(samples.height));
  const auto slack = [&](const Flat& flat) {
    return samples.within * (std::abs(flat.nearness.x()) + std::abs(flat.nearness.y()));
  };
  const auto at = [](const Flat& flat, int row, int column) {
    return flat.nearness.dot(Vec3(column + 0.5, row + 0.5, 1));
  };
  // Faces that nearer ones hide write nothing that counts, so most are only looked for.
  const auto isSeen = [&](const Flat& flat) {
    bool seen = !flat.isKnown;
    if (flat.isKnown) {
      forRows(flat, -samples.within, samples, [&](int row, int first, int end) {
        const float* const pixels = nearest.data() + static_cast<std::size_t>(row) * width + first;
        const auto step = static_cast<float>(flat.nearness.x());
        const auto start = static_cast<float>((1 + kRounding) * (at(flat, row, first) + slack(flat)));
        int inFront = 0;  // no early end of the loop, so that it takes several pixels at once
        for (int i = 0; i < end - first; ++i) {
          inFront += start + static_cast<float>(i) * step >= (1 - kRounding) * pixels[i] ? 1 : 0;
        }
        seen = inFront > 0;
        return !seen;
      });
    }
    return seen;
  };
  std::vector<std::size_t> candidates;
  for (std::size_t index = 0; index < faces.size(); ++index) {
    const Flat& flat = flats[index];
    if (!isSeen(flat)) {
      continue;
    }
    candidates.push_back(index);
    if (flat.isKnown) {
      forRows(flat, samples.within, samples, [&](int row, int first, int end) {
        float* const pixels = nearest.data() + static_cast<std::size_t>(row) * width + first;
        const auto step = static_cast<float>(flat.nearness.x());
        const auto start = static_cast<float>(at(flat, row, first) - slack(flat));
        for (int i = 0; i < end - first; ++i) {
          const float here = start + static_cast<float>(i) * step;
          const float there = pixels[i];
          pixels[i] = here > there ? here : there;
        }
        return true;
      });
    }
  }
  Visible visible{.faces = {}, .hidden = HiddenTiles(view, samples, nearest)};
  for (const std::size_t i : candidates) {
    if (isSeen(flats[i])) {
      visible.faces.push_back(faces[i]);
    }
  }
  return visible;
}

}  // namespace careen
