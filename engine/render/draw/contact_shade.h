#pragma once

#include <span>
#include <vector>

#include "render/draw/box_batch.h"
#include "render/look/surfaces.h"

namespace careen {

/// A soft dark spot on a surface, where a box near it keeps off what comes from all around.
struct ContactShade {
  Vec3 centre = Vec3::Zero();  ///< [m] a little off the surface
  Vec3 first = Vec3::Zero();   ///< [m] half an axis of the spot, one standard deviation long
  Vec3 second = Vec3::Zero();  ///< [m] the other, at right angles
  double strength = 0;         ///< [1] of the light taken in the middle
};

/// Reach of a spot in standard deviations.
inline constexpr double kShadeReach = 3;

/// One for each marked box and surface that are near each other: the box's outline on the surface, taken for
/// the ellipse of the same moments, widened and weakened with the distance [m] of its lowest corner. Nothing
/// in it depends on other boxes or on the eye, so it stays put. `strength` is that of a box which touches.
std::vector<ContactShade> contactShades(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces,
                                        double strength);

/// All spots of a frame, drawn at once onto the surfaces there are; alpha stays.
class ContactShadeBatch {
 public:
  ContactShadeBatch(const Gl& gl, const std::filesystem::path& shaders);

  void place(std::span<const ContactShade> shades, const Vec3& eye);
  void draw() const;

 private:
  const Gl& gl_;
  unsigned array_;
  VertexBuffer corners_;
  VertexBuffer instances_;
  unsigned program_;
};

}  // namespace careen
