// Where members were and can be: motion within the last step, space that is taken.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "physics/geometry/separation.h"
#include "physics/motion/joined_steps.h"
#include "physics/pile/axes.h"
#include "physics/pile/crowd.h"
#include "physics/pile/depth_search.h"

namespace careen {
namespace {

// [1] of the tolerance: distance from a joint, and depth there, that are too much for a smooth path.
constexpr double kRounded = 0.5;
constexpr double kDeepAtJoint = 1.5;
// [1] of the bend, before and after it: from where to where it is looked at; as in depthWithin().
constexpr double kBesideJoint = 0.4;
constexpr double kSwingAtJoint = 2;
constexpr double kShortestAtJoint = 0.0625;
constexpr double kLasting = 4;  // [1] of gravity × step: larger changes of velocity are those of impacts

// [rad/s] Body frame: of the turn from the one to the other in that time. Its angle is 2 asin of the length
// of the vector part, here to eighth order.
Vec3 spinBetween(const Quat& from, const Quat& to, double length) {
  const Quat turn = from.conjugate() * to;
  const double z = turn.vec().squaredNorm();
  const double angle = 2 * (1 + z * (1.0 / 6 + z * (3.0 / 40 + z * (15.0 / 336))));
  return (turn.w() < 0 ? -angle : angle) / length * turn.vec();
}

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

Vec3 Crowd::meanSpin(std::size_t place) const {
  return spinBetween(before_[place].attitude, bodies_[place].attitude, h_);
}

// On the way of the last step, straight between its ends.
Pose Crowd::between(std::size_t place, double part) const {
  const PileBody& from = start_[place];
  const PileBody& to = bodies_[place];
  if (part == 0 || to.still()) {
    return {.position = from.position, .worldFromBody = from.axes};
  }
  if (part == 1) {
    return {.position = to.position, .worldFromBody = to.axes};
  }
  const double back = (1 - part) * (dot(to.attitude, from.attitude) < 0 ? -1 : 1);
  return {
      .position = (1 - part) * from.position + part * to.position,
      .worldFromBody =
          Quat(back * from.attitude.coeffs() + part * to.attitude.coeffs()).normalized().toRotationMatrix()};
}

// To second order.
Crowd::Rates Crowd::meanRates(std::size_t place) const {
  const PileBody& from = start_[place];
  const PileBody& to = bodies_[place];
  const Quat turn = to.attitude * from.attitude.conjugate();
  const double perSecond = 1 / h_;
  return {.velocity = perSecond * (to.position - from.position),
          .omega = (turn.w() < 0 ? -2 : 2) * perSecond * turn.vec()};
}

// Whether near where this step begins, the smooth path through both would lead members deep into each other.
void Crowd::findSharp() {
  std::vector<Rates> change(bodies_.size());
  forPlaces([&](std::size_t i) {
    if (before_[i].moved) {
      const Rates rates = meanRates(i);
      change[i] = {.velocity = rates.velocity - ratesBefore_[i].velocity,
                   .omega = rates.omega - ratesBefore_[i].omega};
    }
  });
  const double most = JoinedSteps::beside(hBefore_, h_, 0).off;
  const auto onPath = [&](std::size_t i, const JoinedSteps::Beside& moment) {
    const Rates& rates = ratesBefore_[i];
    const bool before = moment.time < 0;
    const double off = pastOf(i) < hBefore_ ? JoinedSteps::offAt(pastOf(i), h_, moment.time) : moment.off;
    Pose pose = between(i, before ? 0 : moment.time / h_);
    Vec3 turn = off * change[i].omega;
    pose.position += off * change[i].velocity;
    if (before && before_[i].moved) {
      pose.position += moment.time * rates.velocity;
      turn += moment.time * rates.omega;
    }
    pose.worldFromBody =
        Quat(1, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized() * pose.worldFromBody;
    return pose;
  };
  const auto gapAt = [&](const PileManifold& manifold, double along) {  // from 0 to 1
    const JoinedSteps::Beside moment = JoinedSteps::beside(hBefore_, h_, kBesideJoint * (2 * along - 1));
    const PileBody& a = bodies_[at(manifold.a)];
    const PileBody& b = bodyAt(manifold.b);
    const Pose poseA = onPath(at(manifold.a), moment);
    const Pose poseB = onPath(at(manifold.b.body()), moment);
    return gapAbove(-kDeepAtJoint * tolerance_, manifold.axis, a, poseA.worldFromBody, b, poseB.worldFromBody,
                    a.middleAt(poseA) - b.middleAt(poseB));
  };
  const auto passingSpeed = [&](const PileManifold& manifold) {  // [m/s] bound
    const std::size_t a = at(manifold.a);
    const std::size_t b = at(manifold.b.body());
    const Rates& ofA = ratesBefore_[a];
    const Rates& ofB = ratesBefore_[b];
    return (ofA.velocity - ofB.velocity).norm() + (change[a].velocity - change[b].velocity).norm() +
           bodies_[a].radius * (ofA.omega.norm() + change[a].omega.norm()) +
           bodies_[b].radius * (ofB.omega.norm() + change[b].omega.norm());
  };
  // The bend lies in the hull of the joint and its own ends; what the separation along an axis that turns
  // with the bodies is lower within by is of second order in their turns.
  const double begin = JoinedSteps::beside(hBefore_, h_, -1).time;
  const double end = JoinedSteps::beside(hBefore_, h_, 1).time;
  const auto staysApart = [&](const PileManifold& manifold) {
    const PileBody& a = start_[at(manifold.a)];
    const PileBody& b = start_[at(manifold.b.body())];
    const auto ratesAfter = [&](std::size_t i) {
      return Rates{ratesBefore_[i].velocity + change[i].velocity, ratesBefore_[i].omega + change[i].omega};
    };
    const auto axesThen = [](const PileBody& body, const Vec3& turn) {
      Mat3 axes;
      for (int k = 0; k < 3; ++k) {
        axes.col(k) = body.axes.col(k) + turn.cross(body.axes.col(k));
      }
      return axes;
    };
    double lower = 0;
    double least = std::numeric_limits<double>::max();
    for (const double time : {begin, 0.0, end}) {
      const Rates ofA = time < 0 ? ratesBefore_[at(manifold.a)] : ratesAfter(at(manifold.a));
      const Rates ofB = time < 0 ? ratesBefore_[at(manifold.b.body())] : ratesAfter(at(manifold.b.body()));
      const Vec3 apart = a.position - b.position + time * (ofA.velocity - ofB.velocity);
      const Mat3 axesA = axesThen(a, time * ofA.omega);
      const Mat3 axesB = axesThen(b, time * ofB.omega);
      const Vec3 arms = (a.center == nullptr ? Vec3(Vec3::Zero()) : Vec3(axesA * *a.center)) -
                        (b.center == nullptr ? Vec3(Vec3::Zero()) : Vec3(axesB * *b.center));
      least = std::min(least, separationAlong(manifold.axis, a, axesA, b, axesB, apart + arms));
      const double turn = std::abs(time) * (ofA.omega.norm() + ofB.omega.norm());
      const double way = std::abs(time) * (ofA.velocity - ofB.velocity).norm();
      lower = std::max(lower, turn * (turn * (a.radius + b.radius) + way));
    }
    return least - lower > -kDeepAtJoint * tolerance_;
  };
  const auto isSharpAt = [&](const PileManifold& manifold) {
    if (manifold.b.isWall()) {
      return false;
    }
    const Rates& ofA = change[at(manifold.a)];
    const Rates& ofB = change[at(manifold.b.body())];
    const Vec3 apart = start_[at(manifold.b.body())].position - start_[at(manifold.a)].position;
    const bool alike = pastOf(at(manifold.a)) == pastOf(at(manifold.b.body()));
    const double way = alike ? (ofB.velocity - ofA.velocity - ofA.omega.cross(apart)).norm() +
                                   bodyAt(manifold.b).radius * (ofB.omega - ofA.omega).norm()
                             : ofA.velocity.norm() + bodies_[at(manifold.a)].radius * ofA.omega.norm() +
                                   ofB.velocity.norm() + bodyAt(manifold.b).radius * ofB.omega.norm();
    if (most * way <= kRounded * tolerance_) {
      return false;
    }
    if (alike && manifold.axis >= 0 && staysApart(manifold)) {
      return false;
    }
    const DepthSearch search{.motion = kBesideJoint * std::max(hBefore_, h_) * passingSpeed(manifold),
                             .deep = kDeepAtJoint * tolerance_,
                             .swing = kSwingAtJoint * tolerance_,
                             .shortest = kShortestAtJoint};
    const double first = gapAt(manifold, 0);
    const double last = gapAt(manifold, 1);
    const auto between = [&](double along) { return gapAt(manifold, along); };
    return std::max({-first, -last, searchDepth(search, between, first, last)}) > search.deep;
  };
  std::atomic<bool> sharp = false;
  forNear([&](const PileManifold& manifold, std::size_t) {
    if (!sharp && isSharpAt(manifold)) {
      sharp = true;
    }
  });
  isSharp_ = sharp;
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
                    [](const PilePoint& point) { return point.normalImpulse > 0; })) {
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
