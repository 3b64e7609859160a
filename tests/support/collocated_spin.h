#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "support/quad_scene.h"

namespace careen::oracle {

/// A second oracle of a box that slides and spins to a stop, independent of SlidingSpin in variables and
/// method: world velocities against time, the four loads from one system of four equations, and collocation
/// at Gauss points, of order 20. Steps are a fraction of the time left, so they shrink towards the stop and
/// come arbitrarily close.
class CollocatedSpin {
 public:
  CollocatedSpin(const QuadBox& box, const Quad& gravity, const Quad& friction)
      : gravity_(gravity), friction_(friction), half_(box.halfExtents), gyration_(box.moments[2] / box.mass) {
    const Quad angle = 2 * atan2(box.attitude[3], box.attitude[0]);
    const Quad spin = box.momentum[2] / box.moments[2];
    state_ = {box.position[0], box.position[1], angle, box.velocity[0], box.velocity[1], spin};
    findPoints();
  }

  const Quad& time() const { return time_; }
  /// x, y [m], angle [rad], and their rates.
  const std::array<Quad, 6>& state() const { return state_; }

  void advanceTo(const Quad& until) {
    while (time_ < until) {
      const Quad step = left() / 4;
      const Quad rest = until - time_;
      advance(step < rest ? step : rest);
    }
  }
  /// Advances until the speed is this fraction of the initial one.
  void advanceToStop(const Quad& part) {
    const Quad end = part * speed();
    while (speed() > end) {
      advance(left() / 4);
    }
  }

 private:
  static constexpr std::size_t kStages = 10;
  using State = std::array<Quad, 6>;

  Quad speed() const {
    return sqrt(state_[3] * state_[3] + state_[4] * state_[4] + gyration_ * state_[5] * state_[5]);
  }
  // [s] until the box, or one of its corners, stops at the present deceleration.
  Quad left() const {
    const State now = rate(state_);
    Quad left = speed() / sqrt(now[3] * now[3] + now[4] * now[4] + gyration_ * now[5] * now[5]);
    const Quad cosine = cos(state_[2]);
    const Quad sine = sin(state_[2]);
    for (int i = 0; i < 4; ++i) {
      const Quad x = i % 2 == 0 ? half_[0] : Quad(-half_[0]);
      const Quad y = i < 2 ? half_[1] : Quad(-half_[1]);
      const QuadVector arm(cosine * x - sine * y, sine * x + cosine * y, Quad(0));
      const QuadVector spin(Quad(0), Quad(0), state_[5]);
      const QuadVector slip = QuadVector(state_[3], state_[4], Quad(0)) + spin.cross(arm);
      const QuadVector change = QuadVector(now[3], now[4], Quad(0)) +
                                QuadVector(Quad(0), Quad(0), now[5]).cross(arm) + spin.cross(spin.cross(arm));
      const Quad until = slip.norm() / change.norm();
      left = until < left ? until : left;
    }
    return left;
  }

  // Roots of the Legendre polynomial, shifted to 0…1, and ∫₀^cᵢ of the Lagrange polynomials, each i from a
  // system of equations: their values at the powers of t.
  void findPoints() {
    using Matrix = Eigen::Matrix<Bits192, kStages, kStages>;
    Matrix powers;
    for (std::size_t i = 0; i < kStages; ++i) {
      Bits192 x = cos(Bits192(3.14159265358979) * (Bits192(i) + Bits192(0.75)) / (Bits192(kStages) + 0.5));
      for (int newton = 0; newton < 12; ++newton) {
        Bits192 before = 1;
        Bits192 now = x;
        for (int n = 1; n < static_cast<int>(kStages); ++n) {
          const Bits192 next = ((2 * n + 1) * x * now - n * before) / (n + 1);
          before = now;
          now = next;
        }
        x -= now * (x * x - 1) / (static_cast<int>(kStages) * (x * now - before));
      }
      points_.at(i) = static_cast<Quad>((x + 1) / 2);
      Bits192 power = 1;
      for (std::size_t k = 0; k < kStages; ++k) {
        powers(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = power;
        power *= (x + 1) / 2;
      }
    }
    const Eigen::PartialPivLU<Matrix> solver(powers);
    const auto weightsTo = [&](const Bits192& end) {
      Eigen::Matrix<Bits192, kStages, 1> integrals;
      Bits192 power = end;
      for (std::size_t k = 0; k < kStages; ++k) {
        integrals(static_cast<Eigen::Index>(k)) = power / static_cast<int>(k + 1);
        power *= end;
      }
      const Eigen::Matrix<Bits192, kStages, 1> found = solver.solve(integrals);
      std::array<Quad, kStages> weights;
      for (std::size_t k = 0; k < kStages; ++k) {
        weights.at(k) = static_cast<Quad>(found(static_cast<Eigen::Index>(k)));
      }
      return weights;
    };
    for (std::size_t i = 0; i < kStages; ++i) {
      inner_.at(i) = weightsTo(Bits192(points_.at(i)));
    }
    outer_ = weightsTo(Bits192(1));
  }

  State rate(const State& q) const {
    const Quad cosine = cos(q[2]);
    const Quad sine = sin(q[2]);
    Eigen::Matrix<Quad, 4, 4> balance;
    std::array<QuadVector, 4> arms;
    std::array<QuadVector, 4> slips;
    for (int i = 0; i < 4; ++i) {
      const Quad x = i % 2 == 0 ? half_[0] : Quad(-half_[0]);
      const Quad y = i < 2 ? half_[1] : Quad(-half_[1]);
      QuadVector& arm = arms.at(static_cast<std::size_t>(i));
      QuadVector& slip = slips.at(static_cast<std::size_t>(i));
      arm = QuadVector(cosine * x - sine * y, sine * x + cosine * y, Quad(-half_[2]));
      slip = QuadVector(q[3] - q[5] * arm[1], q[4] + q[5] * arm[0], Quad(0));
      slip /= slip.norm();
      // One newton upward on this corner, with its friction: sum and moments; and the load pattern without
      // moment, whose amount must be 0.
      const QuadVector force = QuadVector(Quad(0), Quad(0), Quad(1)) - friction_ * slip;
      const QuadVector moment = arm.cross(force);
      balance.col(i) << Quad(1), moment[0], moment[1], Quad(i == 0 || i == 3 ? 1 : -1);
    }
    const Eigen::Matrix<Quad, 4, 1> right(gravity_, Quad(0), Quad(0), Quad(0));
    const Eigen::Matrix<Quad, 4, 1> loads = balance.partialPivLu().solve(right);
    QuadVector force = QuadVector::Zero();
    Quad moment = 0;
    for (int i = 0; i < 4; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const QuadVector rubs = -friction_ * loads(i) * slips.at(at);
      force += rubs;
      moment += arms.at(at).cross(rubs)[2];
    }
    return {q[3], q[4], q[5], force[0], force[1], moment / gyration_};
  }

  void advance(const Quad& step) {
    std::array<State, kStages> rates;
    rates.fill(rate(state_));
    // Each iteration reduces the error by about a tenth of the step's fraction.
    for (int round = 0; round < 60; ++round) {
      Quad change = 0;
      for (std::size_t i = 0; i < kStages; ++i) {
        const State next = rate(sum(inner_.at(i), rates, step));
        for (std::size_t k = 3; k < next.size(); ++k) {
          const Quad by = abs(Quad(next.at(k) - rates.at(i).at(k)));
          change = by > change ? by : change;
        }
        rates.at(i) = next;
      }
      if (change < Quad(1e-32) * gravity_) {
        break;
      }
    }
    state_ = sum(outer_, rates, step);
    time_ += step;
  }
  State sum(const std::array<Quad, kStages>& weights, const std::array<State, kStages>& rates,
            const Quad& step) const {
    State result = state_;
    for (std::size_t k = 0; k < result.size(); ++k) {
      Quad total = 0;
      for (std::size_t i = 0; i < kStages; ++i) {
        total += weights.at(i) * rates.at(i).at(k);
      }
      result.at(k) += step * total;
    }
    return result;
  }

  Quad gravity_;
  Quad friction_;
  QuadVector half_;
  Quad gyration_;  // [m²] I/m
  std::array<Quad, kStages> points_;
  std::array<std::array<Quad, kStages>, kStages> inner_;
  std::array<Quad, kStages> outer_;
  State state_;
  Quad time_ = 0;
};

}  // namespace careen::oracle
