#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "film/frame_range.h"
#include "trajectory/trajectory.h"
#include "truth/channels.h"

namespace careen {

struct TruthSettings {
  std::filesystem::path folder;
  std::vector<FrameRange> frames;  ///< empty: all
  ChannelSet channels;
  int jobs = 1;         ///< processes, each with one frame at a time
  std::string program;  ///< name and version
};

/// Writes the labels of a film's frames: 000000.npz, … (truth_frame.h) and, last and once, truth.json: names
/// to ids, sizes, masses, materials (as simulated: friction that nothing needs is 0), gravity, the camera's
/// matrix and its poses at the frames, impacts with their time, frame and pixel. Each file is whole or not
/// there. Returns how many frames were written. InputError for frames that the film does not have,
/// MachineError if a file cannot be written.
std::int64_t writeTruth(const Trajectory& run, const TruthSettings& settings,
                        const std::function<void(std::int64_t done, std::int64_t total)>& progress = {},
                        const std::stop_token& stop = {});

}  // namespace careen
