#include "physics/contact/group_step.h"

#include "physics/motion/hermite_step.h"

namespace careen {

// Accelerations of the middles of both halves become those of the ends, as they grow evenly: by themselves in
// flight. In contact one may be 0 because it began to move, or came to rest, in between: neither turns over.
void GroupStep::bend(Vec3& from, Vec3& to) const {
  constexpr double kFree = 0x1p-10;
  Vec3 more = 0.5 * (to - from);
  const Vec3 free = (0.25 * length) * slope;
  if ((more - free).norm() > kFree * free.norm()) {
    const Vec3 most = from.cwiseAbs().cwiseMin(to.cwiseAbs());
    more = more.cwiseMin(most).cwiseMax(-most);
  }
  from -= more;
  to += more;
}

ContactStep GroupStep::motion(const TouchingBody& body, std::size_t index) const {
  const auto ofEnd = [&](const GroupState& at) {
    const GroupBody& state = at[index];
    return StepEnd{.position = state.position,
                   .velocity = state.velocity,
                   .worldFromBody = state.worldFromBody,
                   .spinBody = body.body->mass.inverseInertiaTimes(state.worldFromBody.conjugate() *
                                                                   state.angularMomentum)};
  };
  StepEnd from = ofEnd(start);
  StepEnd to = ofEnd(end);
  if (dot(to.worldFromBody.coeffs(), from.worldFromBody.coeffs()) < 0) {
    to.worldFromBody.coeffs() = -to.worldFromBody.coeffs();
  }
  if (length > 0) {
    const double half = 0.5 * length;
    StepEnd between = middle.empty() ? from : ofEnd(middle);
    if (middle.empty()) {
      between.velocity = 0.5 * (from.velocity + to.velocity);
      between.spinBody = 0.5 * (from.spinBody + to.spinBody);
    }
    from.acceleration = (between.velocity - from.velocity) / half;
    to.acceleration = (to.velocity - between.velocity) / half;
    from.spinRateBody = (between.spinBody - from.spinBody) / half;
    to.spinRateBody = (to.spinBody - between.spinBody) / half;
    if (!slope.isZero(0)) {
      bend(from.acceleration, to.acceleration);
    }
  }
  return hermiteStep(from, to, length);
}

GroupPath::GroupPath(const TouchingGroup& group, const GroupStep& step)
    : group_(group), step_(step), motions_(group.size()) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (!group.isHeld(i)) {
      motions_[i] = step.motion(group.bodies()[i], i);
    }
  }
}

GroupBody GroupPath::at(std::size_t body, double time) const {
  if (group_.isDriven(body)) {
    return group_.drivenFrom(step_.start, body, time);
  }
  if (group_.isHeld(body)) {
    return step_.start[body];
  }
  const BodyState state = stateAt(Motion(motions_[body]), group_.body(body).mass, time);
  return {.position = state.pose.position,
          .worldFromBody = Quat(state.pose.worldFromBody),
          .velocity = state.velocity,
          .angularMomentum = state.angularMomentum,
          .time = step_.start[body].time + time};
}

}  // namespace careen
