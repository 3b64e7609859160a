#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "support/quad_scene.h"

namespace careen::oracle {

/// A second oracle of free turning, which shares neither equations nor method with the Taylor series: the
/// attitude alone by q' = ½ ω q with ω = A I⁻¹ Aᵀ L in the world, L constant; the midpoint rule, extrapolated
/// to step 0 (W. B. Gragg 1965; R. Bulirsch, J. Stoer 1966).
class ExtrapolatedTop {
 public:
  explicit ExtrapolatedTop(const QuadBox& box) : moments_(box.moments), attitude_(box.attitude) {
    angularMomentum_ = turned(attitude_, {box.momentum[0], box.momentum[1], box.momentum[2]});
  }

  const QuadTurn& attitude() const { return attitude_; }

  void advance(const Quad& duration) {
    Quad left = duration;
    while (left > 0) {
      const QuadTurn turning = rate(attitude_);
      Quad squared = 0;
      for (const Quad& part : turning) {
        squared += part * part;
      }
      // Half a radian or so: with these columns the remainder is then under the rounding.
      const Quad longest = squared > 0 ? Quad(0.35) / sqrt(squared) : left;
      const Quad step = left < longest ? left : longest;
      attitude_ = normalized(extrapolated(step));
      left -= step;
    }
  }

 private:
  static constexpr std::size_t kColumns = 13;

  // Aitken–Neville in the square of the midpoint rule's step.
  QuadTurn extrapolated(const Quad& step) const {
    std::array<QuadTurn, kColumns> row;
    for (std::size_t k = 0; k < kColumns; ++k) {
      QuadTurn above = row[0];
      row[0] = midpoints(step, intervals(k));
      for (std::size_t j = 1; j <= k; ++j) {
        const Quad ratio = Quad(intervals(k)) / Quad(intervals(k - j));
        const Quad weight = ratio * ratio - 1;
        const QuadTurn kept = row[j];
        for (std::size_t i = 0; i < 4; ++i) {
          row[j][i] = row[j - 1][i] + (row[j - 1][i] - above[i]) / weight;
        }
        above = kept;
      }
    }
    return row[kColumns - 1];
  }
  static int intervals(std::size_t column) { return 2 * (static_cast<int>(column) + 1); }

  // Gragg's, whose error has only even powers of the step.
  QuadTurn midpoints(const Quad& duration, int count) const {
    const Quad h = duration / count;
    QuadTurn before = attitude_;
    QuadTurn now = moved(attitude_, h, rate(attitude_));
    for (int i = 1; i < count; ++i) {
      const QuadTurn next = moved(before, 2 * h, rate(now));
      before = now;
      now = next;
    }
    const QuadTurn last = rate(now);
    for (std::size_t i = 0; i < 4; ++i) {
      now[i] = (now[i] + before[i] + h * last[i]) / 2;
    }
    return now;
  }

  static QuadTurn moved(const QuadTurn& q, const Quad& h, const QuadTurn& rate) {
    return {q[0] + h * rate[0], q[1] + h * rate[1], q[2] + h * rate[2], q[3] + h * rate[3]};
  }

  QuadTurn rate(const QuadTurn& q) const {
    const auto& [w, x, y, z] = q;
    const Quad s = 2 / (w * w + x * x + y * y + z * z);
    const Matrix3<Quad> worldFromBody =
        (Matrix3<Quad>() << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),
         s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x), s * (x * z - w * y),
         s * (y * z + w * x), 1 - s * (x * x + y * y))
            .finished();
    QuadVector inBody = worldFromBody.transpose() * angularMomentum_;
    for (int i = 0; i < 3; ++i) {
      inBody[i] /= 2 * moments_[static_cast<std::size_t>(i)];
    }
    const QuadVector half = worldFromBody * inBody;
    return times({Quad(0), half[0], half[1], half[2]}, q);
  }

  std::array<Quad, 3> moments_;
  QuadTurn attitude_;
  QuadVector angularMomentum_;
};

}  // namespace careen::oracle
