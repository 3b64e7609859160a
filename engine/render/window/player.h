#pragma once

#include <cstdint>

#include "stage/frame_rate.h"

namespace careen {

/// What a window that plays a film shows when. It shows nothing but the film's frames; those that there is no
/// time for are left out, so that the film takes as long as it should. Times are [s] of any clock that does
/// not go back; all commands count from the last update().
class Player {
 public:
  /// Stands at the first frame, paused. There is one at least.
  Player(FrameRate rate, std::int64_t frameCount);

  std::int64_t frame() const { return frame_; }
  std::int64_t lastFrame() const { return last_; }
  double time() const { return rate_.frameTime(frame_); }  ///< [s] of the film
  bool isPlaying() const { return playing_; }

  /// Goes on to the frame that is due; pauses at the last.
  void update(double now);
  /// Until the next frame is due [s]; 0 if it is, or if nothing plays.
  double secondsToNext() const;

  /// Plays or pauses; at the last frame it plays from the first.
  void toggle();
  /// Pauses, so many frames further or back.
  void step(std::int64_t frames);
  /// To a part of the film, 0 first frame … 1 last; plays on if it played.
  void seek(double part);
  /// To the frame nearest to a film time [s]; likewise.
  void seekTime(double filmTime);
  double part() const;  ///< where it is, 0 … 1

 private:
  void goTo(std::int64_t frame);

  FrameRate rate_;
  std::int64_t last_;
  std::int64_t frame_ = 0;
  bool playing_ = false;
  double now_ = 0;    // [s] of the last update
  double begun_ = 0;  // [s] when playing began at begunFrame_
  std::int64_t begunFrame_ = 0;
};

}  // namespace careen
