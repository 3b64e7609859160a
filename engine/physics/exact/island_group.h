#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "physics/contact/island.h"
#include "physics/exact/bodies.h"
#include "physics/exact/contact_group.h"

namespace careen {

/// An island: exact to the tolerance, smooth between events.
class IslandGroup final : public ContactGroup {
 public:
  /// `ranks` of the island's bodies.
  IslandGroup(Bodies& bodies, std::vector<int> ranks, std::unique_ptr<Island> island);

  /// As advance(), where bodies enter it.
  std::optional<Encounter> begin(const Instant& time);

  bool goesOn() const override { return end_ == Island::End::kGoesOn; }
  std::optional<Encounter> advance(const Instant& time) override;
  bool enter(Encounter& encounter, int rank) override;
  void addFeatures(const Encounter& encounter, std::vector<ContactFeature>& features) const override;
  bool seesTo(std::size_t place, int box, const BoxOf& other) const override;
  bool isPredicted() const override { return true; }
  void endRun(const Instant& time) override;

 private:
  struct Driven {  // a joint with an effort, in a step
    const ContactFeature* of = nullptr;
    double effort = 0;      // [N m] or [N]
    double coordinate = 0;  // at its start
  };
  bool takeStep(const Instant& time);
  void noteMotors();
  template <class PoseOf>
  void accountForWork(const PoseOf& poseOf);
  void recordImpacts();
  void accountForLosses();

  Bodies& bodies_;
  std::unique_ptr<Island> island_;
  Island::End end_ = Island::End::kGoesOn;
  std::vector<Driven> driven_;
};

}  // namespace careen
