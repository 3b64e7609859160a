#include "render/draw/shadow_pairs.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "render/draw/kept_lists.h"

namespace careen {
namespace {

// [1] of a caster's size: how far it must be in front of a face to count, and to count fully. Boxes that
// stand flush must not come and go with rounding.
constexpr double kFlushCaster = 1e-3;
constexpr double kCasterInFront = 1e-2;

double smoothRise(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// How much of a caster is in front of a face.
double weightOf(const DrawnBox& caster, const DrawnFace& face) {
  const Vec3 axes = caster.pose.worldFromBody.transpose() * face.normal;
  const double front =
      face.normal.dot(caster.pose.position - face.centre) + axes.cwiseAbs().dot(caster.halfExtents);
  const double size = caster.halfExtents.minCoeff();
  return smoothRise(kFlushCaster * size, kCasterInFront * size, front);
}

// Whether the corners of a face, seen along the light, are all on the far side of a slab.
bool isApart(const Zonogon& zonogon, const std::array<Vec3, 4>& corners, double margin) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    double low = 0;
    double high = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const double at = zonogon.slabs.row(k).dot(corners.at(c) - zonogon.centre);
      low = c == 0 ? at : std::min(low, at);
      high = c == 0 ? at : std::max(high, at);
    }
    if (low > zonogon.half[k] + margin || high < -zonogon.half[k] - margin) {
      return true;
    }
  }
  return false;
}

// Whether an edge of the face, seen along the light, has the whole box on its other side.
bool isBeside(const DrawnBox& box, const DrawnFace& face, const Vec3& towards, double margin) {
  const Vec3 to = box.pose.position - face.centre;
  for (const auto& [edge, other] : {std::pair(face.across, face.along), std::pair(face.along, face.across)}) {
    const Vec3 normal = edge.cross(towards);
    const double reach = (box.pose.worldFromBody.transpose() * normal).cwiseAbs().dot(box.halfExtents);
    if (std::abs(normal.dot(to)) > std::abs(normal.dot(other)) + reach + margin * normal.norm()) {
      return true;
    }
  }
  return false;
}

constexpr double kSoftPixels = 1.5;  // [px] that an edge is wide at least
constexpr double kSampleWidth = 8;   // [px] between points of a face at which shadows are looked at
constexpr int kMostSamples = 16;     // in each direction
constexpr float kEnough = 0.995F;    // [1] of the light: kept off by so much, others keep off nothing

// Points of a face, and how much light keeps off them what was taken so far. Where many boxes lie above each
// other, a few of them suffice.
class FaceSamples {
 public:
  FaceSamples(const DrawnFace& face, double pixel) : corner_(face.centre - face.across - face.along) {
    const auto points = [&](const Vec3& half) {
      return std::clamp(static_cast<int>(2 * half.norm() / (kSampleWidth * pixel)) + 2, 4, kMostSamples);
    };
    const int columns = points(face.across);
    const int rows = points(face.along);
    across_ = 2.0 / (columns - 1) * face.across;
    along_ = 2.0 / (rows - 1) * face.along;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        columns_.push_back(static_cast<float>(column));
        rows_.push_back(static_cast<float>(row));
      }
    }
    sums_.resize(columns_.size());
  }

  // What a box covers, as in shadow.frag, with a somewhat wider penumbra; `pixel` [m]. The mean.
  double cover(const Zonogon& zonogon, double weight, double spread, double pixel,
               std::vector<float>& parts) const {
    const Vec3 from = corner_ - zonogon.centre;
    const Lines slabs(zonogon.slabs * from, zonogon.slabs * across_, zonogon.slabs * along_);
    const Lines passing(zonogon.passing * from, zonogon.passing * across_, zonogon.passing * along_);
    const std::array<float, 3> half = floats(zonogon.half);
    const std::array<float, 3> through = floats(zonogon.halfPassing);
    const auto slope = static_cast<float>(spread);
    const auto least = static_cast<float>(0.5 * pixel + 1e-30);
    const auto most = static_cast<float>(weight);
    parts.resize(sums_.size());
    const float* const columns = columns_.data();
    const float* const rows = rows_.data();
    float* const out = parts.data();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto on = [&](const Lines& lines, std::size_t k) {
        return lines.start[k] + columns[i] * lines.across[k] + rows[i] * lines.along[k];
      };
      const float p = on(passing, 0);
      const float q = on(passing, 1);
      const float r = on(passing, 2);
      const float first = larger(p - through[0], larger(q - through[1], r - through[2]));
      const float last = smaller(p + through[0], smaller(q + through[1], r + through[2]));
      const float scale = 0.5F / (slope * larger(0.5F * (first + last), 0.0F) + least);
      const float inside = within(on(slabs, 0), half[0], scale) * within(on(slabs, 1), half[1], scale) *
                           within(on(slabs, 2), half[2], scale);
      const float part = most * inside;
      out[i] = last > 0 ? part : 0.0F;
    }
    return std::accumulate(parts.begin(), parts.end(), 0.0F) / static_cast<float>(parts.size());
  }

  // Whether more light is kept off where these parts are; between the points nobody knows.
  bool isNeeded(const std::vector<float>& parts) const {
    bool any = false;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      any = any || parts[i] > 0;
      if (parts[i] > 0 && sums_[i] < kEnough) {
        return true;
      }
    }
    return !any;
  }
  void take(const std::vector<float>& parts) {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      sums_[i] += parts[i];
    }
  }
  bool areDark() const {
    return std::all_of(sums_.begin(), sums_.end(), [](float sum) { return sum >= kEnough; });
  }

 private:
  static std::array<float, 3> floats(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }
  // Three coordinates, each linear on the face.
  struct Lines {
    Lines(const Vec3& atStart, const Vec3& perColumn, const Vec3& perRow)
        : start(floats(atStart)), across(floats(perColumn)), along(floats(perRow)) {}
    std::array<float, 3> start;
    std::array<float, 3> across;
    std::array<float, 3> along;
  };
  // By value, so that loops take several numbers at once.
  static float larger(float x, float y) { return x > y ? x : y; }
  static float smaller(float x, float y) { return x < y ? x : y; }
  static float step(float at) {
    const float t = smaller(larger(0.5F + at, 0.0F), 1.0F);
    return t * t * (3 - 2 * t);
  }
  static float within(float x, float half, float scale) {
    return step((half - x) * scale) + step((half + x) * scale) - 1;
  }

  Vec3 corner_;
  Vec3 across_;
  Vec3 along_;
  std::vector<float> columns_;  // of each point
  std::vector<float> rows_;
  std::vector<float> sums_;
};

struct Caster {
  std::size_t box = 0;
  double weight = 1;
  double covers = 0;
  std::vector<float> parts;  // of each sample
};

// Appends the casters that a face needs; whether it has no light at all, and needs none.
bool appendNeeded(std::span<Caster> casters, std::size_t face, FaceSamples& samples,
                  std::vector<ShadowPair>& pairs) {
  std::vector<const Caster*> order;
  for (const Caster& caster : casters) {
    order.push_back(&caster);
  }
  std::sort(order.begin(), order.end(), [](const Caster* a, const Caster* b) {
    return a->covers != b->covers ? a->covers > b->covers : a->box < b->box;
  });
  const std::size_t first = pairs.size();
  for (const Caster* const caster : order) {
    if (samples.isNeeded(caster->parts)) {
      pairs.push_back({.face = face, .caster = caster->box, .weight = caster->weight});
      samples.take(caster->parts);
    }
  }
  if (!samples.areDark()) {
    return false;
  }
  pairs.resize(first);
  return true;
}

// [m] Of so many boxes, to the light.
double nearestTo(const LightPlane& light, std::size_t boxes) {
  double nearest = boxes == 0 ? 0 : light.bounds(0).max.z();
  for (std::size_t i = 1; i < boxes; ++i) {
    nearest = std::max(nearest, light.bounds(i).max.z());
  }
  return nearest;
}

// Shadows on faces that none of the boxes that have changed lies over, neither as it was nor as it is.
struct KeptShadows {
  KeptShadows(const KeptLists& lists, const Vec3& towards)
      : kept(lists), changed(towards, lists.changed()), nearest(nearestTo(changed, lists.changed().size())) {}

  // Appends the face's pairs; whether it is dark.
  bool append(std::size_t face, std::vector<ShadowPair>& pairs) const {
    const FaceShadows& before = kept.shadowsBefore();
    const std::size_t was = *kept.before(face);
    auto pair = std::lower_bound(before.pairs.begin(), before.pairs.end(), was,
                                 [](const ShadowPair& each, std::size_t of) { return each.face < of; });
    for (; pair != before.pairs.end() && pair->face == was; ++pair) {
      pairs.push_back({.face = face, .caster = kept.boxNow(pair->caster), .weight = pair->weight});
    }
    return before.isDark[was];
  }

  const KeptLists& kept;
  LightPlane changed;
  double nearest;
};

}  // namespace

FaceShadows shadowsOnFaces(LightPlane& light, std::span<const DrawnBox> boxes,
                           std::span<const DrawnFace> faces, const Vec3& eye, double spread,
                           double pixelAngle, const KeptLists* kept) {
  FaceShadows shadows;
  shadows.isDark.resize(faces.size());
  std::vector<Zonogon> zonogons;
  zonogons.reserve(boxes.size());
  for (const DrawnBox& box : boxes) {
    zonogons.push_back(zonogonOf(box, light.towards()));
  }
  const double nearest = nearestTo(light, boxes.size());
  std::optional<KeptShadows> keeping;
  if (kept != nullptr && !kept->isEmpty()) {
    keeping.emplace(*kept, light.towards());
  }
  std::vector<std::size_t> found;
  std::vector<Caster> casters;
  for (std::size_t index = 0; index < faces.size(); ++index) {
    const DrawnFace& face = faces[index];
    if (face.normal.dot(light.towards()) <= 0) {
      shadows.isDark[index] = true;
      continue;
    }
    const std::array<Vec3, 4> corners = outlineOf(face);
    Vec3 least = light.seen(corners[0]);
    Vec3 most = least;
    for (const Vec3& corner : corners) {
      least = least.cwiseMin(light.seen(corner));
      most = most.cwiseMax(light.seen(corner));
    }
    const double pixel = kSoftPixels * pixelAngle * (face.centre - eye).norm();
    const auto gather = [&](LightPlane& from, double highest) {
      const double soft = spread * std::max(0.0, highest - least.z()) + pixel;
      from.gather(least - Vec3(soft, soft, 0), most + Vec3(soft, soft, 0), found);
    };
    if (keeping && kept->before(index)) {
      gather(keeping->changed, keeping->nearest);
      if (found.empty()) {
        shadows.isDark[index] = keeping->append(index, shadows.pairs);
        continue;
      }
    }
    gather(light, nearest);
    FaceSamples samples(face, pixel / kSoftPixels);
    std::size_t count = 0;
    for (const std::size_t box : found) {
      if (box == face.box) {
        continue;
      }
      const double margin = spread * std::max(0.0, light.bounds(box).max.z() - least.z()) + pixel;
      const double weight = weightOf(boxes[box], face);
      if (weight == 0 || isApart(zonogons[box], corners, margin) ||
          isBeside(boxes[box], face, light.towards(), margin)) {
        continue;
      }
      if (count == casters.size()) {
        casters.emplace_back();
      }
      Caster& caster = casters[count++];
      caster.box = box;
      caster.weight = weight;
      caster.covers = samples.cover(zonogons[box], weight, spread, pixel / kSoftPixels, caster.parts);
    }
    shadows.isDark[index] = appendNeeded(std::span(casters).first(count), index, samples, shadows.pairs);
  }
  return shadows;
}

}  // namespace careen
