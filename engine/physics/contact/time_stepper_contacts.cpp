#include <algorithm>
#include <cmath>
#include <utility>

#include "core/disjoint_sets.h"
#include "physics/contact/time_stepper.h"
#include "physics/geometry/chosen_contact.h"
#include "physics/geometry/separation.h"

// Contacts of a time step: which there are, which obey their law; impacts at its start.

namespace careen {
namespace {

/// [1] of a closed gap: how far a contact may open within a step and still obey its law.
constexpr double kOpens = 0x1p-4;
/// [1] of a closed gap: hops no higher are not followed.
constexpr double kHop = 0x1p-4;
/// [1] of the residual to which impulses are solved: approach no faster is none.
constexpr double kResiduals = 4;
constexpr int kMostRounds = 8;

}  // namespace

bool TimeStepper::isSame(const ContactFeature& x, const ContactFeature& y) {
  return x.kind == y.kind && x.a == y.a && x.b == y.b && x.axisA == y.axisA && x.axisB == y.axisB &&
         x.sign == y.sign && (x.onA - y.onA).isZero(1e-9 * x.onA.norm()) &&
         (x.onB - y.onB).isZero(1e-9 * x.onB.norm());
}

BoxAt TimeStepper::boxOf(std::size_t body) const { return boxAt(poses_[body], *bodies_[body].body); }

Material TimeStepper::materialOf(const ContactFeature& feature) const {
  const Material& ofA = bodies_[static_cast<std::size_t>(feature.a)].body->material;
  return careen::touching(ofA, feature.b.isWall()
                                   ? world_.walls[feature.b.wall()].material
                                   : bodies_[static_cast<std::size_t>(feature.b.body())].body->material);
}

bool TimeStepper::near(const GroupState& at, std::size_t a, std::size_t b, double within) const {
  const double reach = radiusOf(*bodies_[a].body) + radiusOf(*bodies_[b].body) + within;
  return (at[a].position - at[b].position).squaredNorm() <= reach * reach;
}

void TimeStepper::addWallContacts(std::size_t body) {
  for (std::size_t w = 0; w < world_.walls.size(); ++w) {
    const Wall& wall = world_.walls[w];
    if (gapToPlane(boxOf(body), wall.normal, wall.offset) > closed()) {
      continue;
    }
    for (int k = 0; k < kCorners; ++k) {
      ContactFeature feature{
          .a = static_cast<int>(body), .b = Partner::ofWall(w), .onA = corner(*bodies_[body].body, k)};
      if (cornerGap(poses_[body], feature.onA, wall.normal, wall.offset) <= closed()) {
        feature.material = materialOf(feature);
        found_.push_back({.feature = feature});
      }
    }
  }
}

void TimeStepper::addPairContacts(const GroupState& at, std::size_t a, std::size_t b) {
  if (BoxAxes(boxOf(a), boxOf(b)).gap() > closed()) {
    return;
  }
  const Kinematics ofA = equations_.kinematics(a, at[a]);
  const Kinematics ofB = equations_.kinematics(b, at[b]);
  const ChosenContact contact = chosenContact(boxOf(a), boxOf(b), closed(), closed(), equations_.residual(),
                                              [&](const Vec3& armA, const Vec3& armB) {
                                                return Vec3((ofA.velocity + ofA.angularVelocity.cross(armA)) -
                                                            (ofB.velocity + ofB.angularVelocity.cross(armB)));
                                              });
  for (const ContactPoint& point : contact.points) {
    ContactFeature feature =
        featureAt(point, closed(), static_cast<int>(a), boxOf(a), static_cast<int>(b), boxOf(b));
    feature.material = materialOf(feature);
    feature.axes = feature.a == static_cast<int>(a) ? contact.choice : swapped(contact.choice);
    found_.push_back({.feature = feature});
  }
}

// All contact features with a gap that counts as none.
void TimeStepper::findContacts(const GroupState& at) {
  found_.clear();
  poses_.clear();
  for (const GroupBody& body : at) {
    poses_.push_back({body.position, body.worldFromBody.toRotationMatrix()});
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      addWallContacts(i);
    }
    for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
      if (!(bodies_[i].isHeld() && bodies_[j].isHeld()) && near(at, i, j, closed())) {
        addPairContacts(at, i, j);
      }
    }
  }
  lookAgain(at);
}

void TimeStepper::lookAgain(const GroupState& at) {
  features_.clear();
  for (const Found& found : found_) {
    features_.push_back(found.feature);
  }
  equations_.contactsAt(features_, at, states_);
  for (std::size_t c = 0; c < found_.size(); ++c) {
    found_[c].gap = states_[c].gap;
    found_[c].rate = states_[c].parting();
    found_[c].passing = states_[c].passing();
  }
}

// Contacts that obey their law in a step of length h. One that parts so fast that it would open within the
// step is in flight instead, and edges that pass each other are soon elsewhere.
bool TimeStepper::obeys(const Found& found, double h) const {
  const bool passes = found.feature.kind == ContactFeature::Kind::kInCone && found.passing * h > closed();
  return found.gap <= closed() && found.rate * h <= kOpens * closed() && !passes;
}

void TimeStepper::choose(double h) {
  const std::vector<ClosedContact> forces = law_.empty() ? known_ : law_;
  law_.clear();
  for (const Found& found : found_) {
    if (!obeys(found, h)) {
      continue;
    }
    ClosedContact& contact = law_.emplace_back(ClosedContact{.feature = found.feature});
    const auto before = std::find_if(forces.begin(), forces.end(), [&](const ClosedContact& other) {
      return isSame(other.feature, found.feature);
    });
    if (before != forces.end()) {
      contact.push = before->push;
      contact.friction = before->friction;
    }
  }
}

// Impacts at the start of a step, until no closed contact approaches.
void TimeStepper::collide() {
  lookAgain(start_);
  for (int round = 0; round < kMostRounds && collideOnce(); ++round) {
    lookAgain(start_);
  }
}

bool TimeStepper::collideOnce() {
  double speeds = 0;
  for (const GroupBody& body : start_) {
    speeds = std::max(speeds, body.velocity.norm());
  }
  DisjointSets joined(bodies_.size());
  std::vector<char> approaching(found_.size(), 0);
  for (std::size_t c = 0; c < found_.size(); ++c) {
    const ContactFeature& feature = found_[c].feature;
    approaching[c] = found_[c].rate < -std::max(0x1p-40 * speeds, kResiduals * equations_.residual()) ? 1 : 0;
    if (!feature.b.isWall() && !bodies_[static_cast<std::size_t>(feature.b.body())].isHeld() &&
        !bodies_[static_cast<std::size_t>(feature.a)].isHeld()) {
      joined.join(static_cast<std::size_t>(feature.a), static_cast<std::size_t>(feature.b.body()));
    }
  }
  const auto rootOf = [&](const ContactFeature& feature) {
    const auto a = static_cast<std::size_t>(feature.a);
    return joined.root(bodies_[a].isHeld() ? static_cast<std::size_t>(feature.b.body()) : a);
  };
  std::vector<char> struck(bodies_.size(), 0);
  bool any = false;
  bool bounces = false;
  for (std::size_t c = 0; c < found_.size(); ++c) {
    if (approaching[c] != 0) {
      any = true;
      struck[rootOf(found_[c].feature)] = 1;
      const double parting = -found_[c].feature.material.restitution * found_[c].rate;
      bounces = bounces || parting * parting > 2 * acceleration_ * kHop * closed();
    }
  }
  if (!any) {
    return false;
  }
  std::vector<ContactFeature> features;
  std::vector<ImpactContact> contacts;
  double fastest = 0;
  for (std::size_t c = 0; c < found_.size(); ++c) {
    const Found& found = found_[c];
    if (struck[rootOf(found.feature)] != 0) {
      features.push_back(found.feature);
      contacts.push_back(impactAt(c));
      fastest = std::max(fastest, -found.rate);
    }
  }
  std::vector<ImpactShare> shares(contacts.size());
  if (bounces) {
    std::vector<BodyState> states;
    std::vector<ImpactBody> bodies;
    for (const GroupBody& body : start_) {
      states.push_back({.pose = {body.position, body.worldFromBody.toRotationMatrix()},
                        .velocity = body.velocity,
                        .angularMomentum = body.angularMomentum});
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies.push_back({.mass = &bodies_[i].body->mass, .state = &states[i]});
    }
    const double residual = equations_.residual();
    residuals_.add(resolveImpact(bodies, contacts, shares, {.enough = residual, .tolerable = residual}));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      start_[i].velocity = states[i].velocity;
      start_[i].angularMomentum = states[i].angularMomentum;
    }
  } else {
    std::vector<ContactProblem::Triple> impulses;
    const GroupState before = start_;
    if (!equations_.compress(start_, features, impulses)) {
      return false;
    }
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      shares[c] = {.approach = -equations_.contactAt(features[c], before).rate,
                   .impulse = impulses[c][0],
                   .tangential = std::sqrt(impulses[c][1] * impulses[c][1] + impulses[c][2] * impulses[c][2]),
                   .normal = contacts[c].normal};
    }
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (shares[c].impulse > 0) {
      impacts_.push_back({contacts[c], shares[c], fastest});
    }
  }
  return true;
}

ImpactContact TimeStepper::impactAt(std::size_t found) const {
  const ContactFeature& feature = found_[found].feature;
  const ContactState& state = states_[found];
  return {.a = feature.a,
          .b = feature.b,
          .armA = state.armA,
          .armB = state.armB,
          .normal = state.normal,
          .material = feature.material,
          .directions = state.directions};
}

// Forgets what is no more than gravity or springs give in the step.
void TimeStepper::keepImpacts() {
  const double least = 2 * equations_.pull(start_) * length_;
  const auto inverseMass = [&](int body) {
    return bodies_[static_cast<std::size_t>(body)].body->mass.inverseMass;
  };
  std::erase_if(impacts_, [&](const GroupImpact& impact) {
    const ImpactContact& contact = impact.contact;
    const double gives = impact.share.impulse *
                         (inverseMass(contact.a) + (contact.b.isWall() ? 0 : inverseMass(contact.b.body())));
    return impact.cause <= least || gives <= least;
  });
}

}  // namespace careen
