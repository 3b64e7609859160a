#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "physics/motion/motion.h"
#include "physics/motion/recorder.h"
#include "physics/world/body.h"
#include "physics/world/method.h"
#include "physics/world/world.h"

namespace careen {

struct Segment {
  double start = 0;  ///< [s]
  Motion motion;
};

/// What one body did: segments in order of time, the first at 0.
struct Track {
  std::string name;
  MassProperties mass;
  std::vector<Segment> segments;
};

/// A recorded run: where every body is at any moment of it.
struct Trajectory {
  std::string sceneText;  ///< the scene file it came from, byte for byte
  RunSettings settings;
  RunFigures figures;
  std::vector<std::string> wallNames;
  std::vector<Track> tracks;
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

/// Runs the world by settings.method and keeps what happened.
Trajectory record(const World& world, const RunSettings& settings, std::string sceneText,
                  const std::stop_token& stop = {});

}  // namespace careen
