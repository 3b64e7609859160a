#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math/pose.h"
#include "stage/run_setup.h"
#include "view/materials.h"

namespace careen {

inline constexpr double kReturnedToBoxes = 1.5;  ///< boxes are lit from more sides than surfaces

/// One box to draw. Boxes of a run have marks on their faces; springs and boxes that are parts of a body have
/// none.
struct DrawnBox {
  Pose pose;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  Vec3 color = Vec3::Ones();        ///< linear
  bool marked = true;
  Vec3 returned = Vec3::Zero();        ///< [1] part of ambient light that comes back where it keeps light off
  std::size_t shown = 0;               ///< which of all boxes of bodies it shows, then which of springs
  std::size_t moment = 0;              ///< of several that are shown at once
  const TriangleMesh* mesh = nullptr;  ///< drawn in its place, if any; the stage owns it
};

/// The run's boxes, then its springs as thin rods of thickness `springThickness` [m] from end to end. With
/// poses of several consecutive moments: the same for each, without boxes that have not moved since the
/// previous one.
std::vector<DrawnBox> drawnBoxes(const World& world, const Stage& stage, std::span<const Pose> poses,
                                 double springThickness);

/// Makes springs as thick as 1.5 pixels at least, or there would be gaps; `pixelAngle` [rad].
void widenSprings(std::vector<DrawnBox>& boxes, const Vec3& eye, double pixelAngle);

/// Sets what comes back from boxes; the mean of what comes back from one to others.
double returnLight(std::vector<DrawnBox>& boxes, const Materials& materials);

/// Whether any is shown several times.
bool haveCopies(std::span<const DrawnBox> boxes);

/// Sorts later moments first, and those of one front to back, so that hidden pixels are not shaded, and the
/// order of a scene's boxes does not matter.
void sortFromEye(std::vector<DrawnBox>& boxes, const Vec3& eye);

/// A face turned to the eye.
struct DrawnFace {
  std::size_t box = 0;
  int side = 0;      ///< 0 … 5: +x, −x, +y, −y, +z, −z of the body
  double width = 0;  ///< [px] its smaller width in the picture, about
  Vec3 normal = Vec3::UnitZ();
  Vec3 centre = Vec3::Zero();  ///< [m] world
  Vec3 across = Vec3::Zero();  ///< [m] from the centre to the middle of an edge
  Vec3 along = Vec3::Zero();   ///< [m] likewise, perpendicular to it
};

/// Its corners, counterclockwise or clockwise.
inline std::array<Vec3, 4> outlineOf(const DrawnFace& face) {
  return {face.centre - face.across - face.along, face.centre + face.across - face.along,
          face.centre + face.across + face.along, face.centre - face.across + face.along};
}

/// [px] Faces thinner than this are lit more and more like the widest face of their box: a face thinner than
/// a pixel is a row of dots, which then do not stand out.
inline constexpr double kThinFace = 2;

/// The faces that the eye sees of boxes, box by box; `pixelAngle` [rad]. Normals of thin faces are those that
/// they are lit by.
std::vector<DrawnFace> facesTowards(std::span<const DrawnBox> boxes, const Vec3& eye, double pixelAngle);

/// A point as it is drawn: minus the eye, in single precision.
inline std::array<float, 3> offsetOf(const Vec3& point, const Vec3& eye) {
  const Vec3 offset = point - eye;
  return {static_cast<float>(offset.x()), static_cast<float>(offset.y()), static_cast<float>(offset.z())};
}

}  // namespace careen
