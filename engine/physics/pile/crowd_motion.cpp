// Where members were and can be: motion within the last step, space that is taken.
#include <algorithm>
#include <cmath>

#include "physics/geometry/separation.h"
#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kKink = 0.25;  // [1] of the tolerance: what smoothing a change of velocity may bend

}  // namespace

double Crowd::fastest() const {
  double fastest = 0;
  for (const PileBody& body : bodies_) {
    fastest = body.still() ? fastest : std::max(fastest, body.velocity.norm());
  }
  return fastest;
}

Crowd::Extent Crowd::extent(double length) const {
  Extent extent;
  for (const PileBody& body : bodies_) {
    if (!body.absent && !body.held) {
      const double way = body.asleep ? 0 : length * (body.velocity.norm() + length * gravityMagnitude_);
      extent.include(body.position, body.radius + way);
    }
  }
  return extent;
}

Crowd::Extent Crowd::swept() const {
  Extent extent;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (before_[i].moved) {
      extent.include(bodies_[i].position, bodies_[i].radius + tolerance_);
      extent.include(before_[i].position, bodies_[i].radius + tolerance_);
    }
  }
  return extent;
}

void Crowd::Extent::include(const Vec3& center, double radius) {
  low = low.cwiseMin(center - Vec3::Constant(radius));
  high = high.cwiseMax(center + Vec3::Constant(radius));
}

bool Crowd::cameNear(std::size_t place, BoxAt box, double distance) const {
  if (!before_[place].moved) {
    return false;
  }
  const PileBody& start = start_[place];
  const double within = distance + bodies_[place].path - start.path + tolerance_;
  return (box.pose.position - start.position).norm() <= box.radius() + start.radius + within &&
         BoxAxes(box.pose.worldFromBody, box.halfExtents, start.axes, start.halfExtents,
                 box.middle() - start.middle())
                 .gap() <= within;
}

// The change of velocity is spread over the step, unless that bends the path by more than a part of the
// tolerance: the cubic through both ends with both velocities differs from the straight line by 4/27 of it.
bool Crowd::isSmooth(std::size_t place) const {
  const Before& from = before_[place];
  const double change =
      (from.endVelocity - from.velocity).norm() + bodies_[place].radius * (from.endOmega - from.omega).norm();
  return !from.pushed || h_ * change * (4.0 / 27) <= kKink * tolerance_;
}

// [rad/s] Body frame: of the turn from one end to the other, to third order in the angle.
Vec3 Crowd::meanSpin(std::size_t place) const {
  const Quat turn = before_[place].attitude.conjugate() * bodies_[place].attitude;
  return (turn.w() < 0 ? -2 : 2) / h_ * turn.vec();
}

StepEnd Crowd::begin(std::size_t place) const {
  const Before& from = before_[place];
  StepEnd end{.position = from.position, .worldFromBody = from.attitude};
  if (isSmooth(place)) {
    end.velocity = from.velocity;
    end.spinBody = from.attitude.conjugate() * from.omega;
  } else {
    end.velocity = (bodies_[place].position - from.position) / h_;
    end.spinBody = meanSpin(place);
  }
  return end;
}

StepEnd Crowd::end(std::size_t place) const {
  const Before& from = before_[place];
  const PileBody& to = bodies_[place];
  StepEnd end{.position = to.position, .worldFromBody = to.attitude};
  if (isSmooth(place)) {
    end.velocity = from.endVelocity;
    end.spinBody = to.attitude.conjugate() * from.endOmega;
  } else {
    end.velocity = (to.position - from.position) / h_;
    end.spinBody = meanSpin(place);
  }
  return end;
}

}  // namespace careen
