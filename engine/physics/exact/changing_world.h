#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// A world that changes at moments: its gravity, what is driven, the efforts of its motors at each sample of
/// its control, and what lets go has no load any more.
class ChangingWorld {
 public:
  explicit ChangingWorld(const World& world);

  const World& world() const { return world_; }
  /// [s] When gravity changes next, or begins to in another way, or something driven jumps to another speed.
  double nextJump() const { return std::min(nextGravity(), nextPart_); }
  /// That moment comes.
  void jump();

  /// [s] The next moment at which joints change.
  double next() const { return std::min(nextSample(), nextRelease_); }
  /// The next one of a joint: when its forces jump.
  double nextOf(int joint) const;
  /// That moment comes, with all bodies in these states.
  void change(std::span<const BodyState> states, Recorder& recorder);

 private:
  double nextGravity() const;  // [s]
  void findNextPart(double after);
  double nextSample() const;  // [s]
  void sample(double time, std::span<const BodyState> states, Recorder& recorder);
  std::vector<JointEffort> release(double time);

  World world_;  // whose changes of gravity are those to come
  double nextPart_ = std::numeric_limits<double>::infinity();
  std::vector<JointSample> samples_;  // by joint, of the last sample
  std::vector<char> isDriven_;        // by joint: its effort may change
  std::int64_t sampled_ = 0;          // how often
  double nextRelease_ = std::numeric_limits<double>::infinity();
  double changed_ = -std::numeric_limits<double>::infinity();  // [s] when, last
};

}  // namespace careen
