#include "physics/contact/contact_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact/three_at.h"
#include "physics/geometry/contact_frame.h"
#include "physics/geometry/separation.h"
#include "physics/solver/contact_rows.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

constexpr std::size_t kHeld = std::numeric_limits<std::size_t>::max();
/// [1] of the speed after falling a half diagonal: rounding error of a body at rest.
constexpr double kRestSpeed = 0x1p-44;
/// [1] Gaps and rates this small relative to their lengths and speeds need no projection.
constexpr double kProjected = 0x1p-51;
constexpr double kProjectedSpeed = 0x1p-46;
constexpr int kMostProjections = 4;

// In which a contact is closed without friction; a grip has no place to close at.
ContactForces::Mode closedMode(const ContactFeature& feature) {
  using Mode = ContactForces::Mode;
  return feature.holds() ? Mode::kStick : feature.grips() ? Mode::kOff : Mode::kOn;
}

// [s] When they are there.
double timeOf(std::span<const TouchingBody> bodies) {
  const auto driven =
      std::find_if(bodies.begin(), bodies.end(), [](const TouchingBody& body) { return body.isDriven(); });
  return driven != bodies.end() ? driven->time : bodies.empty() ? 0 : bodies.front().time;
}

}  // namespace

ContactSystem::ContactSystem(const World& world, std::vector<TouchingBody> bodies,
                             std::vector<ContactFeature> features, std::span<const ContactFeature> joints)
    : world_(&world),
      bodies_(std::move(bodies)),
      features_(std::move(features)),
      modes_(features_.size(), Mode::kOff),
      onset_(features_.size(), Vec3::Zero()),
      kinematics_(bodies_.size()),
      states_(features_.size()),
      pushing_(features_.size()),
      time_(timeOf(bodies_)),
      hasTime_(isGravitySloping(world)),
      isCarried_(hasTime_) {
  pull_ = std::max(gravityScale(world), drivenAcceleration(bodies_));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const TouchingBody& each = bodies_[i];
    places_.push_back(each.isHeld() ? kHeld : movers_.size());
    hasTime_ = hasTime_ || each.isDriven();
    isCarried_ = isCarried_ ||
                 (each.isDriven() && (each.isBox() || std::any_of(features_.begin(), features_.end(),
                                                                  [&](const ContactFeature& feature) {
                                                                    return feature.b == static_cast<int>(i);
                                                                  })));
    kinematics_[i].pose = {each.position, each.worldFromBody.toRotationMatrix()};
    if (!each.isHeld()) {
      movers_.push_back(i);
      radius_ = std::max(radius_, radiusOf(*each.body));
      const MassProperties& mass = each.body->mass;
      inverseMass_.insert(inverseMass_.end(), 3, mass.inverseMass);
      for (int k = 0; k < 3; ++k) {
        inverseMass_.push_back(mass.inverseInertiaBody[k]);
      }
    }
  }
  for (const ContactFeature& joint : joints) {
    if (!joint.holds() &&
        std::none_of(features_.begin(), features_.end(),
                     [&](const ContactFeature& feature) { return isSame(feature, joint); })) {
      openEnds_.push_back(joint);
    }
  }
  free_.resize(inverseMass_.size());
  forces_.setBodies(inverseMass_);
  forces_.contacts().resize(features_.size());
  if (hasVaryingLoads(world)) {
    for (const Body& body : world.bodies) {
      worldStates_.push_back(body.initial);
    }
    for (const std::size_t i : movers_) {
      worldStates_[static_cast<std::size_t>(bodies_[i].index)] = bodies_[i].state();
    }
    const std::vector<double> all = pulls(world, worldStates_);
    for (const std::size_t i : movers_) {
      pull_ = std::max(pull_, all[static_cast<std::size_t>(bodies_[i].index)]);
    }
  }
  restSpeed_ = kRestSpeed * std::sqrt(pull_ * radius_);
}

bool ContactSystem::pushes() const {
  return std::any_of(modes_.begin(), modes_.end(), [](Mode mode) { return mode != Mode::kOff; });
}

void ContactSystem::closeAll() {
  for (std::size_t c = 0; c < modes_.size(); ++c) {
    modes_[c] = closedMode(features_[c]);
  }
}

ContactState ContactSystem::stateOf(const ContactFeature& feature) const {
  const auto a = static_cast<std::size_t>(feature.a);
  const auto b = static_cast<std::size_t>(feature.b);
  return contactState(feature, kinematics_[a], bodies_[a].shape(feature.boxA), kinematics_[b],
                      bodies_[b].shape(feature.boxB));
}

double ContactSystem::touching(std::size_t body) const {
  return touchingWithin(boxAt(kinematics_[body].pose, *bodies_[body].body));
}

std::vector<double> ContactSystem::pack() const {
  std::vector<double> y(movers_.size() * kNumbers);
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const TouchingBody& body = bodies_[movers_[m]];
    setThree(y, m * kNumbers, body.position);
    setQuat(y, m * kNumbers + 3, body.worldFromBody);
    setThree(y, m * kNumbers + 7, body.velocity);
    setThree(y, m * kNumbers + 10, body.angularVelocityBody);
  }
  if (hasTime_) {
    y.push_back(timeOf(bodies_));
  }
  return y;
}

void ContactSystem::unpack(std::span<const double> y) {
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    TouchingBody& body = bodies_[movers_[m]];
    body.position = threeAt(y, m * kNumbers);
    body.worldFromBody = quatAt(y, m * kNumbers + 3).normalized();
    body.velocity = threeAt(y, m * kNumbers + 7);
    body.angularVelocityBody = threeAt(y, m * kNumbers + 10);
  }
  for (TouchingBody& body : bodies_) {
    if (body.isDriven()) {
      body = drivenAt(body, y.back());
    }
    body.time = hasTime_ ? y.back() : body.time;
  }
}

void ContactSystem::look(std::span<const double> y) {
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    Kinematics& at = kinematics_[movers_[m]];
    at.pose.position = threeAt(y, m * kNumbers);
    at.pose.worldFromBody = quatAt(y, m * kNumbers + 3).normalized().toRotationMatrix();
    at.velocity = threeAt(y, m * kNumbers + 7);
    at.angularVelocity = at.pose.worldFromBody * threeAt(y, m * kNumbers + 10);
  }
  time_ = hasTime_ ? y.back() : time_;
  for (std::size_t i = 0; hasTime_ && i < bodies_.size(); ++i) {
    if (bodies_[i].isDriven()) {
      kinematics_[i] = bodies_[i].drivenBy->at(time_);
    }
  }
  for (std::size_t c = 0; c < features_.size(); ++c) {
    pushing_[c] = pushes(c) ? 1 : 0;
    states_[c] = stateOf(features_[c]);
  }
  normals_.align(features_, pushing_, states_);
}

// Jacobian rows and targets of every contact, from the last look(). Rows of rotation are along the bodies'
// principal axes, where the mass matrix is diagonal.
void ContactSystem::fillContacts() {
  for (std::size_t c = 0; c < features_.size(); ++c) {
    const ContactFeature& feature = features_[c];
    const ContactState& state = states_[c];
    ContactForces::Contact& contact = forces_.contacts()[c];
    const ContactFrame frame = frameOf(state.normal);
    const auto a = static_cast<std::size_t>(feature.a);
    const auto addSide = [&](std::size_t body, std::size_t side) {
      if (places_[body] == kHeld) {
        return ContactForces::kNobody;
      }
      setSide(contact, side, side == 0 ? state.sideA(frame) : state.sideB(frame),
              bodies_[body].body->mass.worldFromPrincipal(kinematics_[body].pose.worldFromBody));
      return static_cast<int>(places_[body]);
    };
    contact.a = addSide(a, 0);
    contact.b = addSide(static_cast<std::size_t>(feature.b), 1);
    contact.friction = feature.material.friction;
    if (state.rows) {
      contact.target = {-state.rows->biases[0], -state.rows->biases[1], -state.rows->biases[2]};
      contact.admissible = feature.admissible();
      const bool isGiven = feature.grips() && modes_[c] == Mode::kSlip;
      contact.least = isGiven ? -sideOf(c) * state.grip : -state.grip;
      contact.most = isGiven ? contact.least : state.grip;
      continue;
    }
    contact.target = {-state.gapBias, -dot(state.slipBias, frame.tangent1),
                      -dot(state.slipBias, frame.tangent2)};
    const double speed = state.slip.norm();
    const bool slips = speed > restSpeed_;
    contact.admissible = slips ? ContactProblem::Admissible::kLine : ContactProblem::Admissible::kCone;
    contact.directions.clear();
    for (const Vec3& direction : state.directions) {
      if (dot(direction, state.velocity()) >= -restSpeed_) {  // those that are approached part nothing
        contact.directions.push_back(frame.along(direction));
      }
    }
    const Vec3 direction = slips ? Vec3(state.slip / speed) : onset_[c];
    contact.slip = {dot(direction, frame.tangent1), dot(direction, frame.tangent2)};
  }
}

// Accelerations without contact forces.
void ContactSystem::findFree() {
  std::vector<Load> loads;
  const Vec3 gravity = gravityNow(*world_, time_);
  if (!worldStates_.empty()) {
    for (const std::size_t i : movers_) {
      TouchingBody at = bodies_[i];
      at.velocity = kinematics_[i].velocity;
      const Mat3& columns = kinematics_[i].pose.worldFromBody;
      worldStates_[static_cast<std::size_t>(at.index)] = {
          .pose = kinematics_[i].pose,
          .velocity = kinematics_[i].velocity,
          .angularMomentum = careen::angularMomentum(at.body->mass, columns, kinematics_[i].angularVelocity)};
    }
    computeLoads(*world_, gravity, worldStates_, loads);
  }
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const std::size_t i = movers_[m];
    const MassProperties& mass = bodies_[i].body->mass;
    const Mat3 columns = mass.worldFromPrincipal(kinematics_[i].pose.worldFromBody);
    const Vec3 spin = columns.transpose() * kinematics_[i].angularVelocity;
    Vec3 linear = gravity;
    Vec3 torque = mass.inertiaBody.cwiseProduct(spin).cross(spin);
    if (!loads.empty()) {
      const Load& load = loads[static_cast<std::size_t>(bodies_[i].index)];
      linear = mass.inverseMass * load.force;
      torque += columns.transpose() * load.torque;
    }
    setThree(free_, m * kSix, linear);
    setThree(free_, m * kSix + 3, mass.inverseInertiaBody.cwiseProduct(torque));
  }
}

// The rotational part of a solution, body frame.
Vec3 ContactSystem::angularOf(std::span<const double> solution, std::size_t mover) const {
  return bodies_[movers_[mover]].body->mass.fromPrincipal(threeAt(solution, mover * kSix + 3));
}

bool ContactSystem::findModes(std::span<const double> y) {
  look(y);
  guess_.resize(features_.size());
  for (std::size_t c = 0; c < features_.size(); ++c) {
    if (features_[c].grips()) {
      modes_[c] = std::fabs(states_[c].rate) > stillRate(c) ? Mode::kSlip : Mode::kStick;
      guess_[c][0] = -states_[c].rate;
    }
  }
  fillContacts();
  findFree();
  const bool found = forces_.findModes(free_, modes_);
  guess_.assign(forces_.forces().begin(), forces_.forces().end());
  guessedFriction_.resize(features_.size());
  for (std::size_t c = 0; c < features_.size(); ++c) {
    if (states_[c].rows) {
      continue;  // theirs do not jump
    }
    const ContactFrame frame = frameOf(states_[c].normal);
    guessedFriction_[c] = frame.across(guess_[c][1], guess_[c][2]);
    if (modes_[c] == Mode::kSlip) {
      const auto& slip = forces_.contacts()[c].slip;
      onset_[c] = frame.across(slip[0], slip[1]);
    }
  }
  return found;
}

bool ContactSystem::rate(std::span<const double> y, std::vector<double>& dy) {
  look(y);
  fillContacts();
  findFree();
  for (std::size_t c = 0; c < guess_.size(); ++c) {
    if (states_[c].rows) {
      continue;
    }
    const ContactFrame frame = frameOf(states_[c].normal);
    guess_[c][1] = dot(guessedFriction_[c], frame.tangent1);
    guess_[c][2] = dot(guessedFriction_[c], frame.tangent2);
  }
  const bool found = forces_.solveGiven(free_, modes_, guess_);
  dy.resize(y.size());
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const std::size_t at = m * kNumbers;
    const Quat q = quatAt(y, at + 3);
    const Vec3 w = threeAt(y, at + 10);
    const Quat turning = q * Quat(0, w[0], w[1], w[2]);
    setThree(dy, at, threeAt(y, at + 7));
    setQuat(dy, at + 3, Quat(0.5 * turning.w(), 0.5 * turning.x(), 0.5 * turning.y(), 0.5 * turning.z()));
    setThree(dy, at + 7, threeAt(forces_.accelerations(), m * kSix));
    setThree(dy, at + 10, angularOf(forces_.accelerations(), m));
  }
  if (hasTime_) {
    dy.back() = 1;
  }
  return found;
}

// Where two edges or corners stick to each other they also stay together sideways: an offset would make the
// contact one of an edge on a face.
bool ContactSystem::holdsSideways(std::size_t contact) const {
  return modes_[contact] == Mode::kStick && features_[contact].kind == ContactFeature::Kind::kInCone;
}

// [m] The three coordinates of a contact that projection makes zero.
Vec3 ContactSystem::gapsOf(std::size_t contact) const {
  const ContactState& state = states_[contact];
  if (state.rows) {
    return features_[contact].holds() ? state.rows->gaps : Vec3(state.gap, 0, 0);
  }
  if (!holdsSideways(contact)) {
    return {state.gap, 0, 0};
  }
  const ContactFrame frame = frameOf(state.normal);
  return {state.gap, dot(state.offset, frame.tangent1), dot(state.offset, frame.tangent2)};
}

// [m] How far a displacement of all bodies moves one of them, its corners included.
double ContactSystem::shiftOf(std::span<const double> displacement) const {
  double most = 0;
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const double radius = radiusOf(*bodies_[movers_[m]].body);
    most = std::max(
        most, threeAt(displacement, m * kSix).norm() + radius * threeAt(displacement, m * kSix + 3).norm());
  }
  return most;
}

BodyState ContactSystem::stateIn(std::span<const double> y, std::size_t body) const {
  const std::size_t at = places_[body] * kNumbers;
  const Mat3 turned = quatAt(y, at + 3).normalized().toRotationMatrix();
  return {.pose = {threeAt(y, at), turned},
          .velocity = threeAt(y, at + 7),
          .angularMomentum = turned * bodies_[body].body->mass.inertiaTimes(threeAt(y, at + 10))};
}

bool ContactSystem::keepMomenta(std::span<const double> before, double h, std::vector<double>& y) const {
  std::vector<ContactFeature> pushing;
  for (std::size_t c = 0; c < features_.size(); ++c) {
    if (pushes(c)) {
      pushing.push_back(features_[c]);
    }
  }
  const auto changes = changesToKeep(
      *world_, bodies_, pushing, hasTime_ ? before.back() : 0, h,
      [&](std::size_t i) { return stateIn(before, i); }, [&](std::size_t i) { return stateIn(y, i); });
  for (const auto& [i, change] : changes) {
    const BodyState state = stateIn(y, i);
    const std::size_t at = places_[i] * kNumbers;
    setThree(y, at, state.pose.position + change.shift);
    setThree(y, at + 7, state.velocity + change.velocityAt(state.pose.position));
    setThree(y, at + 10, threeAt(y, at + 10) + state.pose.worldFromBody.transpose() * change.turning);
  }
  return !changes.empty();
}

double ContactSystem::projectPositions(std::vector<double>& y, double most, Turns turns) {
  const std::vector<double> before = y;
  const std::vector<Mode> kept = modes_;
  for (std::size_t c = 0; c < modes_.size(); ++c) {
    modes_[c] = modes_[c] == Mode::kOff || holdsSideways(c) ? modes_[c] : closedMode(features_[c]);
  }
  const std::vector<double> still(inverseMass_.size(), 0.0);
  double moved = 0;
  for (int pass = 0; pass < kMostProjections; ++pass) {
    look(y);
    double worst = 0;
    double deepest = 0;  // [m]
    for (std::size_t c = 0; c < features_.size(); ++c) {
      if (modes_[c] != Mode::kOff) {
        const auto a = static_cast<std::size_t>(features_[c].a);
        const double lengths = kinematics_[a].pose.position.cwiseAbs().sum() + states_[c].armA.norm();
        const double sideways = holdsSideways(c) ? states_[c].offset.norm() : 0;
        deepest = std::max({deepest, std::fabs(states_[c].gap), sideways});
        worst = std::max(worst, std::max(std::fabs(states_[c].gap), sideways) / lengths);
      }
    }
    if (worst <= kProjected) {
      break;
    }
    fillContacts();
    for (std::size_t c = 0; c < features_.size(); ++c) {
      const Vec3 gaps = gapsOf(c);
      forces_.contacts()[c].target = {-gaps[0], -gaps[1], -gaps[2]};
    }
    forces_.solveGiven(still, modes_);
    const double shift = shiftOf(forces_.accelerations());
    if (shift > kMostShift * deepest || moved + shift > most) {
      break;
    }
    moved += shift;
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      const std::size_t at = m * kNumbers;
      setThree(y, at, threeAt(y, at) + threeAt(forces_.accelerations(), m * kSix));
      const Vec3 half = 0.5 * angularOf(forces_.accelerations(), m);
      const Quat turn = Quat(1, half[0], half[1], half[2]).normalized();
      setQuat(y, at + 3, (quatAt(y, at + 3) * turn).normalized());
      if (turns == Turns::kAttitude) {
        const MassProperties& mass = bodies_[movers_[m]].body->mass;
        setThree(y, at + 10,
                 mass.inverseInertiaTimes(turn.conjugate() * mass.inertiaTimes(threeAt(y, at + 10))));
      }
    }
  }
  if (moved > 0) {
    keepMomenta(before, 0, y);
  }
  modes_ = kept;
  return moved;
}

bool ContactSystem::projectVelocities(std::vector<double>& y) {
  const std::vector<double> unprojected = y;
  look(y);
  std::vector<Mode> kept = modes_;
  double worst = 0;
  double scale = 0;
  for (std::size_t c = 0; c < features_.size(); ++c) {
    if (modes_[c] == Mode::kOff || (features_[c].grips() && modes_[c] != Mode::kStick)) {
      modes_[c] = Mode::kOff;
      continue;
    }
    const auto a = static_cast<std::size_t>(features_[c].a);
    scale = std::max(scale, kinematics_[a].velocity.norm() +
                                kinematics_[a].angularVelocity.norm() * states_[c].armA.norm());
    worst = std::max(worst, std::fabs(states_[c].rate));
    if (modes_[c] == Mode::kStick) {
      worst = std::max(worst, states_[c].slip.norm());
    } else {
      modes_[c] = Mode::kOn;
    }
  }
  bool moves = worst > kProjectedSpeed * scale;
  if (moves) {
    fillContacts();
    for (std::size_t c = 0; c < features_.size(); ++c) {
      ContactForces::Contact& contact = forces_.contacts()[c];
      contact.target = states_[c].target(frameOf(states_[c].normal));
      if (contact.admissible == ContactProblem::Admissible::kLine) {
        contact.admissible = ContactProblem::Admissible::kCone;
      }
    }
    std::vector<double> before(inverseMass_.size());
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      setThree(before, m * kSix, threeAt(y, m * kNumbers + 7));
      setThree(before, m * kSix + 3,
               bodies_[movers_[m]].body->mass.toPrincipal(threeAt(y, m * kNumbers + 10)));
    }
    forces_.solveGiven(before, modes_);
    std::vector<double> change(forces_.accelerations().begin(), forces_.accelerations().end());
    for (std::size_t k = 0; k < change.size(); ++k) {
      change[k] -= before[k];
    }
    moves = shiftOf(change) <= kMostShift * worst;
    for (std::size_t m = 0; moves && m < movers_.size(); ++m) {
      setThree(y, m * kNumbers + 7, threeAt(forces_.accelerations(), m * kSix));
      setThree(y, m * kNumbers + 10, angularOf(forces_.accelerations(), m));
    }
  }
  if (moves) {
    keepMomenta(unprojected, 0, y);
  }
  modes_ = std::move(kept);
  return moves;
}

bool ContactSystem::project(std::vector<double>& y, double most) {
  const bool moved = projectPositions(y, most) > 0;
  return projectVelocities(y) || moved;
}

}  // namespace careen
