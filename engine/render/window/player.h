#pragma once

#include <cstdint>

#include "stage/frame_rate.h"

namespace careen {

/// Decides which frame of a film is shown when. Frames are dropped if there is no time for them, so that the
/// film plays in real time. Times are [s] of any monotonic clock; commands take effect from the last
/// update().
class Player {
 public:
  /// Starts paused at the first frame. `frameCount` is at least 1.
  Player(FrameRate rate, std::int64_t frameCount);

  std::int64_t frame() const { return frame_; }
  std::int64_t lastFrame() const { return last_; }
  double time() const { return rate_.frameTime(frame_); }  ///< [s] of the film
  bool isPlaying() const { return playing_; }

  /// Advances to the frame that is due; pauses at the last.
  void update(double now);
  /// Time until the next frame is due [s]; 0 if it is due or the player is paused.
  double secondsToNext() const;

  /// Plays or pauses; at the last frame, plays from the first.
  void toggle();
  /// Pauses and moves by this many frames, forward or back.
  void step(std::int64_t frames);
  /// Goes to a fraction of the film, 0 first frame … 1 last; keeps playing if it was.
  void seek(double part);
  /// Goes to the frame nearest to a film time [s]; likewise.
  void seekTime(double filmTime);
  double part() const;  ///< current position, 0 … 1

 private:
  void goTo(std::int64_t frame);

  FrameRate rate_;
  std::int64_t last_;
  std::int64_t frame_ = 0;
  bool playing_ = false;
  double now_ = 0;    // [s] of the last update
  double begun_ = 0;  // [s] when playing started at begunFrame_
  std::int64_t begunFrame_ = 0;
};

}  // namespace careen
