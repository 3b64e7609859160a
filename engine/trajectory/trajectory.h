#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "physics/motion/recorder.h"
#include "physics/motion/run_progress.h"
#include "physics/world/body.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"
#include "stage/run_setup.h"
#include "trajectory/segments.h"

namespace careen {

/// What is known of a run that careen did not compute but read from a table of poses.
struct GivenPoses {
  bool velocities = false;         ///< the table has them; else they are estimated from positions
  bool angularVelocities = false;  ///< likewise
  double quaternionError = 0;      ///< [1] the largest |length − 1| of its quaternions
};

/// A recorded run: its initial state and settings, and every body's state at any time. Sufficient to draw,
/// measure and export it.
struct Trajectory : RunSetup {
  RunFigures figures;
  std::vector<Track> tracks;                ///< one per body of the world, in its order
  std::vector<Impact> impacts;              ///< in order of time
  std::vector<JointImpulse> jointImpulses;  ///< likewise
  std::vector<JointEffort> jointEfforts;    ///< likewise; 0 before the first of a joint
  /// Present if the run comes from a table of poses: then it has no impacts, and method and tolerance of its
  /// settings mean nothing. Not stored in files.
  std::optional<GivenPoses> given;

  /// State of a body at a time in [0, duration] [s]; InputError outside. Where two segments meet, the later
  /// one.
  BodyState state(std::size_t body, double time) const;
  /// Of all bodies.
  std::vector<BodyState> states(double time) const;
  /// Of a body's box: where its middle is, which need not be the centre of mass.
  Pose boxPoseAt(std::size_t body, double time) const;
  /// Of all boxes.
  std::vector<Pose> poses(double time) const;

  /// Name of the box or wall that body a struck.
  const std::string& partnerName(const Impact& impact) const;

  /// As scene files spell it; "given poses" if it comes from a table.
  std::string methodName() const;

  /// Hash of the scene file's bytes.
  std::string sceneHash() const;
  /// Hash of the final states of all bodies, bit for bit, in order of the bodies' names.
  std::string stateHash() const;
};

/// Adds an impact, or an impulse or effort of a joint, after all that are not later. Few are late themselves:
/// a group in time steps that is cut short takes its step again in shorter ones, and tells their impacts
/// after those of others.
template <class Event>
void insertByTime(std::vector<Event>& events, const Event& event) {
  const auto isBefore = [](double time, const Event& other) { return time < other.time; };
  events.insert(std::upper_bound(events.begin(), events.end(), event.time, isBefore), event);
}

/// Whether a run that has come to that time [s] may end there; of steps of contact not all until then need be
/// recorded. Asked by method exact alone, before each of its events.
using EnoughRecorded = std::function<bool(const Trajectory& soFar, double time)>;

/// Simulates the setup's world by its method and records the trajectory, which ends where there is enough of
/// it. InputError if it has more than `most` segments and impacts, NumericalError if a state of it is not
/// finite, or no reader would accept it.
Trajectory record(RunSetup setup, const std::stop_token& stop = {}, std::uint64_t most = kMostRecords,
                  const RunCallback& progress = {}, const EnoughRecorded& isEnough = {});
/// The same for a world without a scene: it is shown with a scene's default stage.
Trajectory record(const World& world, const RunSettings& settings, std::string sceneText,
                  const std::stop_token& stop = {});

}  // namespace careen
