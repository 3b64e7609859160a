#pragma once

#include <algorithm>
#include <array>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/geometry/box_at.h"

namespace careen {

// All tolerances of gaps and contacts. All are relative to lengths and speeds of the pair: a scene with
// lengths times 4 and times times 2 gives the same bits; none is an absolute length.

/// [1] Rounding of a computed gap, relative to the lengths that enter it (positions, flight path, half
/// diagonals): 8 × the unit roundoff of a double per sum of about ten terms. A gap below this is contact.
inline constexpr double kGapRounding = 0x1p-49;
/// [1] Rounding of the rate of a gap, relative to the speeds that enter it. Eight times the gap's, because
/// the rate after an impact comes from the impact's own solve. Slower than this is not approaching.
inline constexpr double kRateRounding = 0x1p-46;
/// [1] Contacts whose gap exceeds the smallest by less than this times the half diagonal of the smaller box
/// are simultaneous: 5e-13. Chosen between noise (the corners of a box that falls flat stay level to rounding
/// while it rotates about the vertical) and what a scene's initial state can mean: a tilt of 1e-12 is one.
inline constexpr double kSimultaneous = 0x1p-41;

/// [m] Contact tolerance at one time: `radius` is the half diagonal of the smaller box, `lengths` the
/// magnitudes whose difference is the gap.
inline double touchingWithin(double radius, double lengths) {
  return std::max(kSimultaneous * radius, kGapRounding * lengths);
}

/// Likewise for a box and a fixed body, and for two boxes.
double touchingWithin(const BoxAt& box);
double touchingWithin(const BoxAt& a, const BoxAt& b);

/// [m] Signed gap of one corner, given in the body's frame, to the half-space normal·x > offset.
double cornerGap(const Pose& box, const Vec3& corner, const Vec3& normal, double offset);

/// Corner k of a box is bit k of a set; corners as in corner().
using CornerSet = unsigned;

/// [m] Signed gap of a box to the half-space normal·x > offset: n·x − offset − Σ hᵢ|n·aᵢ|, where x is the
/// box's middle and aᵢ are the columns of worldFromBody. Negative: inside the wall.
double gapToPlane(const BoxAt& box, const Vec3& normal, double offset);

/// The same with the corners that attain it.
struct WallGap {
  double gap = 0;         ///< [m] of the lowest corner
  CornerSet corners = 0;  ///< corners at most `within` above the lowest
};
WallGap wallGap(const BoxAt& box, const Vec3& normal, double offset, double within);

/// [m] Separation of two boxes along a direction from b to a: of the farthest that b reaches along it to the
/// nearest that a does. Negative: they overlap along it.
double gapAlong(const BoxAt& a, const BoxAt& b, const Vec3& direction);

/// The 15 separating-axis candidates of two boxes: face normals of each and cross products of their edges
/// (Gottschalk, Lin, Manocha 1996). The boxes are disjoint exactly when one of them separates.
struct BoxAxis {
  enum class Kind { kFaceOfA, kFaceOfB, kEdges };
  static constexpr int kCount = 15;

  int index = 0;  ///< 0…2 faces of a, 3…5 faces of b, 6 + 3i + j: edge i of a with edge j of b

  Kind kind() const { return index < 3 ? Kind::kFaceOfA : index < 6 ? Kind::kFaceOfB : Kind::kEdges; }
  int edgeOfA() const { return (index - 6) / 3; }
  int edgeOfB() const { return (index - 6) % 3; }
};

/// Separations of two boxes along the 15 axes, each normalised: |u·Δ| − Σ hᵢ|u·aᵢ| − Σ kⱼ|u·bⱼ|, Δ from b's
/// centre to a's. Swapping a and b gives the same bits.
///
/// Nearly parallel edges: the cross product is formed error-free, so its direction is accurate to rounding
/// however short it is; below 2⁻⁴⁸ the axis is skipped, which can change the gap by 2⁻⁴⁸ of the edge at most.
class BoxAxes {
 public:
  BoxAxes(Mat3 worldFromA, Vec3 halfExtentsA, Mat3 worldFromB, Vec3 halfExtentsB, Vec3 bToA);
  BoxAxes(const BoxAt& a, const BoxAt& b)
      : BoxAxes(a.pose.worldFromBody, a.halfExtents, b.pose.worldFromBody, b.halfExtents,
                a.middle() - b.middle()) {}

  /// [m] Largest separation, and the first axis that attains it. Positive: a lower bound of the distance.
  /// Zero: touching. Negative: penetration depth along that axis.
  double gap() const { return separation_[index(best_)]; }
  BoxAxis best() const { return {best_}; }
  double separation(BoxAxis axis) const { return separation_[index(axis.index)]; }
  /// [1] unit, from b to a.
  Vec3 normal(BoxAxis axis) const;

  /// aᵢ × bⱼ, not normalised, and its length (the sine of the edges' angle).
  const Vec3& cross(int i, int j) const { return cross_[index(3 * i + j)]; }
  double sine(int i, int j) const { return sine_[index(3 * i + j)]; }
  /// aᵢ · bⱼ.
  double cosine(int i, int j) const { return cosines_(i, j); }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  void addEdges(int i, int j);

  Mat3 a_;
  Mat3 b_;
  Vec3 halfA_;
  Vec3 halfB_;
  Vec3 bToA_;
  Mat3 cosines_;
  std::array<Vec3, 9> cross_;
  std::array<double, 9> sine_;
  std::array<double, BoxAxis::kCount> separation_;
  int best_ = 0;
};

}  // namespace careen
