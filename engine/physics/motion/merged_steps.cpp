#include "physics/motion/merged_steps.h"

#include <algorithm>

namespace careen {

// The quaternions of one path keep their sign: those of the cubic are compared as they are.
bool MergedSteps::follows(const ContactStep& step, double radius) const {
  return std::all_of(
      samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(count_), [&](const Sample& sample) {
        const Quat there = attitudeAt(step, sample.elapsed);
        const Quat turned(sample.worldFromBody);
        const double turn = 2 * (there.conjugate() * turned).vec().norm();
        return (positionAt(step, sample.elapsed) - sample.position).norm() + radius * turn <= within_;
      });
}

void MergedSteps::add(Recorder& recorder, BodyIndex body, double time, const StepEnd& from, const StepEnd& to,
                      double length, double radius) {
  const bool continues = length_ > 0 && count_ < kMost && from.velocity == to_.velocity &&
                         from.spinBody == to_.spinBody && from.position == to_.position;
  if (continues) {
    samples_[count_++] = {
        .elapsed = length_, .position = from.position, .worldFromBody = from.worldFromBody.coeffs()};
    if (follows(asContactStep(cubicStep(from_, to, length_ + length)), radius)) {
      to_ = to;
      length_ += length;
      return;
    }
    --count_;
  }
  flush(recorder, body);
  time_ = time;
  from_ = from;
  to_ = to;
  length_ = length;
}

void MergedSteps::flush(Recorder& recorder, BodyIndex body) {
  if (length_ > 0) {
    recorder.moves(body, time_, cubicStep(from_, to_, length_));
  }
  length_ = 0;
  count_ = 0;
}

}  // namespace careen
