#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "trajectory/trajectory.h"

namespace careen {

/// The file between `simulate` and `render` (.careen). Little-endian; doubles exact. In order: a magic word,
/// the format's version, scene text and its hash, method, step, duration, the run's figures, its world, stage
/// and plan, every body's segments, the impacts, the state hash, and a checksum of all before it.
std::string encodeTrajectory(const Trajectory& trajectory);

/// What a scene's text makes for a run with those settings.
using SetupReader = std::function<RunSetup(const std::string& sceneText, const RunSettings& settings)>;

/// InputError if the bytes are no trajectory, of another version, cut short or changed, or if what they say
/// does not hang together (run_check.h). `name` stands for the file in messages. Files of version 3 hold no
/// world and no stage: `setupOf` is asked for them, and without it they are refused.
Trajectory decodeTrajectory(const std::string& bytes, const std::string& name,
                            const SetupReader& setupOf = {});

/// Whether the bytes begin as a trajectory file does, whatever the file's name ends in.
bool looksLikeTrajectory(const std::string& bytes);

Trajectory readTrajectory(const std::filesystem::path& path);

}  // namespace careen
