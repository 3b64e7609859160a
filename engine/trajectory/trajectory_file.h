#pragma once

#include <filesystem>
#include <string>

#include "trajectory/exporter.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Trajectory file (.careen), from `simulate` to `render`. Little-endian; doubles exact. In order: magic
/// word, format version, the record in packed pieces of about 1 MB, each with its size before it and after
/// packing, and a checksum of all before it. The record: scene text and its hash, method, step, duration, the
/// run's figures, its world, stage and plan, every body's segments, the impacts, and the state hash. Writing
/// never has the file in memory as a whole; reading does.
void writeTrajectory(const Trajectory& trajectory, const TextSink& sink);
std::string encodeTrajectory(const Trajectory& trajectory);

/// InputError if the bytes are not a trajectory, of another version, truncated or modified, or inconsistent
/// (run_check.h). Every count is checked against the bytes that are left, and the run takes at most 2500
/// times the memory of the bytes. `name` stands for the file in messages.
Trajectory decodeTrajectory(const std::string& bytes, const std::string& name);

/// Whether the bytes begin like a trajectory file, whatever the file's extension.
bool looksLikeTrajectory(const std::string& bytes);

Trajectory readTrajectory(const std::filesystem::path& path);
/// All of the file, or none; MachineError.
void saveTrajectory(const Trajectory& trajectory, const std::filesystem::path& path);

}  // namespace careen
