#pragma once

#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "physics/world/body.h"

namespace careen {

struct World;

/// What a motor aims at: offset + amplitude sin(2π frequency t + phase), the amplitude growing from 0 in
/// `ramp` [s]; or, if it has points, the straight lines between these (time [s], coordinate), the last one
/// for ever.
struct MotorTarget {
  double offset = 0;     ///< [rad] or [m]
  double amplitude = 0;  ///< likewise
  double frequency = 0;  ///< [Hz]
  double phase = 0;      ///< [rad]
  double ramp = 0;       ///< [s]
  std::vector<std::pair<double, double>> path;

  /// The coordinate that it has at a time [s], and its rate.
  struct Aim {
    double coordinate = 0;
    double rate = 0;
  };
  Aim at(double time) const;
};

/// A motor in a hinge or slider. Its effort [N m] or [N] on the joint's `from`, along its coordinate q, is
///
///   stiffness (target − q) + damping (target′ − q̇) − Σ (k q + d q̇) over the gains' joints,
///
/// at most `largest` either way.
struct Motor {
  struct Gain {
    int joint = 0;  ///< index in the world
    double k = 0;   ///< [N m/rad], [N/m], [N/rad] or [N m/m]
    double d = 0;   ///< the same times [s]
  };
  int joint = 0;  ///< index in the world, of a hinge or slider
  double largest = std::numeric_limits<double>::infinity();
  MotorTarget target;
  double stiffness = 0;
  double damping = 0;
  std::vector<Gain> gains;
};

/// Of a joint at a sample: its coordinate, turns of a hinge counted from sample to sample, and its rate.
struct JointSample {
  double coordinate = 0;
  double rate = 0;
};

/// What is looked at each `period` [s], and held until the next time: the efforts of motors.
struct Control {
  double period = 0;  ///< [s]
  std::vector<Motor> motors;
  /// Called at each sample after the motors: time [s], the states of all bodies, all joints (hinges and
  /// sliders have coordinates), and the efforts of all joints, which it may change. Must always answer the
  /// same.
  std::function<void(double time, std::span<const BodyState> states, std::span<const JointSample> joints,
                     std::span<double> efforts)>
      callback;
};

/// The efforts that its motors give, by joint of the world.
std::vector<double> motorEfforts(const Control& control, double time, std::span<const JointSample> joints);

}  // namespace careen
