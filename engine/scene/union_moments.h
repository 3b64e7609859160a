#pragma once

#include <span>

#include "physics/world/body.h"
#include "scene/solid_mesh.h"

namespace careen {

/// Of the union of boxes, in their body's frame, at a density of 1 kg/m³: what several of them share counts
/// once. Exact but for rounding: each box is cut along the faces of those before it into convex pieces, and
/// the pieces that lie in one of them are left out. A union that is itself a box, along the body's axes, has
/// the inertia of solidBox().
SolidMoments momentsOfUnion(std::span<const BodyPart> parts);

/// [m] How far boxes reach from the frame's origin along its axes.
Vec3 reachOf(std::span<const BodyPart> parts);

}  // namespace careen
