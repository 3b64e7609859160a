#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "physics/exact/bodies.h"
#include "physics/exact/contact_group.h"
#include "physics/motion/joined_steps.h"
#include "physics/pile/crowd.h"

namespace careen {

/// A crowd: fast, of bounded error. It takes in what it meets, with those that springs join to it, and lets
/// go what nothing touches.
class CrowdGroup final : public ContactGroup {
 public:
  CrowdGroup(Bodies& bodies, const Instant& time);

  /// The bodies of an encounter, and the crowds that they meet, are one crowd from there on.
  static void form(Bodies& bodies, const Encounter& encounter);
  /// Ends at the time of an encounter, and adds its members to it.
  void dissolve(Encounter& encounter);

  bool goesOn() const override { return true; }
  std::optional<Encounter> advance(const Instant& time) override;
  bool enter(Encounter& encounter, int rank) override;
  void addFeatures(const Encounter&, std::vector<ContactFeature>&) const override {}
  /// What it meets is found when it takes its step, but for what comes to rest within it.
  bool seesTo(std::size_t place, int box, const BoxOf& other) const override;
  bool isPredicted() const override { return false; }
  void endRun(const Instant& time) override;

  const Crowd& crowd() const { return crowd_; }
  bool has(const Mover& body) const { return body.group.get() == this; }

 private:
  // Members.
  void keepPlace(int rank, std::size_t place);
  void enlist(int rank, const Instant& time, const BodyState& state, const Quat& attitude);
  void enlistAtRest(int rank);
  void merge(CrowdGroup& other, const Instant& time);
  void admitOutsider(int rank, const Instant& time);
  void admitNear(const Instant& time, double length);
  enum class Taken { kFirst, kAgain };
  bool admitMet(const Instant& time, Taken taken);
  void joinStep(const Encounter& encounter);
  std::vector<int> release(const Instant& time);
  void letGo();
  bool isAnyDriven() const;
  // Their paths, to be recorded.
  double pastOf(const Mover& body, const Instant& time) const;
  std::vector<char> changedSuddenly() const;
  void endStep(std::size_t place, const std::vector<char>& suddenly);
  // Steps.
  void go(const Instant& time);
  void takeStep(std::size_t place);
  void endAt(const Instant& time);
  double step(const Instant& from, double most);
  double stepAgain(const Instant& from, double length);
  void commit(const Instant& time);

  Bodies& bodies_;
  Crowd crowd_;
  double before_ = 0;                // [s] length of the step before this one, 0: none
  std::vector<JoinedSteps> joined_;  // by place: not yet recorded
  double owed_ = 0;                  // [J] that motors did since the middle of the last step
};

}  // namespace careen
