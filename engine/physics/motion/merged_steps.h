#pragma once

#include <array>
#include <cstddef>

#include "physics/motion/hermite_step.h"
#include "physics/motion/recorder.h"

namespace careen {

/// Merges short steps of one body into longer ones before they are recorded: as many as one cubic through the
/// first start and the last end, with the velocities there, follows to `within` [m] at the ends and in the
/// middle of all steps, corners included: at the ends alone, a short step before a long one would say nothing
/// about where the long one goes. So a body that hardly turns or falls freely costs one record for many
/// steps, and so does one that is shaken by less than that. Coefficients are rounded to a grid of some 2⁻²⁴
/// of `within`, as files are then smaller by a third.
class MergedSteps {
 public:
  explicit MergedSteps(double within = 0) : within_(within) {}

  /// A step from `time` [s] on of `length` [s]; `radius` [m] of the body. Records what came before if this
  /// step does not continue it: its place jumps, or the cubic would not follow.
  void add(Recorder& recorder, BodyIndex body, double time, const StepEnd& from, const StepEnd& to,
           double length, double radius);
  /// Records what is left.
  void flush(Recorder& recorder, BodyIndex body);

 private:
  static constexpr std::size_t kMost = 17;  // of nine steps
  struct Sample {
    double elapsed = 0;
    Vec3 position = Vec3::Zero();
    Vec4 worldFromBody = Vec4::Zero();
  };
  static Sample middleOf(const StepEnd& from, const StepEnd& to, double length);
  bool follows(const CrowdStep& step, double radius) const;

  double within_;
  double time_ = 0;
  double length_ = 0;
  StepEnd from_;
  StepEnd to_;
  std::array<Sample, kMost> samples_;  // middles of the steps, and ends of those between
  std::size_t count_ = 0;
};

}  // namespace careen
