#include "physics/pile/crowd_articulations.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "physics/contact/joint_rows.h"
#include "physics/pile/crowd_motion.h"

namespace careen {
namespace {

/// [1] of the tolerance: what is closed.
constexpr double kClosed = 0x1p-12;
constexpr int kClosings = 4;
constexpr int kMostClosingFactorisations = 60;
/// Of ropes and limits that act in a step: so many tolerances and times the way of the fastest.
constexpr double kNearEnd = 4;

Vec3 gapsOf(const ContactState& state) { return state.rows ? state.rows->gaps : Vec3(state.gap, 0, 0); }
Vec3 ratesOf(const ContactState& state) { return state.rows ? state.rows->rates : Vec3(state.rate, 0, 0); }
Vec3 biasesOf(const ContactState& state) {
  return state.rows ? state.rows->biases : Vec3(state.gapBias, 0, 0);
}
ContactProblem::Triple tripleOf(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

void CrowdArticulations::list(double time) {
  const std::vector<Condition> before = std::exchange(conditions_, {});
  joints_.clear();
  if (members_.world.joints.empty()) {
    return;
  }
  for (const Condition& each : before) {
    if (each.feature.joint->until <= time) {
      letGo(each);
    }
  }
  const std::vector<Body>& bodies = members_.world.bodies;
  std::unordered_map<std::size_t, int> places;  // not by all bodies of the world: there may be many crowds
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].isBox() && !members_[i].absent) {
      places[members_.listed[i]] = static_cast<int>(i);
    }
  }
  const auto placeOf = [&](const JointEnd& end) {
    const int listed = end.body.value_or(static_cast<int>(bodies.size()));
    const auto member = places.find(at(listed));
    return member != places.end()                              ? member->second
           : !end.body || isImmovable(bodies[at(listed)].mass) ? kOutside + listed
                                                               : -1;
  };
  isJoined_.assign(members_.size(), 0);
  mayChange_.assign(members_.size(), 0);
  for (const ContactFeature& feature : jointFeatures(members_.world, time, placeOf)) {
    if (feature.a >= kOutside && feature.b >= kOutside) {
      continue;
    }
    const std::size_t k = conditions_.size();
    Condition& added = conditions_.emplace_back(Condition{.feature = feature});
    if (k < before.size() && before[k].feature.joint == feature.joint &&
        before[k].feature.part == feature.part) {
      added.kept = before[k].kept;
    }
    if (joints_.empty() || joints_.back().joint != feature.joint) {
      joints_.push_back(
          {.joint = feature.joint, .a = feature.a, .b = feature.b, .effort = feature.joint->drive()});
    }
    const bool changes = mayStillChange(members_.world, *feature.joint);
    for (const int place : {feature.a, feature.b}) {
      if (place < kOutside) {
        isJoined_[at(place)] = 1;
        mayChange_[at(place)] = changes ? 1 : mayChange_[at(place)];
      }
    }
  }
}

void CrowdArticulations::letGo(const Condition& condition) {
  const ContactFrame frame = frameOf(condition.state.normal);
  const auto give = [&](int place, const RowSide& side) {
    if (moves(place) && span_ > 0) {
      PileBody& body = members_[place];
      const double part = body.behind / span_;
      const BodyImpulse impulse = impulseOf(side, condition.kept);
      body.velocity += part * body.inverseMass * impulse.push;
      body.angularMomentum += part * impulse.twist;
      deriveOmega(body);
    }
  };
  give(condition.feature.a, condition.state.sideA(frame));
  give(condition.feature.b, condition.state.sideB(frame));
}

bool CrowdArticulations::moves(int place) const { return place < kOutside && !members_[place].still(); }

Pose CrowdArticulations::poseOf(int place) const {
  if (place < kOutside) {
    return {.position = members_[place].position, .worldFromBody = members_[place].axes};
  }
  const std::size_t listed = at(place - kOutside);
  return listed < members_.world.bodies.size() ? members_.world.bodies[listed].initial.pose : Pose{};
}

Kinematics CrowdArticulations::motionOf(int place, const PileSolver* solver) const {
  Kinematics motion{.pose = poseOf(place)};
  if (moves(place)) {
    motion.velocity = solver == nullptr ? members_[place].velocity : solver->velocity(place);
    motion.angularVelocity = solver == nullptr ? members_[place].omega : solver->omega(place);
  }
  return motion;
}

TouchingShape CrowdArticulations::shapeOf(const JointEnd& end) const {
  static const Vec3 none = Vec3::Zero();
  if (!end.body) {
    return {.halfExtents = none, .center = none, .halfSpace = &nowhere()};
  }
  const Body& body = members_.world.bodies[at(*end.body)];
  return {.halfExtents = body.halfExtents, .center = body.boxCenter};
}

// At the places of now, and the velocities of the solver, or of now.
void CrowdArticulations::lookAt(Condition& condition, const PileSolver* solver) const {
  const ContactFeature& feature = condition.feature;
  const Joint& joint = *feature.joint;
  condition.state = jointState(feature, motionOf(feature.a, solver), shapeOf(joint.from),
                               motionOf(feature.b, solver), shapeOf(joint.to));
  condition.acts = moves(feature.a) || moves(feature.b);
}

void CrowdArticulations::aimAtEnd(PileSolver& solver) {
  if (!any()) {
    return;
  }
  double fastest = 0;  // [m/s]
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const int place = static_cast<int>(i);
    if (!members_[i].still()) {
      fastest =
          std::max(fastest, solver.velocity(place).norm() + members_[i].radius * solver.omega(place).norm());
    }
  }
  const double near = kNearEnd * (members_.tolerance + members_.h * fastest);
  const double scale = span_ > 0 ? members_.span / span_ : 0;
  for (Condition& condition : conditions_) {
    lookAt(condition, &solver);
    condition.acts = condition.acts && (condition.feature.isTwoSided() || condition.state.gap <= near);
    condition.target = tripleOf(-gapsOf(condition.state) / members_.h);
    condition.target[0] += condition.state.kept;
    condition.impulse = {};
    if (!condition.acts) {
      continue;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      condition.impulse[d] = scale * condition.kept[d];
    }
    const ContactFrame frame = frameOf(condition.state.normal);
    const auto give = [&](int place, const RowSide& side) {
      if (moves(place)) {
        const BodyImpulse impulse = impulseOf(side, condition.impulse);
        solver.give(place, impulse.push, impulse.twist);
      }
    };
    give(condition.feature.a, condition.state.sideA(frame));
    give(condition.feature.b, condition.state.sideB(frame));
  }
}

// [m/s²] Of the coordinates, of bodies that turn freely.
Vec3 CrowdArticulations::secondOrder(const Condition& condition, const PileSolver& solver) const {
  Vec3 second = biasesOf(condition.state);
  const ContactFrame frame = frameOf(condition.state.normal);
  const auto add = [&](int place, const RowSide& side) {
    if (moves(place)) {
      const Vec3 spinRate = freeSpinRate(members_[place], solver.omega(place));
      for (std::size_t d = 0; d < 3; ++d) {
        second[static_cast<Eigen::Index>(d)] += dot(side.turning[d], spinRate);
      }
    }
  };
  add(condition.feature.a, condition.state.sideA(frame));
  add(condition.feature.b, condition.state.sideB(frame));
  return second;
}

void CrowdArticulations::bend(const PileSolver& solver) {
  for (Condition& condition : conditions_) {
    if (condition.acts && !condition.feature.grips()) {
      lookAt(condition, &solver);
      condition.target =
          tripleOf(-gapsOf(condition.state) / members_.h - 0.5 * members_.h * secondOrder(condition, solver));
      condition.target = condition.feature.holds() ? condition.target : Triple{condition.target[0], 0, 0};
    }
  }
}

void CrowdArticulations::keep() {
  for (Condition& condition : conditions_) {
    condition.kept = condition.impulse;
  }
  span_ = members_.span;
}

// Ropes and limits that are closed by now do not go on beyond.
void CrowdArticulations::keepRates() {
  for (Condition& condition : conditions_) {
    lookAt(condition, nullptr);
    condition.impulse = {};
    condition.target = tripleOf(ratesOf(condition.state));
    if (condition.feature.grips()) {  // no force has an impulse at one moment
      condition.acts = false;
    } else if (!condition.feature.holds()) {
      condition.acts = condition.acts && condition.state.gap <= kNearEnd * members_.tolerance;
      condition.target = {std::min(0.0, condition.target[0]), 0, 0};
    }
  }
}

// With what its bodies begin with, unless they are in the problem.
template <class VelocityOf, class OmegaOf>
void CrowdArticulations::add(const Condition& condition, const Triple& target, const Triple& impulse,
                             CrowdProblem& problem, const VelocityOf& velocityOf,
                             const OmegaOf& omegaOf) const {
  const auto include = [&](int place) {
    return place >= kOutside ? ContactProblem::kNobody
                             : problem.include(place, velocityOf(place), omegaOf(place));
  };
  const ContactFrame frame = frameOf(condition.state.normal);
  problem.add({.a = include(condition.feature.a),
               .b = include(condition.feature.b),
               .target = target,
               .admissible = condition.feature.admissible(),
               .least = -members_.span * condition.state.grip,
               .most = members_.span * condition.state.grip},
              condition.state.sideA(frame), condition.state.sideB(frame), impulse);
}

void CrowdArticulations::addTo(CrowdProblem& problem, const PileSolver& solver) const {
  for (const Condition& condition : conditions_) {
    if (condition.acts) {
      add(
          condition, condition.target, condition.impulse, problem,
          [&](int place) { return solver.velocity(place); }, [&](int place) { return solver.omega(place); });
    }
  }
}

void CrowdArticulations::take(std::span<const Triple> impulses) {
  std::size_t next = 0;
  for (Condition& condition : conditions_) {
    if (condition.acts) {
      condition.impulse = impulses[next++];
    }
  }
}

// [m] Of all that holds; of ropes and limits how far they are beyond.
double CrowdArticulations::mostOpen() const {
  double most = 0;
  for (const Condition& condition : conditions_) {
    most = std::max(most, !condition.acts             ? 0
                          : condition.feature.holds() ? gapsOf(condition.state).norm()
                                                      : -condition.state.gap);
  }
  return most;
}

bool CrowdArticulations::closes(const Condition& condition) const {
  return condition.acts && !condition.feature.grips() &&
         (condition.feature.holds() || condition.state.gap <= kNearEnd * members_.tolerance);
}

bool CrowdArticulations::close(const AddConditions& addMore) {
  if (!this->any()) {
    return false;
  }
  closedBy_.assign(members_.size(), 0);
  const auto nothing = [](int /*place*/) { return Vec3(Vec3::Zero()); };
  bool any = false;
  for (int closing = 0; closing <= kClosings; ++closing) {
    for (Condition& condition : conditions_) {
      lookAt(condition, nullptr);
    }
    if (mostOpen() <= kClosed * members_.tolerance || closing == kClosings) {
      break;
    }
    close_.begin();
    for (const Condition& condition : conditions_) {
      if (closes(condition)) {
        add(condition, tripleOf(-gapsOf(condition.state)), {}, close_, nothing, nothing);
      }
    }
    if (addMore) {
      addMore(close_);
    }
    if (!close_.solve(closer_, 0.5 * kClosed * members_.tolerance, kMostClosingFactorisations)) {
      break;
    }
    displace();
    any = true;
  }
  return any;
}

void CrowdArticulations::displace() {
  for (std::size_t m = 0; m < close_.movers().size(); ++m) {
    const int place = close_.movers()[m];
    PileBody& body = members_[place];
    const Vec3 shift = close_.velocity(m);
    const Vec3 turn = close_.omega(m);
    const double turned = body.radius * turn.norm();
    body.position += shift;
    turnBy(body, turn);
    body.path += shift.norm() + turned;
    body.turned += turned;
    closedBy_[at(place)] += shift.norm() + turned;
  }
}

}  // namespace careen
