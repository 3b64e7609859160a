#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "physics/world/world.h"
#include "scene/scene.h"

namespace careen {

/// The quantity that a case measures.
enum class Measure {
  kPoses,     ///< poses against the truth at every time of it
  kEnergy,    ///< conservation of energy
  kReversal,  ///< return to the start after all velocities are reversed at the end
  kScaled,    ///< the same motion as in another scene with other units of length and time
  kOverlap,   ///< penetration of boxes and walls
};

/// A scene whose truth is known.
struct Case {
  std::string name;
  std::string title;
  std::string whyHard;
  std::string source;          ///< where the truth comes from
  std::string published = {};  ///< by whom the scene was published with its answer; empty if by nobody
  Measure measure = Measure::kPoses;
  Scene scene;
  World world;
  std::vector<double> times;             ///< [s] times that count; the last is the end
  std::vector<std::vector<Pose>> poses;  ///< [time][body] for kPoses; a fixed body has its own pose
  double uncertainty = 0;                ///< [1] of the poses, as Judgement::error; 0: that of a double
  // For kScaled: the world of which this one is a scaled copy, and the units of this one in those of that
  // one.
  World original;
  double lengths = 1;
  double durations = 1;

  double duration() const { return times.back(); }
  /// [s] simulated time that an answer needs.
  double simulated() const;
};

/// Names of all cases that come with the program, in the order of the study.
std::vector<std::string> caseNames();

/// Reads one of them. InputError names the file and the fault, also where the file itself is missing.
Case readCase(const std::string& name);

/// A case made from any scene: its truth is method exact, up to half the horizon of its own error estimate.
/// InputError if exact cannot run it.
Case caseOfScene(const std::filesystem::path& scene, const std::stop_token& stop);

}  // namespace careen
