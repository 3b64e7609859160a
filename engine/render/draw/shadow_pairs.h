#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/draw/drawn_box.h"
#include "render/draw/light_plane.h"

namespace careen {

/// The shadow of a box on a face of another one.
struct ShadowPair {
  std::size_t face = 0;
  std::size_t caster = 0;  ///< index of the box
  double weight = 1;       ///< [1] falls to 0 where no more of the caster is in front of the face
};

/// Shadows of boxes on faces.
struct FaceShadows {
  std::vector<ShadowPair> pairs;  ///< face by face
  std::vector<bool> isDark;       ///< of each face: no point of it has direct light; it is in no pair
};

class KeptLists;

/// All boxes whose shadow, penumbra included, may reach these faces, but for those whose share the others
/// keep off anyway. `spread` [1] is how wide penumbras are on each side of an edge, of the distance;
/// `pixelAngle` [rad] widens what is narrower than a pixel. With the same result, what is kept is not looked
/// for again.
FaceShadows shadowsOnFaces(LightPlane& light, std::span<const DrawnBox> boxes,
                           std::span<const DrawnFace> faces, const Vec3& eye, double spread,
                           double pixelAngle, const KeptLists* kept = nullptr);

}  // namespace careen
