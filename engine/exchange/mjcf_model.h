#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_defaults.h"
#include "exchange/mjcf_document.h"
#include "exchange/mjcf_frame.h"
#include "exchange/mjcf_mass.h"

namespace careen {

/// A plane or a box with its friction.
struct MjcfSurface {
  MjcfGeom geom;
  bool movable = false;
  MjcfFrame frame;  ///< world
  std::string name;
  MjcfMass mass = {};
  MjcfFrame body = {};  ///< world from the body of a free joint
  Vec3 velocity = Vec3::Zero();
  Vec3 angularVelocity = Vec3::Zero();

  bool isPlane() const { return geom.type == "plane"; }
};

/// An end of springs.
struct MjcfSite {
  std::optional<std::size_t> surface;  ///< the box it is on; none: the world
  Vec3 point = Vec3::Zero();           ///< [m] in the box's frame, or the world's
  Vec3 place = Vec3::Zero();           ///< [m] world, before any key frame
};

struct MjcfSpring {
  MjcfSite from;
  MjcfSite to;
  double stiffness = 0;   ///< [N/m]
  double damping = 0;     ///< [N s/m]
  double restLength = 0;  ///< [m]
};

/// The bodies of an MJCF file and what joins them, before anything touches.
struct MjcfModel {
  std::vector<MjcfSurface> surfaces;  ///< in the file's order
  std::vector<MjcfSpring> springs;
  std::vector<double> damping;     ///< of each free joint
  std::vector<std::string> notes;  ///< what was renamed, and what it starts from
};

/// Reads <worldbody>, <tendon> and the key frame "start" as MuJoCo does. Bodies that move have a free joint
/// and one box that collides, and no other has a joint; otherwise InputError. Geoms that collide with nothing
/// are not among the surfaces, but count for masses.
MjcfModel readModel(MjcfDocument& document);

}  // namespace careen
