#include "physics/exact/crowd_paths.h"

namespace careen {
namespace {

/// [1] of the tolerance: how far recorded steps may differ from those computed, so that fewer are recorded.
constexpr double kMerged = 0.25;
/// [1] of kMerged, without gravity: what moves slowly does so for long, and its momentum is all there is; and
/// of what is joined to others, whose momenta cancel.
constexpr double kMergedAfloat = 0x1p-4;

}  // namespace

JoinedSteps newPath(const Bodies& bodies, int rank) {
  const bool isAfloat = gravityScale(bodies.world()) == 0 || !bodies.joinedTo(rank).empty();
  return JoinedSteps(kMerged * bodies.crowds().tolerance * (isAfloat ? kMergedAfloat : 1));
}

JoinedSteps pathFrom(const Bodies& bodies, const Mover& body, const Instant& time, const BodyState& state,
                     const Quat& attitude, double length) {
  JoinedSteps path = newPath(bodies, body.rank);
  if (length > 0) {
    const auto endAt = [&](const BodyState& at, const Quat& turned) {
      const Vec3 spin = at.pose.worldFromBody.transpose() * angularVelocity(body.body->mass, at);
      return StepEnd{
          .position = at.pose.position, .velocity = at.velocity, .worldFromBody = turned, .spinBody = spin};
    };
    const Instant begin = instantAfter(time, -length);
    const Quat turned = body.attitudeAt(begin);
    path.follows(begin.hi, endAt(body.stateAt(begin, turned), turned), endAt(state, attitude), length);
  }
  return path;
}

}  // namespace careen
