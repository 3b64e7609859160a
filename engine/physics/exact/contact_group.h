#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/exact/event_queue.h"
#include "physics/motion/motion.h"

namespace careen {

struct Encounter;

/// Bodies that advance together in steps: an island, exact to the tolerance, or a crowd, fast and of bounded
/// error. Nobody outside asks which.
class ContactGroup : public std::enable_shared_from_this<ContactGroup> {
 public:
  virtual ~ContactGroup() = default;
  ContactGroup(const ContactGroup&) = delete;
  ContactGroup& operator=(const ContactGroup&) = delete;

  /// Of its bodies, by place; −1 where one left.
  const std::vector<int>& ranks() const { return ranks_; }
  /// Of a body that moves, in the current step.
  const ContactStep& motion(std::size_t place) const { return motions_[place]; }
  const Instant& start() const { return start_; }
  double length() const { return length_; }  ///< [s] of it
  Instant end() const { return instantAfter(start_, length_); }
  /// The body whose event is the end of the step.
  int leader() const { return leader_; }

  /// Whether after its step it just takes the next one; otherwise its contacts have to be found again.
  virtual bool goesOn() const = 0;
  /// Takes the next step from then on, and records it. Returns those who cannot, who go on as a crowd.
  virtual std::optional<Encounter> advance(const Instant& time) = 0;
  /// Ends its step at the time of an encounter, in which its bodies take part; or returns false, if they take
  /// it over instead.
  virtual bool enter(Encounter& encounter, int rank) = 0;
  /// Adds the contacts that it has to those of an encounter that it entered.
  virtual void addFeatures(const Encounter& encounter, std::vector<ContactFeature>& features) const = 0;
  /// Whether it handles contact of a member's box with one of another body, given by rank, itself.
  virtual bool seesTo(std::size_t place, int box, const BoxOf& other) const = 0;
  /// Whether it is predicted whom its members meet in a step, but for those it sees to.
  virtual bool isPredicted() const = 0;
  /// The run ends within its step, at that time.
  virtual void endRun(const Instant& time) = 0;

 protected:
  ContactGroup() = default;

  std::vector<int> ranks_;
  std::vector<ContactStep> motions_;  // by place
  Instant start_{};                   // of the step
  double length_ = 0;                 // [s] of it
  int leader_ = 0;
};

}  // namespace careen
