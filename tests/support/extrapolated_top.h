#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "support/quad_scene.h"

namespace careen::oracle {

/// A second oracle of torque-free rotation, independent of the Taylor series in equations and method: only
/// the attitude, by q' = ½ ω q with ω = A I⁻¹ Aᵀ L in the world, L constant; the midpoint rule, extrapolated
/// to step 0 (W. B. Gragg 1965; R. Bulirsch, J. Stoer 1966). In 192 bits, because extrapolation amplifies
/// rounding errors.
class ExtrapolatedTop {
 public:
  explicit ExtrapolatedTop(const QuadBox& box)
      : moments_(converted<Bits192>(box.moments)), attitude_(normalized(converted<Bits192>(box.attitude))) {
    const std::array<Bits192, 3> momentum = converted<Bits192>(box.momentum);
    angularMomentum_ = matrix(attitude_) * Vector3<Bits192>(momentum[0], momentum[1], momentum[2]);
  }

  QuadTurn attitude() const { return converted<Quad>(attitude_); }

  void advance(const Quad& duration) {
    // |L|/I, with I the smallest moment, bounds how fast the rate can change: with this many columns the
    // remainder of such a step is below rounding. Not suited to a needle, whose bound is far above its spin.
    Bits192 smallest = moments_[0];
    for (const Bits192& moment : moments_) {
      smallest = moment < smallest ? moment : smallest;
    }
    const Bits192 longest = Bits192(kStep) * smallest / angularMomentum_.norm();
    auto left = static_cast<Bits192>(duration);
    while (left > 0) {
      const Bits192 step = left < longest ? left : longest;
      attitude_ = normalized(extrapolated(step));
      left -= step;
    }
  }

 private:
  static constexpr std::size_t kColumns = 18;
  static constexpr double kStep = 0.5;

  // Aitken–Neville in the square of the midpoint rule's step.
  Turn<Bits192> extrapolated(const Bits192& step) const {
    std::array<Turn<Bits192>, kColumns> row;
    for (std::size_t k = 0; k < kColumns; ++k) {
      Turn<Bits192> above = row[0];
      row[0] = midpoints(step, intervals(k));
      for (std::size_t j = 1; j <= k; ++j) {
        const Bits192 ratio = Bits192(intervals(k)) / Bits192(intervals(k - j));
        const Bits192 weight = ratio * ratio - 1;
        const Turn<Bits192> kept = row[j];
        for (std::size_t i = 0; i < 4; ++i) {
          row[j][i] = row[j - 1][i] + (row[j - 1][i] - above[i]) / weight;
        }
        above = kept;
      }
    }
    return row[kColumns - 1];
  }
  static int intervals(std::size_t column) { return 2 * (static_cast<int>(column) + 1); }

  // Gragg's midpoint rule, whose error has only even powers of the step.
  Turn<Bits192> midpoints(const Bits192& duration, int count) const {
    const Bits192 h = duration / count;
    Turn<Bits192> before = attitude_;
    Turn<Bits192> now = moved(attitude_, h, rate(attitude_));
    for (int i = 1; i < count; ++i) {
      const Turn<Bits192> next = moved(before, 2 * h, rate(now));
      before = now;
      now = next;
    }
    const Turn<Bits192> last = rate(now);
    for (std::size_t i = 0; i < 4; ++i) {
      now[i] = (now[i] + before[i] + h * last[i]) / 2;
    }
    return now;
  }

  static Turn<Bits192> moved(const Turn<Bits192>& q, const Bits192& h, const Turn<Bits192>& rate) {
    return {q[0] + h * rate[0], q[1] + h * rate[1], q[2] + h * rate[2], q[3] + h * rate[3]};
  }

  static Matrix3<Bits192> matrix(const Turn<Bits192>& q) {
    const auto& [w, x, y, z] = q;
    const Bits192 s = 2 / (w * w + x * x + y * y + z * z);
    Matrix3<Bits192> m;
    m << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
        s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),   //
        s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
    return m;
  }

  // ½ ω q, for q of any length.
  Turn<Bits192> rate(const Turn<Bits192>& q) const {
    const Matrix3<Bits192> worldFromBody = matrix(q);
    Vector3<Bits192> inBody = worldFromBody.transpose() * angularMomentum_;
    for (int i = 0; i < 3; ++i) {
      inBody[i] /= 2 * moments_[static_cast<std::size_t>(i)];
    }
    const Vector3<Bits192> half = worldFromBody * inBody;
    return times(Turn<Bits192>{Bits192(0), half[0], half[1], half[2]}, q);
  }

  std::array<Bits192, 3> moments_;
  Turn<Bits192> attitude_;
  Vector3<Bits192> angularMomentum_;
};

}  // namespace careen::oracle
