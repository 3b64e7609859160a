#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/pose.h"
#include "physics/body.h"
#include "physics/method.h"
#include "physics/motion.h"
#include "physics/recorder.h"

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
  std::string sceneText;  ///< the scene file it came from
  RunSettings settings;
  RunFigures figures;
  std::vector<std::string> wallNames;
  std::vector<Track> tracks;
  std::vector<Impact> impacts;  ///< in order of time

  /// State of one body at a time within [0, duration]; times outside are an InputError.
  BodyState state(std::size_t body, double time) const;
  std::vector<Pose> poses(double time) const;
};

}  // namespace careen
