#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_defaults.h"
#include "exchange/mjcf_document.h"
#include "exchange/mjcf_frame.h"
#include "exchange/mjcf_mass.h"
#include "exchange/mjcf_names.h"

namespace careen {

/// A plane, or a box or boxes of one body, with its friction.
struct MjcfSurface {
  MjcfGeom geom;                     ///< of several boxes, that around them, in the body's frame
  std::vector<MjcfGeom> parts = {};  ///< of several
  bool movable = false;
  MjcfFrame frame;  ///< world
  std::string name;
  std::string ofBody;  ///< the name of its <body>
  MjcfMass mass = {};
  // Of a body that moves:
  MjcfFrame body = {};                     ///< world from it
  MjcfFrame standing = {};                 ///< likewise, as the model stands before any key frame
  std::optional<std::size_t> parent = {};  ///< the box of the body that it is in; none: the world
  MjcfFrame inParent = {};       ///< as the model stands: from it to the parent if that moves, or the world
  MjcfJoint joint = {};          ///< to the parent, in its own frame
  double coordinate = 0;         ///< of a hinge or slide
  Vec3 velocity = Vec3::Zero();  ///< of the box's middle
  Vec3 angularVelocity = Vec3::Zero();

  bool isPlane() const { return geom.type == "plane"; }
  std::size_t geomCount() const { return parts.empty() ? 1 : parts.size(); }
  bool isJointed() const { return movable && !joint.isFree(); }
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

/// A tendon as long as it may be, or as it must be.
struct MjcfRope {
  const XmlElement* element = nullptr;  ///< that says so
  std::string name;
  bool isRod = false;
  MjcfSite from;
  MjcfSite to;
  double length = 0;  ///< [m]
};

/// What a name of a <body> stands for.
struct MjcfNamedBody {
  std::optional<std::size_t> surface = {};  ///< its first box
  MjcfFrame standing = {};                  ///< world from it, as the model stands
};

/// The bodies of an MJCF file and what joins them, before anything touches.
struct MjcfModel {
  std::vector<MjcfSurface> surfaces;  ///< in the file's order, parents before what is in them
  std::vector<MjcfSpring> springs;
  std::vector<MjcfRope> ropes;
  std::map<std::string, MjcfNamedBody> bodies;
  MjcfNames jointNames;            ///< of joints of bodies, and of ropes
  std::vector<std::string> notes;  ///< what was renamed, and what it starts from

  /// A site's place [m] at the start, world.
  Vec3 placeOf(const MjcfSite& site) const;
};

/// Reads <worldbody>, <tendon> and the key frame "start" as MuJoCo does. A body that moves has a box or
/// several that collide; it is free, or has one joint to the body that it is in, or none; otherwise
/// InputError. Geoms that collide with nothing are not among the surfaces, but count for masses.
MjcfModel readModel(MjcfDocument& document);

}  // namespace careen
