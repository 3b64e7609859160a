#include "render/window/player.h"

#include <algorithm>
#include <cmath>

namespace careen {

Player::Player(FrameRate rate, std::int64_t frameCount)
    : rate_(rate), last_(std::max<std::int64_t>(frameCount, 1) - 1) {}

void Player::update(double now) {
  now_ = now;
  if (!playing_) {
    return;
  }
  // Limits the elapsed time to the film's length, so that hours (a suspended machine) do not overflow.
  const double whole = rate_.frameTime(last_ + 1);
  const double played = std::min(now_ - begun_, whole);
  const double frames =
      played * static_cast<double>(rate_.numerator) / static_cast<double>(rate_.denominator);
  frame_ = std::min(begunFrame_ + static_cast<std::int64_t>(frames), last_);
  playing_ = frame_ < last_;
}

double Player::secondsToNext() const {
  if (!playing_) {
    return 0;
  }
  return std::max(0.0, begun_ + rate_.frameTime(frame_ + 1 - begunFrame_) - now_);
}

void Player::toggle() {
  playing_ = !playing_ && last_ > 0;
  goTo(playing_ && frame_ == last_ ? 0 : frame_);
}

void Player::step(std::int64_t frames) {
  playing_ = false;
  goTo(frame_ + frames);
}

void Player::seek(double part) {
  goTo(std::llround(std::clamp(part, 0.0, 1.0) * static_cast<double>(last_)));
}

void Player::seekTime(double filmTime) {
  const double end = rate_.frameTime(last_);
  seek(end > 0 ? filmTime / end : 0);
}

double Player::part() const {
  return last_ > 0 ? static_cast<double>(frame_) / static_cast<double>(last_) : 0;
}

void Player::goTo(std::int64_t frame) {
  frame_ = std::clamp<std::int64_t>(frame, 0, last_);
  begunFrame_ = frame_;
  begun_ = now_;
}

}  // namespace careen
