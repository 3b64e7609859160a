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

template <class Vector>
Vector cubicAt(const std::array<Vector, 4>& c, double s) {
  return ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
}

}  // namespace

// The quaternions of one path keep their sign: those of the cubic are compared as they are. From the last
// sample on: it is the first to be missed.
bool MergedSteps::follows(const CrowdStep& step, double radius) const {
  for (std::size_t k = count_; k-- > 0;) {
    const double s = samples_[k].elapsed / step.duration;
    const double off = (cubicAt(step.position, s) - samples_[k].position).norm();
    if (!(off <= within_)) {
      return false;
    }
    const Quat there = Quat(cubicAt(step.worldFromBody, s)).normalized();
    const double turn = 2 * (there.conjugate() * Quat(samples_[k].worldFromBody)).vec().norm();
    if (!(off + radius * turn <= within_)) {
      return false;
    }
  }
  return true;
}

MergedSteps::Sample MergedSteps::middleOf(const StepEnd& from, const StepEnd& to, double length) {
  const CrowdStep step = cubicStep(from, to, length);
  const double s = 0.5 * length / step.duration;
  return {.elapsed = 0.5 * length,
          .position = cubicAt(step.position, s),
          .worldFromBody = Quat(cubicAt(step.worldFromBody, s)).normalized().coeffs()};
}

void MergedSteps::add(Recorder& recorder, BodyIndex body, double time, const StepEnd& from, const StepEnd& to,
                      double length, double radius) {
  Sample middle = middleOf(from, to, length);
  if (length_ > 0 && count_ < kMost && from.position == to_.position) {
    samples_[count_++] = {
        .elapsed = length_, .position = from.position, .worldFromBody = from.worldFromBody.coeffs()};
    middle.elapsed += length_;
    samples_[count_++] = middle;
    if (follows(cubicStep(from_, to, length_ + length), radius)) {
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
