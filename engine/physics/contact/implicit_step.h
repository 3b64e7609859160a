#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/contact/contact_system.h"
#include "physics/solver/contact_problem.h"
#include "physics/solver/contact_solver.h"
#include "physics/world/forces.h"
#include "physics/world/world.h"

namespace careen {

/// State of one body of a group, world frame. L is primary, as in BodyState; the attitude is a quaternion.
struct GroupBody {
  Vec3 position = Vec3::Zero();  ///< [m]
  Quat worldFromBody = Quat::Identity();
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularMomentum = Vec3::Zero();  ///< [kg m²/s]
};
using GroupState = std::vector<GroupBody>;

/// A contact whose law holds during a step.
struct ClosedContact {
  ContactFeature feature;
  // Mean over the step, found last, and the next step's warm start: [N] normal, and friction in the world, as
  // tangents may jump where the normal turns.
  double push = 0;
  Vec3 friction = Vec3::Zero();
};

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

  /// As ContactSystem::keepMomenta; `pushing`: the contacts with forces.
  void keepMomenta(const GroupState& before, double h, std::span<const ContactFeature> pushing,
                   GroupState& to) const;

  Kinematics kinematics(std::size_t body, const GroupBody& at) const;
  ContactState contactAt(const ContactFeature& feature, const GroupState& state) const;
  /// All of them, points of one manifold with one normal.
  void contactsAt(std::span<const ContactFeature> features, const GroupState& state,
                  std::vector<ContactState>& contacts);
  /// [m/s²] Largest acceleration without contact forces at that state.
  double freeAcceleration(const GroupState& state);
  /// [m/s²] The scale of such accelerations: gravity's, or the largest where springs or drag act.
  double pull(const GroupState& state);
  /// [m/s] To which the last impulses were solved.
  double residual() const { return residual_; }
  /// Factorisations so far, each times the bodies and contacts in it: the cost.
  double work() const { return work_; }
  /// From here on so much may be spent; then NumericalError is thrown.
  void limitWork(double most) { mostWork_ = work_ + most; }
  /// Of the problems solved since it was last asked.
  ContactResiduals takeResiduals() { return solver_.takeResiduals(); }

 private:
  using Six = std::array<double, ContactProblem::kAxes>;

  void findLoads(const GroupState& at);
  void placeBodies(std::span<const ContactFeature> contacts);
  void addRows(const ContactFeature& feature, const ContactState& geometry);
  void fillFree(const GroupState& from, double h);
  void aimAtEnd(std::size_t index, const ContactFeature& feature, const GroupState& to);
  ContactState stateOf(const ContactFeature& feature, const Kinematics& a, const Kinematics* b) const;
  void chooseResidual(const GroupState& at);
  bool solve(double enough);
  void moveArms(const GroupState& from, double h);
  void guessImpulses(const GroupState& from, double h, const std::vector<ClosedContact>& contacts);
  void addImpulses(std::span<const ContactFeature> features);
  bool findImpulses(const GroupState& from, double h, bool first, std::vector<ClosedContact>& contacts,
                    const GroupState& to);
  void findMiddle(const GroupState& from, const GroupState& to);
  void move(const GroupState& from, double h, GroupState& to) const;
  void turn(const GroupState& from, double h, GroupState& to) const;
  Vec3 spinOf(std::size_t body, const Mat3& turned, const Vec3& angularMomentum) const;
  Mat3 principalAt(std::size_t body, const GroupBody& at) const;

  const World& world_;
  const std::vector<TouchingBody>& bodies_;
  double tolerance_;                 // [m]
  double radius_ = 0;                // [m] largest half diagonal of those that move
  std::vector<int> places_;          // by body: index in the problem, or kNobody
  std::vector<std::size_t> movers_;  // by index in the problem
  ContactProblem problem_;
  ContactSolution solution_;
  ContactSolver solver_;
  std::vector<BodyState> worldStates_;  // for springs and drag
  std::vector<Load> loads_;             // by body of the group
  std::vector<Load> worldLoads_;
  std::vector<Vec3> push_;               // [N s] by body, of the contacts
  std::vector<Vec3> twist_;              // [N m s] likewise
  std::vector<std::vector<Six>> parts_;  // of both, by body
  std::vector<Mat3> turned_;             // by body: principal axes at the end of the step
  std::vector<ContactFeature> features_;
  std::vector<ContactState> geometry_;  // by contact, as in the rows
  std::vector<ContactState> ends_;      // likewise, at the end of the step
  std::vector<Kinematics> kinematics_;
  ManifoldNormals normals_;
  GroupState middle_;
  double residual_ = 0;  // [m/s]
  bool isLastResort_ = false;
  double work_ = 0;
  double mostWork_ = std::numeric_limits<double>::infinity();
};

}  // namespace careen
