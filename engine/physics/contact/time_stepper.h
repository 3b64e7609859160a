#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "physics/contact/found_contacts.h"
#include "physics/contact/gap_events.h"
#include "physics/contact/group_impacts.h"
#include "physics/contact/group_step.h"
#include "physics/contact/implicit_step.h"
#include "physics/motion/motion.h"
#include "physics/world/world.h"

namespace careen {

/// Time steps of bodies that touch, where no smooth motion exists (Painlevé's paradox, jams) or contacts
/// change more often than it pays to follow each. It needs no list of contacts: every step finds those of its
/// bodies with each other and with the walls.
///
/// A step is an ImplicitStep. Its length follows from the tolerance: the difference between one step and two
/// of half the length, and ends where a gap closes (regula falsi on the length); there all points of the
/// manifold strike together, by the impact law. Gaps up to `closed()` count as none. No step is shorter than
/// the time in which nothing moves that far: so chattering ends, at first order, and steps exist where forces
/// do not: the impulse without approach of a jam.
class TimeStepper {
 public:
  /// `tolerance` [m]: of positions, corners included. `joints`: their conditions; must outlive it.
  TimeStepper(const World& world, const std::vector<TouchingBody>& bodies, double tolerance,
              std::span<const ContactFeature> joints = {});

  /// Takes one step, at most so long [s], and returns its length. Throws NumericalError if no impulses were
  /// found however short the step, or not for so much of ImplicitStep::work(); it is of no use then.
  double step(double most, double mostWork = std::numeric_limits<double>::infinity());
  /// Cuts the last step to `length` [s] from its start.
  void cutTo(double length);
  /// [s] of the last step.
  double length() const { return step_.length; }
  /// Contacts that are closed at the end of the last step; those of them that had a force in it.
  const std::vector<ContactFeature>& touching() const { return found_.features(); }
  std::vector<ContactFeature> pressed() const;

  /// At the end of the last step, contacts moved apart where drift has made them deep: in the motion during
  /// it they are not, as that way, far smaller than the tolerance, would be a speed in a short step.
  const GroupState& state() const { return end_; }
  /// Motion of a body in the last step.
  ContactStep motion(std::size_t body) const { return step_.motion(bodies_[body], body); }
  /// Impacts at the start of the last step, also those without approach. What gravity alone gives in the step
  /// is none but a force.
  const std::vector<GroupImpact>& impacts() const { return impacts_.list(); }
  /// Whether nothing moves faster than what falling through a small part of the tolerance gives, or being
  /// pulled through it by springs.
  bool isQuiet();
  /// [m] deepest gap of a contact seen at the end of a step.
  double deepest() const { return deepest_; }
  /// [m] Gaps up to this count as none.
  double closed() const { return 0.25 * tolerance_; }
  const ImplicitStep& equations() const { return equations_; }
  /// Of the contact problems solved since it was last asked.
  ContactResiduals takeResiduals();

 private:
  enum class Attempt { kDone, kShorter, kUnsolved };

  void choose(double h);
  Attempt attempt(double& h, double shortest);
  bool tryStep(double h, ImplicitStep::Order order = ImplicitStep::Order::kSecond);
  bool tryHalves(double h);
  bool endAtEvent(double& h);
  void actAtOnce();
  double errorOf(const GroupState& coarse, const GroupState& fine, double h) const;
  double shortestStep();
  double longestStep() const;
  double accelerationInStep() const;
  void correct();
  double wayApart() const;

  const std::vector<TouchingBody>& bodies_;
  double tolerance_;
  ImplicitStep equations_;
  FoundContacts found_;  // at the start of a step, then at its end
  GapEvents events_;
  GroupImpacts impacts_;
  GroupStep step_;
  GroupState end_;                    // of the last step, contacts moved apart
  GroupState coarse_;                 // the end of one step
  std::vector<ClosedContact> law_;    // contacts whose law holds in the step
  std::vector<ClosedContact> known_;  // of the last step: forces to start from
  double proposed_ = 0;               // [s]
  double acceleration_ = 0;           // [m/s²] largest of the last step
  double deepest_ = 0;
};

}  // namespace careen
