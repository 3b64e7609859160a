#pragma once

#include <filesystem>
#include <string>

#include "trajectory/trajectory.h"

namespace careen {

/// The file between `simulate` and `render` (.careen). Little-endian; doubles exact. In order: a magic word,
/// the format's version, scene text and its hash, method, step, duration, the run's figures, wall names,
/// every body's mass and segments, the impacts, the state hash, and a checksum of all before it.
std::string encodeTrajectory(const Trajectory& trajectory);

/// InputError if the bytes are no trajectory, of another version, cut short or changed. `name` stands for the
/// file in messages.
Trajectory decodeTrajectory(const std::string& bytes, const std::string& name);

/// Whether the bytes begin as a trajectory file does, whatever the file's name ends in.
bool looksLikeTrajectory(const std::string& bytes);

Trajectory readTrajectory(const std::filesystem::path& path);

}  // namespace careen
