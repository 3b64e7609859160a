#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/contact/contact_system.h"
#include "physics/contact/manifold_normals.h"
#include "physics/world/world.h"

namespace careen {

/// State of one body of a group, world frame. L is primary, as in BodyState; the attitude is a quaternion.
struct GroupBody {
  Vec3 position = Vec3::Zero();  ///< [m]
  Quat worldFromBody = Quat::Identity();
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularMomentum = Vec3::Zero();  ///< [kg m²/s]
  double time = 0;                      ///< [s] when it is there, if it moves

  Pose pose() const { return {position, worldFromBody.toRotationMatrix()}; }
  BodyState state() const { return {pose(), velocity, angularMomentum}; }
};
using GroupState = std::vector<GroupBody>;

/// Bodies that touch, and what a state of them says of their motion and of their contacts. A feature's bodies
/// are indices into the group. World and bodies must outlive it.
class TouchingGroup {
 public:
  TouchingGroup(const World& world, const std::vector<TouchingBody>& bodies)
      : world_(world), bodies_(bodies), boxes_(boxesOf(bodies)) {}

  const World& world() const { return world_; }
  const std::vector<TouchingBody>& bodies() const { return bodies_; }
  std::size_t size() const { return bodies_.size(); }
  /// Those before the half-spaces.
  std::size_t boxes() const { return boxes_; }
  const Body& body(std::size_t index) const { return *bodies_[index].body; }
  bool isHeld(std::size_t index) const { return bodies_[index].isHeld(); }

  bool isDriven(std::size_t index) const { return bodies_[index].isDriven(); }

  /// The state that the bodies have; those that are held do not move, unless they are driven.
  GroupState state() const;
  /// What is driven goes on from one state for so long [s], in the other.
  void drive(const GroupState& from, double h, GroupState& to) const;
  GroupBody drivenFrom(const GroupState& from, std::size_t body, double h) const;
  Kinematics kinematics(std::size_t body, const GroupBody& at) const;
  /// [rad/s] Of a body, of that attitude and angular momentum.
  Vec3 angularVelocity(std::size_t body, const Mat3& worldFromBody, const Vec3& angularMomentum) const;
  /// [m/s] Of the bodies that move and their corners, at most.
  double fastest(const GroupState& state) const;
  /// Whether two boxes that stop each other, not both held, are so near each other that they may have a gap
  /// of `within` [m].
  bool mayMeet(std::size_t a, std::size_t b, const GroupState& state, double within) const;
  ContactState contactAt(const ContactFeature& feature, const GroupState& state) const;
  /// All of them, points of one manifold with one normal.
  void contactsAt(std::span<const ContactFeature> features, const GroupState& state,
                  std::vector<ContactState>& contacts);
  /// As ContactSystem::keepMomenta; `pushing`: the contacts with forces.
  void keepMomenta(const GroupState& before, double h, std::span<const ContactFeature> pushing,
                   GroupState& to) const;

 private:
  ContactState stateOf(const ContactFeature& feature, const Kinematics& a, const Kinematics& b) const;

  const World& world_;
  const std::vector<TouchingBody>& bodies_;
  std::size_t boxes_;
  std::vector<Kinematics> kinematics_;  // of the last contactsAt()
  ManifoldNormals normals_;
};

}  // namespace careen
