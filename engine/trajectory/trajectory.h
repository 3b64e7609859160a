#pragma once

#include <cstddef>
#include <stop_token>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "physics/motion/motion.h"
#include "physics/motion/recorder.h"
#include "physics/world/body.h"
#include "physics/world/method.h"
#include "physics/world/world.h"
#include "stage/run_setup.h"

namespace careen {

struct Segment {
  double start = 0;  ///< [s]
  Motion motion;
};

/// What one body did: segments in order of time, the first at 0.
struct Track {
  std::vector<Segment> segments;
};

/// A recorded run: what it started from, and where every body is at any moment of it. Nothing else is needed
/// to draw, measure and export it.
struct Trajectory : RunSetup {
  RunFigures figures;
  std::vector<Track> tracks;    ///< one for each body of the world, in its order
  std::vector<Impact> impacts;  ///< in order of time

  /// State of a body at a time within [0, duration] [s]; InputError outside. Where two segments meet, the
  /// later one.
  BodyState state(std::size_t body, double time) const;
  std::vector<Pose> poses(double time) const;

  /// Of the box or wall that body a struck.
  const std::string& partnerName(const Impact& impact) const;

  /// Of the scene file's bytes.
  std::string sceneHash() const;
  /// Of every body's last state, bit for bit, taken in the order of the bodies' names.
  std::string stateHash() const;
};

/// Runs the setup's world by its method and keeps what happened.
Trajectory record(RunSetup setup, const std::stop_token& stop = {});
/// The same of a world that no scene was made for: it is shown as a scene is that says nothing of how.
Trajectory record(const World& world, const RunSettings& settings, std::string sceneText,
                  const std::stop_token& stop = {});

}  // namespace careen
