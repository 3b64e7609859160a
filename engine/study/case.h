#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "physics/world/world.h"
#include "scene/scene.h"

namespace careen {

/// What a case asks of a contestant.
enum class Measure {
  kPoses,     ///< to be where the truth says, at every moment of it
  kEnergy,    ///< to keep its energy
  kReversal,  ///< to come back when all velocities are turned round at the end
  kScaled,    ///< to do the same as in another scene with other units of length and time
  kOverlap,   ///< to keep boxes out of each other and out of walls
};

/// A scene whose truth is known.
struct Case {
  std::string name;
  std::string title;
  std::string whyHard;
  std::string source;  ///< where the truth comes from
  Measure measure = Measure::kPoses;
  Scene scene;
  World world;
  std::vector<double> times;             ///< [s] moments that count; the last is the end
  std::vector<std::vector<Pose>> poses;  ///< [moment][body] for kPoses; of what cannot move, its own
  double uncertainty = 0;                ///< [1] of the poses, as Judgement::error; 0: that of a double
  // For kScaled: the world this one is a scaled copy of, and the units of this one in those of that.
  World original;
  double lengths = 1;
  double durations = 1;

  double duration() const { return times.back(); }
  /// [s] that a contestant simulates for its answer.
  double simulated() const;
};

/// Names of all cases that come with the program, in the order of the study.
std::vector<std::string> caseNames();

/// One of them. InputError names the file and what is wrong with it.
Case readCase(const std::string& name);

/// A case out of any scene: what method exact says, up to half the horizon of its own error estimate.
/// InputError if exact cannot run it.
Case caseOfScene(const std::filesystem::path& scene, const std::stop_token& stop);

}  // namespace careen
