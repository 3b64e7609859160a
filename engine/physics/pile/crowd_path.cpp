#include "physics/pile/crowd_path.h"

#include <algorithm>
#include <cmath>

#include "core/disjoint_sets.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

constexpr double kLasting = 4;  // [1] of gravity × step: larger changes of velocity are those of impacts

}  // namespace

CrowdExtent CrowdPath::extent(double length) const {
  CrowdExtent extent;
  for (const PileBody& body : members_.bodies) {
    if (!body.absent && !body.held()) {
      const double fall = (length + body.behind) * members_.gravity;
      const double way = body.asleep ? 0 : length * (body.velocity.norm() + fall);
      extent.include(body.position, body.radius + way);
    }
  }
  return extent;
}

void CrowdExtent::include(const Vec3& center, double radius) {
  low = low.cwiseMin(center - Vec3::Constant(radius));
  high = high.cwiseMax(center + Vec3::Constant(radius));
}

CrowdExtent CrowdPath::swept() const {
  CrowdExtent extent;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_.ways[i].moved) {
      extent.include(members_[i].position, members_[i].radius + members_.tolerance);
      extent.include(members_.ways[i].position, members_[i].radius + members_.tolerance);
    }
  }
  return extent;
}

bool CrowdPath::cameNear(std::size_t place, const Body& body, const Pose& pose, double distance) const {
  if (!members_.ways[place].moved) {
    return false;
  }
  const PileBody& start = members_.start[place];
  const double within = distance + members_[place].path - start.path + members_.tolerance;
  const Body& own = members_.world.bodies[members_.listed[place]];
  return (pose.position - start.position).norm() <= radiusOf(body) + start.radius + within &&
         anyBoxes(body, pose, own, {start.position, start.axes},
                  [&](const BoxAt& a, const BoxAt& b) { return BoxAxes(a, b).gap() <= within; });
}

Vec3 CrowdPath::meanSpin(std::size_t place) const {
  return spinBetween(members_.ways[place].attitude, members_[place].attitude, members_.h);
}

// Whether more than what lasting forces do changed its velocity in the last step.
bool CrowdPath::changesSuddenly(std::size_t place) const {
  const CrowdMembers::Way& from = members_.ways[place];
  const PileBody& body = members_[place];
  const double change = ((body.position - from.position) / members_.h - from.velocity).norm() +
                        body.radius * (meanSpin(place) - from.attitude.conjugate() * from.omega).norm();
  return change > kLasting * loads_.acceleration(place).norm() * members_.h;
}

std::vector<char> CrowdPath::changedSuddenly() const {
  DisjointSets pushing(members_.size());
  for (const int slot : contacts_.near()) {
    const PileManifold& manifold = contacts_[slot];
    const auto* const end = manifold.points.data() + manifold.count;
    if (members_.ways[at(manifold.a)].moved && members_.ways[at(manifold.b)].moved &&
        std::any_of(manifold.points.data(), end,
                    [](const PilePoint& point) { return point.normalImpulse > 0; })) {
      pushing.join(at(manifold.a), at(manifold.b));
    }
  }
  std::vector<char> suddenly(members_.size(), 0);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_.ways[i].moved && members_.ways[i].pushed && changesSuddenly(i)) {
      suddenly[pushing.root(i)] = 1;
    }
  }
  for (std::size_t i = members_.size(); i-- > 0;) {  // a set goes by its least member
    suddenly[i] = suddenly[pushing.root(i)];
  }
  return suddenly;
}

StepEnd CrowdPath::begin(std::size_t place) const {
  StepEnd begin = beginAsItCame(place);
  const CrowdMembers::Way& from = members_.ways[place];
  if (from.pushed) {
    begin.velocity = (members_[place].position - from.position) / members_.h;
    begin.spinBody = meanSpin(place);
  }
  return begin;
}

StepEnd CrowdPath::beginAsItCame(std::size_t place) const {
  const CrowdMembers::Way& from = members_.ways[place];
  return {.position = from.position,
          .velocity = from.velocity,
          .worldFromBody = from.attitude,
          .spinBody = from.attitude.conjugate() * from.omega};
}

StepEnd CrowdPath::end(std::size_t place) const {
  const CrowdMembers::Way& from = members_.ways[place];
  const PileBody& to = members_[place];
  StepEnd end{.position = to.position, .worldFromBody = to.attitude};
  if (from.pushed) {
    end.velocity = (to.position - from.position) / members_.h;
    end.spinBody = meanSpin(place);
  } else {
    end.velocity = from.endVelocity;
    end.spinBody = to.attitude.conjugate() * from.endOmega;
  }
  return end;
}

}  // namespace careen
