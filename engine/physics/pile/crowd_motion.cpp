// Where members were and can be: motion within the last step, space that is taken.
#include <algorithm>
#include <cmath>

#include "physics/geometry/separation.h"
#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kLasting = 4;  // [1] of gravity × step: larger changes of velocity are those of impacts

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
      const double fall = (length + body.behind) * gravityMagnitude_;
      const double way = body.asleep ? 0 : length * (body.velocity.norm() + fall);
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

BodyState Crowd::stateAtVelocity(std::size_t place) const {
  BodyState state = stateOf(bodies_[place]);
  state.pose.position -= bodies_[place].behind * state.velocity;
  return state;
}

BodyState Crowd::stateAtEnd(std::size_t place) const {
  BodyState state = stateOf(bodies_[place]);
  state.velocity += halfKick(place);
  state.angularMomentum += bodies_[place].behind * torque(place);
  return state;
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

// [rad/s] Body frame: of the turn from one end to the other. Its angle is 2 asin of the length of the vector
// part, here to eighth order.
Vec3 Crowd::meanSpin(std::size_t place) const {
  const Quat turn = before_[place].attitude.conjugate() * bodies_[place].attitude;
  const double z = turn.vec().squaredNorm();
  const double angle = 2 * (1 + z * (1.0 / 6 + z * (3.0 / 40 + z * (15.0 / 336))));
  return (turn.w() < 0 ? -angle : angle) / h_ * turn.vec();
}

// Whether more than what lasting forces do changed its velocity in the last step.
bool Crowd::changesSuddenly(std::size_t place) const {
  const Before& from = before_[place];
  const PileBody& body = bodies_[place];
  const double change = ((body.position - from.position) / h_ - from.velocity).norm() +
                        body.radius * (meanSpin(place) - from.attitude.conjugate() * from.omega).norm();
  return change > kLasting * acceleration(place).norm() * h_;
}

std::vector<char> Crowd::changedSuddenly() const {
  DisjointSets pushing(bodies_.size());
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    const auto* const end = manifold.points.data() + manifold.count;
    if (!manifold.b.isWall() && before_[at(manifold.a)].moved && before_[at(manifold.b.body())].moved &&
        std::any_of(manifold.points.data(), end,
                    [](const PilePoint& point) { return point.row >= 0 && point.normalImpulse > 0; })) {
      pushing.join(at(manifold.a), at(manifold.b.body()));
    }
  }
  std::vector<char> suddenly(bodies_.size(), 0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (before_[i].moved && before_[i].pushed && changesSuddenly(i)) {
      suddenly[pushing.root(i)] = 1;
    }
  }
  for (std::size_t i = bodies_.size(); i-- > 0;) {  // a set goes by its least member
    suddenly[i] = suddenly[pushing.root(i)];
  }
  return suddenly;
}

StepEnd Crowd::begin(std::size_t place, bool asItCame) const {
  const Before& from = before_[place];
  StepEnd end{.position = from.position, .worldFromBody = from.attitude};
  if (from.pushed && !asItCame) {
    end.velocity = (bodies_[place].position - from.position) / h_;
    end.spinBody = meanSpin(place);
  } else {
    end.velocity = from.velocity;
    end.spinBody = from.attitude.conjugate() * from.omega;
  }
  return end;
}

StepEnd Crowd::end(std::size_t place) const {
  const Before& from = before_[place];
  const PileBody& to = bodies_[place];
  StepEnd end{.position = to.position, .worldFromBody = to.attitude};
  if (from.pushed) {
    end.velocity = (to.position - from.position) / h_;
    end.spinBody = meanSpin(place);
  } else {
    end.velocity = from.endVelocity;
    end.spinBody = to.attitude.conjugate() * from.endOmega;
  }
  return end;
}

}  // namespace careen
