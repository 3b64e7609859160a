#pragma once

#include <algorithm>
#include <array>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"

namespace careen {

// Every tolerance of gaps and contacts stands here. All are relative to lengths and speeds of the pair at
// hand, so a scene with lengths times 4 and times times 2 runs through the same bits; none is an absolute
// length.

/// [1] Rounding of a computed gap, relative to the lengths that entered it (positions, flight path, half
/// diagonals): 8 × the unit roundoff of a double per sum of about ten terms. A gap below this is contact.
inline constexpr double kGapRounding = 0x1p-49;
/// [1] Rounding of the rate of a gap, relative to the speeds that entered it. Eight times looser than the
/// gap's, because the rate after an impact comes out of the impact's own solve. Slower than this is not
/// approaching.
inline constexpr double kRateRounding = 0x1p-46;
/// [1] Contacts whose gap exceeds the smallest by less than this times the half diagonal of the smaller box
/// happen at once: 5e-13. Chosen between the noise, as the corners of a box that falls flat stay level to
/// rounding while it turns about the vertical, and what the start of a scene can mean: a tilt of 1e-12 is
/// one.
inline constexpr double kSimultaneous = 0x1p-41;

/// [m] Gaps below this are contact, at one moment: `radius` is the half diagonal of the smaller box,
/// `lengths` what the gap is the difference of.
inline double touchingWithin(double radius, double lengths) {
  return std::max(kSimultaneous * radius, kGapRounding * lengths);
}

/// Likewise for a box and what does not move, and for two boxes.
double touchingWithin(const Pose& box, const Vec3& halfExtents);
double touchingWithin(const Pose& a, const Vec3& halfExtentsA, const Pose& b, const Vec3& halfExtentsB);

/// [m] Signed gap of one corner, given in the box's frame, to the half-space normal·x > offset.
double cornerGap(const Pose& box, const Vec3& corner, const Vec3& normal, double offset);

/// Corner k of a box is bit k of a set; corners as in corner().
using CornerSet = unsigned;

/// Signed gap of a box to the half-space normal·x > offset: n·x − Σ hᵢ|n·aᵢ| − offset, where aᵢ are the
/// columns of worldFromBody.
struct WallGap {
  double gap = 0;         ///< [m] of the lowest corner; negative: inside the wall
  CornerSet corners = 0;  ///< those not more than `within` above the lowest
};
WallGap wallGap(const Pose& box, const Vec3& halfExtents, const Vec3& normal, double offset, double within);

/// The 15 directions that can separate two boxes: the faces of each and the cross products of their edges
/// (Gottschalk, Lin, Manocha 1996). The boxes are disjoint exactly when one of them separates.
struct BoxAxis {
  enum class Kind { kFaceOfA, kFaceOfB, kEdges };
  static constexpr int kCount = 15;

  int index = 0;  ///< 0…2 faces of a, 3…5 faces of b, 6 + 3i + j edge i of a with edge j of b

  Kind kind() const { return index < 3 ? Kind::kFaceOfA : index < 6 ? Kind::kFaceOfB : Kind::kEdges; }
  int edgeOfA() const { return (index - 6) / 3; }
  int edgeOfB() const { return (index - 6) % 3; }
};

/// Separations of two boxes along the 15 directions, each taken with unit length:
/// |u·Δ| − Σ hᵢ|u·aᵢ| − Σ kⱼ|u·bⱼ|, Δ from b's centre to a's. The same bits when a and b change places.
///
/// Nearly parallel edges: the cross product is formed with an error-free product, so its direction is good to
/// rounding however short it is; below 2⁻⁴⁸ the direction is left out, which can lift the gap by 2⁻⁴⁸ of the
/// edge at most.
class BoxAxes {
 public:
  BoxAxes(Mat3 worldFromA, Vec3 halfExtentsA, Mat3 worldFromB, Vec3 halfExtentsB, Vec3 bToA);
  BoxAxes(const Pose& a, const Vec3& halfExtentsA, const Pose& b, const Vec3& halfExtentsB)
      : BoxAxes(a.worldFromBody, halfExtentsA, b.worldFromBody, halfExtentsB, a.position - b.position) {}

  /// [m] the largest separation and the first axis that has it. Positive: a lower bound of the distance.
  /// Zero: touching. Negative: how deep the boxes overlap along that axis.
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
