#pragma once

#include "physics/geometry/contact_frame.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/manifold.h"
#include "physics/pile/solver_body.h"

namespace careen {

/// A surface that moves along itself, or with something driven, is to the solver a body that cannot be moved
/// and has its motion: one for each block of rows on it.
///
/// Whether the manifold is on one.
inline bool isOnBelt(const CrowdMembers& members, const PileManifold& manifold) {
  return manifold.material.surface.moves() || members[manifold.a].isDriven() ||
         members[manifold.b].isDriven();
}
/// How that body moves in the middle of the step, about the centre of the body of which the surface is, for
/// rows in that frame of which one is at `point`: right everywhere on a face, and on what is driven.
Moving motionOfBelt(const CrowdMembers& members, const PileManifold& manifold, const ContactFrame& frame,
                    const PilePoint& point);
/// [m/s] Its velocity at a point as seen from a, against that if it is a's.
Vec3 velocityOfBelt(const CrowdMembers& members, const PileManifold& manifold, const ContactFrame& frame,
                    const PilePoint& point);
/// The block's bodies, the belt in place of the one that it is of.
struct BeltBlock {
  int a = 0;
  int b = 0;
};
BeltBlock bodiesOnBelt(const CrowdMembers& members, const PileManifold& manifold, int belt);

}  // namespace careen
