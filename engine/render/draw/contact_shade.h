#pragma once

#include <span>
#include <vector>

#include "render/draw/box_batch.h"
#include "view/surfaces.h"

namespace careen {

/// A soft dark spot on a surface where a nearby box blocks ambient light (ambient occlusion).
struct ContactShade {
  Vec3 centre = Vec3::Zero();  ///< [m] slightly above the surface
  Vec3 first = Vec3::Zero();   ///< [m] semi-axis of the spot, one standard deviation long
  Vec3 second = Vec3::Zero();  ///< [m] the other semi-axis, perpendicular
  double strength = 0;         ///< [1] part of the light removed at the centre
};

/// Radius of a spot in standard deviations.
inline constexpr double kShadeReach = 3;

/// One for each marked box and surface near each other: the box's projection onto the surface, approximated
/// by the ellipse of its second moments, widened and weakened with the distance [m] of its lowest corner.
/// Independent of other boxes and the eye, so it does not flicker. `strength` is that of a touching box.
std::vector<ContactShade> contactShades(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces,
                                        double strength);

/// All spots of a frame, drawn in one call onto the surfaces; alpha is unchanged.
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
