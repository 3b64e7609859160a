#pragma once

#include <span>
#include <vector>

#include "physics/contact/time_stepper.h"

namespace careen {

/// Time steps that the bodies of an island take before smooth motion is tried again.
class IslandTimeSteps {
 public:
  /// At least `count` of them, and not so few that trying again did not pay.
  IslandTimeSteps(const World& world, const std::vector<TouchingBody>& bodies, double tolerance, int count,
                  std::span<const ContactFeature> joints = {});

  /// Takes one of at most `most` [s]. Returns false if it was the last: hardly anything moves any more, or
  /// there were enough. Throws NumericalError as TimeStepper::step() does.
  bool take(double most, double mostWork);
  void cutTo(double length) { stepper_.cutTo(length); }
  int left() const { return left_; }
  const TimeStepper& stepper() const { return stepper_; }
  /// The contacts with which smooth motion goes on: those with forces, all if hardly anything moves.
  std::vector<ContactFeature> contacts() const { return quiet_ ? stepper_.touching() : stepper_.pressed(); }
  /// See Island::work(), of the last step.
  double work() const;
  ContactResiduals takeResiduals() { return stepper_.takeResiduals(); }

  /// [1] Work of a body for finding its contacts and watching its gaps in one step.
  static constexpr double kWorkOfGeometry = 60;

 private:
  TimeStepper stepper_;
  int left_;
  int taken_ = 0;
  bool quiet_ = false;
  double workBefore_ = 0;  // the last step
};

}  // namespace careen
