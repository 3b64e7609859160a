#include "physics/pile/crowd_seams.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "physics/pile/axes.h"
#include "physics/pile/depth_search.h"

namespace careen {
namespace {

// [1] of the tolerance: distance from a seam, and depth there, that are too much for a smooth path.
constexpr double kRoundedAtSeam = 0.5;
constexpr double kDeepAtSeam = 1.5;
// [1] of the bend, before and after it: from where to where it is looked at; as on the way of a step.
constexpr double kBesideSeam = 0.4;
constexpr double kSwingAtSeam = 2;
constexpr double kShortestAtSeam = 0.0625;

}  // namespace

// To second order.
CrowdSeams::Rates CrowdSeams::meanRates(std::size_t place) const {
  const PileBody& from = members_.start[place];
  const PileBody& to = members_[place];
  const Quat turn = to.attitude * from.attitude.conjugate();
  const double perSecond = 1 / members_.h;
  return {.velocity = perSecond * (to.position - from.position),
          .omega = (turn.w() < 0 ? -2 : 2) * perSecond * turn.vec()};
}

void CrowdSeams::remember() {
  members_.forEach([&](std::size_t i) {
    const bool moved = members_.ways[i].moved;
    CrowdMemory::OfPlace& place = memory_.places[i];
    place.rates = moved ? meanRates(i) : Rates{members_[i].velocity, members_[i].omega};
    place.past = moved ? std::numeric_limits<double>::max() : place.past;
  });
}

bool CrowdSeams::isSharp() {
  change_.assign(members_.size(), {});
  members_.forEach([&](std::size_t i) {
    if (members_.ways[i].moved) {
      const Rates rates = meanRates(i);
      change_[i] = {.velocity = rates.velocity - ratesBefore(i).velocity,
                    .omega = rates.omega - ratesBefore(i).omega};
    }
  });
  std::atomic<bool> sharp = false;
  contacts_.forNear([&](const PileManifold& manifold, std::size_t) {
    if (!sharp && isSharpAt(manifold)) {
      sharp = true;
    }
  });
  return sharp;
}

bool CrowdSeams::isSharpAt(const PileManifold& manifold) const {
  const double most = JoinedSteps::beside(memory_.length, members_.h, 0).off;
  if (!members_[manifold.b].isBox() || most * bendOf(manifold) <= kRoundedAtSeam * members_.tolerance) {
    return false;
  }
  if (areAlike(manifold) && manifold.axis >= 0 && staysApart(manifold)) {
    return false;
  }
  const DepthSearch search{
      .motion = kBesideSeam * std::max(memory_.length, members_.h) * passingSpeed(manifold),
      .deep = kDeepAtSeam * members_.tolerance,
      .swing = kSwingAtSeam * members_.tolerance,
      .shortest = kShortestAtSeam};
  const double first = gapAt(manifold, 0);
  const double last = gapAt(manifold, 1);
  const auto between = [&](double along) { return gapAt(manifold, along); };
  return std::max({-first, -last, searchDepth(search, between, first, last)}) > search.deep;
}

// Whether their steps before were as long.
bool CrowdSeams::areAlike(const PileManifold& manifold) const {
  return pastOf(at(manifold.a)) == pastOf(at(manifold.b));
}

// [m/s] By how much the rates of the one change as seen from the other, at the most.
double CrowdSeams::bendOf(const PileManifold& manifold) const {
  const int a = manifold.a;
  const int b = manifold.b;
  const Rates& ofA = change_[at(a)];
  const Rates& ofB = change_[at(b)];
  const Vec3 apart = members_.start[at(b)].position - members_.start[at(a)].position;
  return areAlike(manifold) ? (ofB.velocity - ofA.velocity - ofA.omega.cross(apart)).norm() +
                                  members_[b].radius * (ofB.omega - ofA.omega).norm()
                            : ofA.velocity.norm() + members_[a].radius * ofA.omega.norm() +
                                  ofB.velocity.norm() + members_[b].radius * ofB.omega.norm();
}

// [m/s] Bound.
double CrowdSeams::passingSpeed(const PileManifold& manifold) const {
  const std::size_t a = at(manifold.a);
  const std::size_t b = at(manifold.b);
  const Rates& ofA = ratesBefore(a);
  const Rates& ofB = ratesBefore(b);
  return (ofA.velocity - ofB.velocity).norm() + (change_[a].velocity - change_[b].velocity).norm() +
         members_[a].radius * (ofA.omega.norm() + change_[a].omega.norm()) +
         members_[b].radius * (ofB.omega.norm() + change_[b].omega.norm());
}

// The bend lies in the hull of the seam and its own ends; what the separation along an axis that turns with
// the bodies is lower within by is of second order in their turns.
bool CrowdSeams::staysApart(const PileManifold& manifold) const {
  const PileBody& a = members_.start[at(manifold.a)];
  const PileBody& b = members_.start[at(manifold.b)];
  const auto ratesAt = [&](int body, double time) {
    const Rates& rates = ratesBefore(at(body));
    return time < 0
               ? rates
               : Rates{rates.velocity + change_[at(body)].velocity, rates.omega + change_[at(body)].omega};
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
  for (const double part : {-1.0, 0.0, 1.0}) {
    const double time = part == 0 ? 0 : JoinedSteps::beside(memory_.length, members_.h, part).time;
    const Rates ofA = ratesAt(manifold.a, time);
    const Rates ofB = ratesAt(manifold.b, time);
    const Vec3 apart = a.position - b.position + time * (ofA.velocity - ofB.velocity);
    const PileBox boxA = boxOf(a, manifold.boxA, {a.position, axesThen(a, time * ofA.omega)});
    const PileBox boxB = boxOf(b, manifold.boxB, {b.position, axesThen(b, time * ofB.omega)});
    const Vec3 arms = boxA.boxArm() - boxB.boxArm();
    least = std::min(least, separationAlong(manifold.axis, boxA, boxB, apart + arms));
    const double turn = std::abs(time) * (ofA.omega.norm() + ofB.omega.norm());
    const double way = std::abs(time) * (ofA.velocity - ofB.velocity).norm();
    lower = std::max(lower, turn * (turn * (a.radius + b.radius) + way));
  }
  return least - lower > -kDeepAtSeam * members_.tolerance;
}

// [m] From 0 to 1, of the part of the bend that is looked at.
double CrowdSeams::gapAt(const PileManifold& manifold, double along) const {
  const JoinedSteps::Beside moment =
      JoinedSteps::beside(memory_.length, members_.h, kBesideSeam * (2 * along - 1));
  const PileBody& a = members_[manifold.a];
  const PileBody& b = members_[manifold.b];
  return gapAboveOfBoxes(-kDeepAtSeam * members_.tolerance, manifold.axis,
                         boxOf(a, manifold.boxA, onPath(at(manifold.a), moment)),
                         boxOf(b, manifold.boxB, onPath(at(manifold.b), moment)));
}

Pose CrowdSeams::onPath(std::size_t i, const JoinedSteps::Beside& moment) const {
  const Rates& rates = ratesBefore(i);
  const bool before = moment.time < 0;
  const double off =
      pastOf(i) < memory_.length ? JoinedSteps::offAt(pastOf(i), members_.h, moment.time) : moment.off;
  Pose pose = members_.between(i, before ? 0 : moment.time / members_.h);
  Vec3 turn = off * change_[i].omega;
  pose.position += off * change_[i].velocity;
  if (before && members_.ways[i].moved) {
    pose.position += moment.time * rates.velocity;
    turn += moment.time * rates.omega;
  }
  pose.worldFromBody =
      Quat(1, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized() * pose.worldFromBody;
  return pose;
}

}  // namespace careen
