#pragma once

#include <functional>
#include <vector>

#include "exchange/mjcf_defaults.h"

namespace careen {

/// What a body that moves collides as.
struct MjcfShape {
  MjcfGeom geom;                ///< its box; of several, that around them about the body's origin
  std::vector<MjcfGeom> parts;  ///< of several, each
};

/// Of the geoms of a body those that collide; if none does, all its boxes. InputError if there are none or
/// more than a body may have, if one is no box, and where two of them would not touch others alike, since
/// friction and what passes through a body are one for all its boxes.
MjcfShape shapeOf(MjcfDocument& document, const XmlElement& body, const std::vector<MjcfGeom>& geoms,
                  const std::function<bool(const MjcfGeom&)>& collides);

/// Refuses what is no box, and boxes without a size.
void checkBox(const MjcfDocument& document, const MjcfGeom& geom);

}  // namespace careen
