#include "physics/contact_pushes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/disjoint_sets.h"
#include "physics/contact/contact_system.h"
#include "physics/contact/joint_rows.h"
#include "physics/geometry/chosen_contact.h"
#include "physics/geometry/contact_frame.h"
#include "physics/geometry/separation.h"
#include "physics/pile/manifold.h"
#include "physics/search/neighbors.h"
#include "physics/solver/least_forces.h"

namespace careen {
namespace {

/// How many times as far as near it is looked for what pushes, if what is nearer does not suffice.
constexpr std::array<double, 3> kReaches = {1, 8, 64};
/// [1] of the forces: what may be left of them, as accelerations within steps are known so well.
constexpr double kSuffices = 1e-3;

/// A point at which something may push, or a joint's condition.
struct Pushing {
  int a = 0;
  std::optional<Partner> b = {};
  int other = ContactProblem::kNobody;  // of b: a body that can move
  Vec3 point = Vec3::Zero();
  ContactFrame frame = {};
  double friction = 0;
  Vec3 slip = Vec3::Zero();  // [m/s] of a on b's surface; 0 if it may stick
  const ContactFeature* joint = nullptr;
};

/// Forces of a group and what they leave, by its bodies [N].
struct Found {
  std::vector<Pushing> pushing;
  LeastForces forces;
  std::vector<double> left = {};
  double worst = 0;  // [1] of what is left
};

class MomentOfContacts {
 public:
  MomentOfContacts(const World& world, const std::vector<PushedBody>& bodies, double time);

  std::vector<ContactPush> pushes();

 private:
  using Group = std::vector<int>;

  const Body& body(int index) const { return world_.bodies[static_cast<std::size_t>(index)]; }
  const PushedBody& at(int index) const { return bodies_[static_cast<std::size_t>(index)]; }
  const Pose& pose(int index) const { return at(index).state.pose; }
  int count() const { return static_cast<int>(bodies_.size()); }
  bool isHeld(int index) const { return isImmovable(body(index).mass); }
  bool isPushed(int index) const { return !isHeld(index) && at(index).given.has_value(); }
  Vec3 velocityAt(int index, const Vec3& point) const;
  Vec3 velocityOfWall(std::size_t wall, const Vec3& point) const;
  double reachOf(int a, std::optional<int> b, double times) const;

  void findPairs();
  void findJoints();
  std::vector<Group> groups();
  void addWalls(int a, double times, std::vector<Pushing>& pushing) const;
  void addBoxes(int a, int b, double times, std::vector<Pushing>& pushing) const;
  void addJoints(const Group& group, double times, std::vector<Pushing>& pushing) const;
  void setSlip(const Material& pair, Pushing& pushing) const;
  std::vector<Pushing> pushingOn(const Group& group, double times) const;
  enum class Slipping { kAgainstSlip, kAnyhow };
  ContactProblem::Contact contactOf(const Pushing& pushing, Slipping slipping) const;
  Found solve(const Group& group, const std::vector<Pushing>& pushing, Slipping slipping) const;
  Found find(const Group& group) const;
  void add(const Group& group, const Found& found, std::vector<ContactPush>& pushes);
  ContactState stateOf(const ContactFeature& feature) const;

  const World& world_;
  const std::vector<PushedBody>& bodies_;
  double time_;
  std::vector<Kinematics> kinematics_;    // and of the world's ends of joints
  std::vector<std::vector<int>> others_;  // by body: those near it, ascending, each pair once
  std::vector<ContactFeature> joints_;
  std::vector<std::vector<std::size_t>> jointsOf_;  // by body, each once
  std::vector<int> placeInGroup_;
  std::vector<char> isTold_;
};

MomentOfContacts::MomentOfContacts(const World& world, const std::vector<PushedBody>& bodies, double time)
    : world_(world),
      bodies_(bodies),
      time_(time),
      others_(bodies.size()),
      jointsOf_(bodies.size()),
      placeInGroup_(bodies.size(), ContactProblem::kNobody),
      isTold_(bodies.size(), 0) {
  for (int k = 0; k < count(); ++k) {
    const BodyState& state = at(k).state;
    kinematics_.push_back({.pose = state.pose,
                           .velocity = state.velocity,
                           .angularVelocity = angularVelocity(body(k).mass, state)});
  }
  kinematics_.emplace_back();
}

Vec3 MomentOfContacts::velocityAt(int index, const Vec3& point) const {
  const Kinematics& moves = kinematics_[static_cast<std::size_t>(index)];
  return moves.velocity + moves.angularVelocity.cross(point - moves.pose.position);
}

Vec3 MomentOfContacts::velocityOfWall(std::size_t wall, const Vec3& point) const {
  const Kinematics moves = wallMotion(world_.walls[wall], time_);
  return moves.velocityAt(point - moves.pose.position);
}

// [m] What is no farther away may push, that many times as far away as is near: now, or in the while of which
// the forces are means.
double MomentOfContacts::reachOf(int a, std::optional<int> b, double times) const {
  const auto of = [&](int index) -> const Kinematics& {
    return kinematics_[static_cast<std::size_t>(index)];
  };
  const Vec3 than = b ? of(*b).velocity : Vec3(Vec3::Zero());
  double reach = 0;
  for (const int each : {a, b.value_or(a)}) {
    reach =
        std::max(reach, times * at(each).near +
                            at(each).over * ((of(a).velocity - than).norm() +
                                             radiusOf(body(a)) * of(a).angularVelocity.norm() +
                                             (b ? radiusOf(body(*b)) * of(*b).angularVelocity.norm() : 0)));
  }
  return reach;
}

void MomentOfContacts::findPairs() {
  std::vector<int> taking;
  std::vector<double> radii;
  for (int k = 0; k < count(); ++k) {
    if (isHeld(k) || isPushed(k)) {
      taking.push_back(k);
      radii.push_back(radiusOf(body(k)) + reachOf(k, {}, kReaches.back()));
    }
  }
  Neighbors neighbors(radii);
  for (std::size_t i = 0; i < taking.size(); ++i) {
    neighbors.insert(taking[i], pose(taking[i]).position, radii[i]);
  }
  std::vector<int> candidates;
  for (const int a : taking) {
    if (!isPushed(a)) {
      continue;
    }
    neighbors.findCandidates(a, candidates);
    for (const int b : candidates) {
      const double reach = reachOf(a, b, kReaches.back());
      if ((isHeld(b) || a < b) && mayTouch(world_, a, b) &&
          (pose(a).position - pose(b).position).norm() <= radiusOf(body(a)) + radiusOf(body(b)) + reach &&
          BoxAxes(boxAt(pose(a), body(a)), boxAt(pose(b), body(b))).gap() <= reach) {
        others_[static_cast<std::size_t>(a)].push_back(b);
      }
    }
  }
}

void MomentOfContacts::findJoints() {
  joints_ = jointFeatures(world_, time_, [&](const JointEnd& end) {
    return !end.body ? count() : isHeld(*end.body) || isPushed(*end.body) ? *end.body : -1;
  });
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const ContactFeature& joint = joints_[k];
    const bool isOfA = isPushed(joint.a);
    if (isOfA || (joint.b < count() && isPushed(joint.b))) {
      jointsOf_[static_cast<std::size_t>(isOfA ? joint.a : joint.b)].push_back(k);
    }
  }
}

// Each ascending, of those that are given anything.
std::vector<MomentOfContacts::Group> MomentOfContacts::groups() {
  DisjointSets sets(bodies_.size());
  const auto join = [&](int a, int b) {
    if (a < count() && b < count() && isPushed(a) && isPushed(b)) {
      sets.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    }
  };
  for (int a = 0; a < count(); ++a) {
    for (const int b : others_[static_cast<std::size_t>(a)]) {
      join(a, b);
    }
  }
  for (const ContactFeature& joint : joints_) {
    join(joint.a, joint.b);
  }
  std::vector<Group> groups;
  std::vector<std::size_t> groupOf(bodies_.size(), bodies_.size());
  for (int k = 0; k < count(); ++k) {
    if (!isPushed(k)) {
      continue;
    }
    std::size_t& group = groupOf[sets.root(static_cast<std::size_t>(k))];
    if (group == bodies_.size()) {
      group = groups.size();
      groups.emplace_back();
    }
    placeInGroup_[static_cast<std::size_t>(k)] = static_cast<int>(groups[group].size());
    groups[group].push_back(k);
  }
  return groups;
}

void MomentOfContacts::setSlip(const Material& pair, Pushing& pushing) const {
  const Vec3& normal = pushing.frame.normal;
  const bool isAtWall = pushing.b->isWall();
  const Vec3 relative = velocityAt(pushing.a, pushing.point) -
                        (isAtWall ? velocityOfWall(pushing.b->wall(), pushing.point)
                                  : velocityAt(pushing.b->body(), pushing.point));
  const Vec3 slip = relative - dot(normal, relative) * normal - pair.surface.along(normal, pushing.point);
  const double slow = std::max(at(pushing.a).slow, isAtWall ? 0 : at(pushing.b->body()).slow);
  pushing.friction = pair.friction;
  pushing.slip = slip.norm() > slow ? slip : Vec3(Vec3::Zero());
}

void MomentOfContacts::addWalls(int a, double times, std::vector<Pushing>& pushing) const {
  const double still = reachOf(a, {}, times);
  for (std::size_t w = 0; w < world_.walls.size(); ++w) {
    const WallPlane wall = planeAt(world_.walls[w], time_);
    const double reach = still + at(a).over * velocityOfWall(w, pose(a).position).norm();
    const bool isNear = gapToPlane(boxAt(pose(a), body(a)), wall.normal, wall.offset) <= reach;
    for (int k = 0; isNear && k < body(a).cornerCount(); ++k) {
      const Vec3 point = corner(body(a), k);
      if (cornerGap(pose(a), point, wall.normal, wall.offset) <= reach) {
        pushing.push_back({.a = a,
                           .b = Partner::ofWall(w),
                           .point = pose(a).worldPoint(point),
                           .frame = frameOf(wall.normal)});
        setSlip(touching(body(a).material, world_.walls[w].material), pushing.back());
      }
    }
  }
}

void MomentOfContacts::addBoxes(int a, int b, double times, std::vector<Pushing>& pushing) const {
  const double reach = reachOf(a, b, times);
  const auto add = [&](const Vec3& point, const ContactFrame& frame) {
    const int other = isPushed(b) ? b : ContactProblem::kNobody;
    pushing.push_back({.a = a, .b = Partner::ofBody(b), .other = other, .point = point, .frame = frame});
    setSlip(touching(body(a).material, body(b).material), pushing.back());
  };
  using Touches = PushedBody::Touches;
  if (at(a).touches == Touches::kInCrowd || at(b).touches == Touches::kInCrowd) {
    const PileBody ofA = pileBody(body(a), at(a).state);
    const PileBody ofB = pileBody(body(b), at(b).state);
    for (int pair = 0; pair < ofA.partCount() * ofB.partCount(); ++pair) {
      PileManifold manifold;
      manifold.boxA = pair / ofB.partCount();
      manifold.boxB = pair % ofB.partCount();
      manifold.length = std::min(ofA.length, ofB.length);
      manifold.reach = reach;
      buildBetween(ofA, ofB, manifold);
      for (int k = 0; k < manifold.count; ++k) {
        const PilePoint& point = manifold.points[static_cast<std::size_t>(k)];
        if (point.gap <= reach) {
          add(pose(a).position + point.world, manifold.frameOf(k));
        }
      }
    }
    return;
  }
  const auto relative = [&](const Vec3& armA, const Vec3& armB) -> Vec3 {
    return velocityAt(a, pose(a).position + armA) - velocityAt(b, pose(b).position + armB);
  };
  const double slow = std::max(at(a).slow, at(b).slow);
  forBoxes(body(a), pose(a), body(b), pose(b), [&](const BoxAt& boxA, const BoxAt& boxB) {
    if (BoxAxes(boxA, boxB).gap() <= reach) {
      // One point for both, else their forces would make a torque.
      for (const ContactPoint& at : chosenContact(boxA, boxB, reach, reach, slow, relative).points) {
        add(0.5 * ((pose(a).position + at.armA) + (pose(b).position + at.armB)), frameOf(at.normal));
      }
    }
  });
}

ContactState MomentOfContacts::stateOf(const ContactFeature& feature) const {
  const auto shape = [&](int end) {
    return end == count() ? touchingBody(nowhere()).shape(0) : TouchingBody{.body = &body(end)}.shape(0);
  };
  return jointState(feature, kinematics_[static_cast<std::size_t>(feature.a)], shape(feature.a),
                    kinematics_[static_cast<std::size_t>(feature.b)], shape(feature.b));
}

void MomentOfContacts::addJoints(const Group& group, double times, std::vector<Pushing>& pushing) const {
  for (const int member : group) {
    for (const std::size_t k : jointsOf_[static_cast<std::size_t>(member)]) {
      const ContactFeature& joint = joints_[k];
      if (joint.isTwoSided() || stateOf(joint).gap <= reachOf(member, {}, times)) {
        pushing.push_back({.a = joint.a, .joint = &joint});
      }
    }
  }
}

std::vector<Pushing> MomentOfContacts::pushingOn(const Group& group, double times) const {
  std::vector<Pushing> pushing;
  for (const int a : group) {
    addWalls(a, times, pushing);
    for (const int b : others_[static_cast<std::size_t>(a)]) {
      addBoxes(a, b, times, pushing);
    }
  }
  addJoints(group, times, pushing);
  return pushing;
}

ContactProblem::Contact MomentOfContacts::contactOf(const Pushing& pushing, Slipping slipping) const {
  using Set = ContactProblem::Admissible;
  ContactProblem::Contact contact{.friction = pushing.friction};
  const auto setBody = [&](int end, std::size_t side, const RowSide& rows) {
    if (end < 0 || end >= count() || !isPushed(end)) {
      return;
    }
    (side == 0 ? contact.a : contact.b) = placeInGroup_[static_cast<std::size_t>(end)];
    setSide(contact, side, rows, body(end).mass.worldFromPrincipal(pose(end).worldFromBody));
  };
  if (pushing.joint != nullptr) {
    const ContactState state = stateOf(*pushing.joint);
    const ContactFrame frame = frameOf(state.normal);
    setBody(pushing.joint->a, 0, state.sideA(frame));
    setBody(pushing.joint->b, 1, state.sideB(frame));
    contact.admissible = pushing.joint->admissible();
    contact.least = -state.grip;
    contact.most = state.grip;
    return contact;
  }
  const std::array<Vec3, 3> axes = pushing.frame.axes();
  setBody(pushing.a, 0, pointSide(axes, pushing.point - pose(pushing.a).position, 1));
  if (pushing.other != ContactProblem::kNobody) {
    setBody(pushing.other, 1, pointSide(axes, pushing.point - pose(pushing.other).position, -1));
  }
  if (slipping == Slipping::kAgainstSlip && !pushing.slip.isZero(0)) {
    const double speed = pushing.slip.norm();
    contact.admissible = Set::kLine;
    contact.slip = {dot(pushing.frame.tangent1, pushing.slip) / speed,
                    dot(pushing.frame.tangent2, pushing.slip) / speed};
  }
  return contact;
}

Found MomentOfContacts::solve(const Group& group, const std::vector<Pushing>& pushing,
                              Slipping slipping) const {
  ContactProblem problem;
  double scale = 0;
  for (const int member : group) {
    const MassProperties& mass = body(member).mass;
    const Load& given = *at(member).given;
    const Mat3 principal = mass.worldFromPrincipal(pose(member).worldFromBody);
    const auto addThree = [](const Vec3& three, std::vector<double>& to) {
      to.insert(to.end(), three.begin(), three.end());
    };
    addThree(Vec3::Constant(mass.inverseMass), problem.inverseMass);
    addThree(mass.inverseInertiaBody, problem.inverseMass);
    addThree(-mass.inverseMass * given.force, problem.free);
    addThree(-mass.inverseInertiaBody.cwiseProduct(principal.transpose() * given.torque), problem.free);
    scale = std::max(scale, at(member).scale);
  }
  for (const Pushing& each : pushing) {
    problem.contacts.push_back(contactOf(each, slipping));
  }
  Found found{.pushing = pushing, .forces = leastForces(problem)};
  for (std::size_t k = 0; k < group.size(); ++k) {
    const MassProperties& mass = body(group[k]).mass;
    const double* const left = &found.forces.left[ContactProblem::kAxes * k];
    const Vec3 force = mass.mass * Vec3(left[0], left[1], left[2]);
    const Vec3 torque = mass.inertiaBody.cwiseProduct(Vec3(left[3], left[4], left[5]));
    found.left.push_back(force.norm() + torque.norm() / radiusOf(body(group[k])));
    found.worst = std::max(found.worst, found.left.back() / scale);
  }
  return found;
}

Found MomentOfContacts::find(const Group& group) const {
  std::optional<Found> best;
  std::size_t before = 0;
  for (const double times : kReaches) {
    const std::vector<Pushing> pushing = pushingOn(group, times);
    if (best && pushing.size() == before) {
      continue;
    }
    before = pushing.size();
    const bool anySlips =
        std::any_of(pushing.begin(), pushing.end(), [](const Pushing& each) { return !each.slip.isZero(0); });
    for (const Slipping slipping : {Slipping::kAgainstSlip, Slipping::kAnyhow}) {
      if (slipping == Slipping::kAnyhow && !anySlips) {
        continue;
      }
      Found found = solve(group, pushing, slipping);
      if (!best || found.worst < best->worst) {
        best = std::move(found);
      }
      if (best->worst <= kSuffices) {
        return *best;
      }
    }
  }
  return *best;
}

void MomentOfContacts::add(const Group& group, const Found& found, std::vector<ContactPush>& pushes) {
  const auto left = [&](int index) {
    return index < 0 ? 0.0
                     : found.left[static_cast<std::size_t>(placeInGroup_[static_cast<std::size_t>(index)])];
  };
  for (std::size_t k = 0; k < found.pushing.size(); ++k) {
    const Pushing& each = found.pushing[k];
    const Vec3 force = each.frame.inWorld(found.forces.forces[k]);
    if (each.joint != nullptr || force.isZero(0)) {
      continue;
    }
    isTold_[static_cast<std::size_t>(each.a)] = 1;
    if (each.other >= 0) {
      isTold_[static_cast<std::size_t>(each.other)] = 1;
    }
    pushes.push_back({.a = {each.a},
                      .b = each.b,
                      .point = each.point,
                      .normal = each.frame.normal,
                      .force = force,
                      .left = std::max(left(each.a), left(each.other))});
  }
  for (const int member : group) {
    if (isTold_[static_cast<std::size_t>(member)] == 0 && left(member) > kSuffices * at(member).scale) {
      pushes.push_back({.a = {member}, .point = pose(member).position, .left = left(member)});
    }
  }
}

std::vector<ContactPush> MomentOfContacts::pushes() {
  findPairs();
  findJoints();
  std::vector<ContactPush> pushes;
  for (const Group& group : groups()) {
    if (std::any_of(group.begin(), group.end(), [&](int member) { return at(member).scale > 0; })) {
      add(group, find(group), pushes);
    }
  }
  std::stable_sort(pushes.begin(), pushes.end(),
                   [](const ContactPush& x, const ContactPush& y) { return x.a.value < y.a.value; });
  return pushes;
}

}  // namespace

std::vector<ContactPush> contactPushes(const World& world, const std::vector<PushedBody>& bodies,
                                       double time) {
  return MomentOfContacts(world, bodies, time).pushes();
}

}  // namespace careen
