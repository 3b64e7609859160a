#pragma once

#include <span>
#include <vector>

#include "physics/contact/contact_impulses.h"
#include "physics/contact/group_loads.h"
#include "physics/contact/touching_group.h"
#include "physics/world/world.h"

namespace careen {

/// A contact whose law holds during a step.
struct ClosedContact {
  ContactFeature feature;
  // Mean over the step, found last, and the next step's warm start: [N] normal, and friction in the world, as
  // tangents may jump where the normal turns.
  double push = 0;
  Vec3 friction = Vec3::Zero();  // of a joint's condition of either sign: all three, along its rows
};

/// The features of those that have a force.
std::vector<ContactFeature> pushing(std::span<const ClosedContact> contacts);

/// [m/s] A residual of the contacts' law that is as good as none, for bodies of that size [m], speed over
/// size and gravity: a small part of the tolerance [m] in the time in which they fall, or move, their own
/// size.
double tolerableResidual(double tolerance, double radius, double rate, double gravity);

/// One time step of a group of bodies in contact, of second order: positions by the trapezoid of the
/// velocities at both ends, attitudes by the angular velocity at the mean angular momentum, contact forces at
/// the middle of the step, their law (Signorini, Coulomb) at its end (Eqs. 10, 13–18). So linear and angular
/// momentum are exchanged to rounding, and forces exist where accelerations do not.
class ImplicitStep {
 public:
  /// `tolerance` [m]: the law is solved so accurately that its residual matters less.
  ImplicitStep(const World& world, const std::vector<TouchingBody>& bodies, double tolerance);
  ImplicitStep(const ImplicitStep&) = delete;
  ImplicitStep& operator=(const ImplicitStep&) = delete;

  /// The state `h` [s] later. Returns false if the contact problem was not solved. Of first order, the law
  /// holds for the normals and arms at the middle of the step, where there always is a solution, and a
  /// residual 128 times as large will do: the last resort.
  enum class Order { kFirst = 1, kSecond = 2 };
  bool advance(const GroupState& from, double h, std::vector<ClosedContact>& contacts, GroupState& to,
               Order order = Order::kSecond);
  /// The impulse without restitution: velocities after which no contact approaches. Likewise.
  bool compress(GroupState& state, std::span<const ContactFeature> contacts,
                std::vector<ContactProblem::Triple>& impulses);
  /// Moves the bodies by the least displacement (in the mass metric) out of each other, where contacts are
  /// deeper than `deepest` [m].
  bool separate(GroupState& state, std::span<const ContactFeature> contacts, double deepest);

  const TouchingGroup& group() const { return group_; }
  TouchingGroup& group() { return group_; }
  GroupLoads& loads() { return loads_; }
  /// [m/s] To which the last impulses were solved.
  double residual() const { return residual_; }
  /// Factorisations so far, each times the bodies and contacts in it: the cost.
  double work() const { return impulses_.work(); }
  /// From here on so much may be spent; then NumericalError is thrown.
  void limitWork(double most) { impulses_.limitWork(most); }
  /// Of the problems solved since it was last asked.
  ContactResiduals takeResiduals() { return impulses_.takeResiduals(); }

 private:
  using Triple = ContactProblem::Triple;

  void chooseResidual(const GroupState& at);
  void guessImpulses(const GroupState& from, double h, std::span<const ClosedContact> contacts);
  void findMiddle(const GroupState& from, double h, const GroupState& to);
  void setProblem(const GroupState& from, double h, std::span<const ClosedContact> contacts,
                  const GroupState& to);
  void aimAtEnd(const GroupState& to);
  void takeImpulses(const GroupState& from, double h, std::span<ClosedContact> contacts);
  void moveArms(const GroupState& from, double h);
  void move(const GroupState& from, double h, GroupState& to) const;
  void turn(const GroupState& from, double h, GroupState& to) const;

  TouchingGroup group_;
  GroupLoads loads_;
  ContactImpulses impulses_;
  double tolerance_;     // [m]
  double radius_ = 0;    // [m] largest half diagonal of those that move
  double residual_ = 0;  // [m/s]
  std::vector<ContactFeature> features_;
  std::vector<ContactState> geometry_;  // by contact, as in the rows
  std::vector<ContactState> ends_;      // likewise, at the end of the step
  std::vector<BodyImpulse> gained_;     // by body, of the contacts
  GroupState middle_;
};

}  // namespace careen
