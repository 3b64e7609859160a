#pragma once

#include "physics/motion/hermite_step.h"
#include "physics/motion/merged_steps.h"
#include "physics/motion/recorder.h"

namespace careen {

/// Joins the steps of one member of a crowd to a path without corners before they are recorded. Where two
/// steps meet, with different velocities, the path goes from the middle of the one to the middle of the other
/// by a cubic with the velocities there: if they are equally long, it is the quadratic spline whose control
/// points are their ends. A step of more than twice the other's length bends only as far from the joint as
/// the other is long. So velocities are always between those of two steps, and as all members are joined
/// alike, so are relative velocities: paths have no more energy than the steps. How far they are beside the
/// steps beside() tells.
class JoinedSteps {
 public:
  enum class Begin { kRounded, kCorner };

  explicit JoinedSteps(double within = 0) : merged_(within) {}

  /// A step from `time` [s] on of `length` [s]; `radius` [m] of the body. Records what came before it. If it
  /// has a corner there, the path goes through its begin.
  void add(Recorder& recorder, BodyIndex body, double time, const StepEnd& from, const StepEnd& to,
           double length, double radius, Begin begin = Begin::kRounded);
  struct Beside {
    double time = 0;  ///< [s] from the joint
    double off = 0;   ///< [s] of the velocity's change: how far the path is from the steps then
  };
  /// Where two steps of these lengths meet, at that part of the bend, −1 to 1: before the joint, or after it.
  static Beside beside(double last, double next, double part);
  /// The same so long [s] after the joint; 0 outside the bend, and if nothing came before.
  static double offAt(double last, double next, double time);
  /// How the body moved until its first step, for that long [s]: recorded by others, but the path may replace
  /// it.
  void follows(double time, const StepEnd& from, const StepEnd& to, double length);
  /// Nothing was added since it was made or flushed.
  bool isNew() const { return last_.length == 0; }
  /// Records what is left.
  void flush(Recorder& recorder, BodyIndex body);

 private:
  struct Step {
    double time = 0;
    double length = 0;
    StepEnd from;
    StepEnd to;
    double radius = 0;
    StepEnd at(double elapsed) const;
  };
  void handOn(Recorder& recorder, BodyIndex body, double until);

  MergedSteps merged_;
  Step last_;
  bool ofOthers_ = false;  // the last step
  double done_ = 0;        // [s] of the last step: handed on until then
  StepEnd there_;          // where it was then
};

}  // namespace careen
