#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/implicit_step.h"
#include "physics/contact/touching_group.h"
#include "physics/impact/impact_law.h"

namespace careen {

/// In an impact: the feature's, at that state; of a joint's condition, with its index as the caller counts.
ImpactContact impactContactOf(const ContactFeature& feature, const ContactState& state, int joint);

/// The contacts of a group of bodies with each other: found at one state, then followed to others.
class FoundContacts {
 public:
  /// `closed` [m]: gaps up to this count as none. `joints`: the conditions of the group's joints, which must
  /// outlive it: those that hold are always among the contacts.
  FoundContacts(TouchingGroup& group, double closed, std::span<const ContactFeature> joints = {})
      : group_(group), closed_(closed), joints_(joints) {}

  /// Finds all that are closed at a state. `slow` [m/s]: approach no faster is none.
  void find(const GroupState& at, double slow);
  /// The same contacts at another state.
  void follow(const GroupState& at) { group_.contactsAt(features_, at, states_); }

  const std::vector<ContactFeature>& features() const { return features_; }
  std::span<const ContactFeature> joints() const { return joints_; }
  /// As last found or followed.
  const std::vector<ContactState>& states() const { return states_; }
  /// [m/s] Of the gap.
  double rate(std::size_t contact) const { return states_[contact].parting(); }
  double closed() const { return closed_; }
  /// [m] 0 if none is.
  double deepest() const;
  /// [m] That, or the largest gap of a joint.
  double farthestOff() const;
  bool has(const ContactFeature& feature) const;

  /// Whether a contact obeys its law in a step of `h` [s]. One that parts so fast that it would open within
  /// the step is in flight instead, and edges that pass each other are soon elsewhere.
  bool obeys(std::size_t contact, double h) const;
  /// Those that do, with the forces that they have among `known`.
  std::vector<ClosedContact> obeying(double h, const std::vector<ClosedContact>& known) const;
  ImpactContact impactAt(std::size_t contact) const;

 private:
  void addCorners(std::size_t body, const std::vector<Pose>& poses);
  int indexOf(const ContactFeature& feature) const;
  void addBetween(std::size_t a, std::size_t b, const std::vector<Pose>& poses, const GroupState& at,
                  double slow);
  void addBetween(std::size_t a, const BoxAt& boxA, std::size_t b, const BoxAt& boxB, const GroupState& at,
                  double slow);

  TouchingGroup& group_;
  double closed_;
  std::span<const ContactFeature> joints_;
  std::vector<ContactFeature> features_;
  std::vector<ContactState> states_;
};

}  // namespace careen
