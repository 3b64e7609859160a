#include "physics/motion/merged_steps.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

// [1] of the bound, as a power of two: the grid to which coefficients are rounded.
constexpr int kGrid = -24;

template <class Vectors>
void roundTo(double grid, Vectors& coefficients) {
  for (auto& coefficient : coefficients) {
    for (double& x : coefficient) {
      x = std::rint(x / grid) * grid;
    }
  }
}

}  // namespace

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

MergedSteps::Sample MergedSteps::middleOf(const StepEnd& from, const StepEnd& to, double length) {
  const ContactStep step = asContactStep(cubicStep(from, to, length));
  return {.elapsed = 0.5 * length,
          .position = positionAt(step, 0.5 * length),
          .worldFromBody = attitudeAt(step, 0.5 * length).coeffs()};
}

void MergedSteps::add(Recorder& recorder, BodyIndex body, double time, const StepEnd& from, const StepEnd& to,
                      double length, double radius) {
  Sample middle = middleOf(from, to, length);
  if (length_ > 0 && count_ < kMost && from.position == to_.position) {
    samples_[count_++] = {
        .elapsed = length_, .position = from.position, .worldFromBody = from.worldFromBody.coeffs()};
    middle.elapsed += length_;
    samples_[count_++] = middle;
    if (follows(asContactStep(cubicStep(from_, to, length_ + length)), radius)) {
      to_ = to;
      length_ += length;
      return;
    }
    count_ -= 2;
    middle.elapsed -= length_;
  }
  flush(recorder, body);
  time_ = time;
  from_ = from;
  to_ = to;
  length_ = length;
  samples_[count_++] = middle;
}

void MergedSteps::flush(Recorder& recorder, BodyIndex body) {
  if (length_ > 0) {
    CrowdStep step = cubicStep(from_, to_, length_);
    if (within_ > 0) {
      int exponent = 0;
      std::frexp(within_, &exponent);
      const double grid = std::ldexp(1.0, exponent - 1 + kGrid);  // a power of two
      roundTo(grid, step.position);
      roundTo(grid, step.worldFromBody);
    }
    recorder.moves(body, time_, step);
  }
  length_ = 0;
  count_ = 0;
}

}  // namespace careen
