#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "support/closed_forms.h"
#include "support/oracle_runs.h"
#include "support/quad_scene.h"

namespace careen::oracle {

/// A box that slides and spins, flat on a level floor with friction, until it stops. Model: the four corners
/// carry normal forces λᵢ ≥ 0 with friction μ λᵢ against each corner's own slip. The λᵢ add up to m g and
/// balance the moment of friction, which acts the half height c below the centre: Σ λᵢ ρᵢ = −c F. Of all
/// such forces the model takes those with least Σ λᵢ² for given F: λᵢ = m g/4 + β·ρᵢ, which four equal stiff
/// springs would also carry.
///
/// (Least Σ λᵢ² with F depending on λ would give other λᵢ when a box both slides and spins.)
///
/// The equations are homogeneous, of degree 0, in the velocities, which vanish together. So time is
/// transformed by dt = s dσ, with s² = vx² + vy² + (I/m) w²: then s decreases exponentially, nothing is
/// singular, and the stop is at σ → ∞; it is taken as reached at s = 1e-27 of the initial value, less than
/// that fraction of the whole away. In the body frame; the midpoint rule extrapolated to step 0, which costs
/// four of a Quad's 34 digits.
class SlidingSpin {
 public:
  SlidingSpin(const QuadBox& box, const Quad& gravity, const Quad& friction, double step = 0.5)
      : gravity_(gravity),
        friction_(friction),
        a_(box.halfExtents[0]),
        b_(box.halfExtents[1]),
        c_(box.halfExtents[2]),
        gyration_(box.moments[2] / box.mass),
        start_(box),
        step_(step) {
    if (box.momentum[0] != 0 || box.momentum[1] != 0 || box.velocity[2] != 0 || box.attitude[1] != 0 ||
        box.attitude[2] != 0) {
      throw std::invalid_argument("does not slide flat on a level floor");
    }
    const QuadVector slip = turned(inverse(box.attitude), box.velocity);
    state_ = {Real(0), Real(0), Real(0), Real(slip[0]), Real(slip[1]), Real(box.momentum[2] / box.moments[2]),
              Real(0)};
    first_ = speed(state_);
  }

  /// The pose at a time not before any asked for earlier.
  QuadPose pose(const Quad& time) {
    const Real until(time);
    while (state_[6] < until && !stopped()) {
      const Real whole = stepLength();
      const State next = advanced(state_, whole);
      if (next[6] <= until) {
        state_ = next;
        continue;
      }
      // Newton's method for the fraction of a step that ends at this time.
      Real part = whole * (until - state_[6]) / (next[6] - state_[6]);
      State there = advanced(state_, part);
      for (int i = 0; i < 50 && abs(there[6] - until) > Real(1e-32) * (1 + until); ++i) {
        part -= (there[6] - until) / speed(there);
        there = advanced(state_, part);
      }
      state_ = there;
      break;
    }
    return placed();
  }

  /// [s] time of the stop; runs to the end.
  Quad stop() {
    while (!stopped()) {
      state_ = advanced(state_, stepLength());
    }
    return static_cast<Quad>(state_[6]);
  }

  /// [1] the least λᵢ so far, relative to m g/4: a negative one would lift a corner.
  double leastLoad() const { return leastLoad_; }

 private:
  using Real = Quad;
  using State = std::array<Real, 7>;  // x y [m] from the start, in its frame; turn [rad]; vx vy in the
                                      // body frame, w; time
  static constexpr std::size_t kColumns = 13;

  Real speed(const State& q) const { return sqrt(q[3] * q[3] + q[4] * q[4] + gyration_ * q[5] * q[5]); }
  bool stopped() const { return speed(state_) < Real(1e-27) * first_; }
  // Step of σ: a fraction of what changes the whole slip, or that of a corner, by its own amount.
  Real stepLength() const {
    const Real& w = state_[5];
    const Real reach = sqrt(a_ * a_ + b_ * b_);
    const Real slows = friction_ * gravity_;
    const Real turns = abs(w) * speed(state_);
    Real least = speed(state_);
    for (unsigned i = 0; i < 4; ++i) {
      const Real x = state_[3] - ((i & 2U) == 0 ? w : Real(-w)) * b_;
      const Real y = state_[4] + ((i & 1U) == 0 ? w : Real(-w)) * a_;
      const Real slip = sqrt(x * x + y * y);
      least = slip < least ? slip : least;
    }
    const Real changes = slows * (1 + reach * reach / gyration_) + turns;
    return Real(step_) / (slows + turns + changes * speed(state_) / least / 4);
  }
  QuadPose placed() const {
    const QuadVector up(Quad(0), Quad(0), Quad(1));
    const QuadVector off(static_cast<Quad>(state_[0]), static_cast<Quad>(state_[1]), Quad(0));
    return {start_.position + turned(start_.attitude, off),
            times(turnAbout(up, static_cast<Quad>(state_[2])), start_.attitude)};
  }

  struct Friction {
    Real x = 0;     // [m/s²] F/m
    Real y = 0;     //
    Real turn = 0;  // [rad/s²]
  };
  Friction frictionAt(const Real& vx, const Real& vy, const Real& w) {
    std::array<std::array<Real, 4>, 4> corners;  // ρ and direction of slip
    Real xx = 4 * a_ * a_;
    Real yy = 4 * b_ * b_;
    Real xy = 0;
    Real yx = 0;
    Real sumX = 0;
    Real sumY = 0;
    const Real arm = c_ * friction_;
    for (std::size_t i = 0; i < 4; ++i) {
      const Real px = (i & 1U) == 0 ? a_ : Real(-a_);
      const Real py = (i & 2U) == 0 ? b_ : Real(-b_);
      Real ux = vx - w * py;
      Real uy = vy + w * px;
      const Real size = sqrt(ux * ux + uy * uy);
      ux /= size;
      uy /= size;
      corners[i] = {px, py, ux, uy};
      xx -= arm * ux * px;
      xy -= arm * ux * py;
      yx -= arm * uy * px;
      yy -= arm * uy * py;
      sumX += ux;
      sumY += uy;
    }
    const Real weight = gravity_ / 4;  // [N/kg]
    const Real det = xx * yy - xy * yx;
    const Real betaX = arm * weight * (yy * sumX - xy * sumY) / det;
    const Real betaY = arm * weight * (xx * sumY - yx * sumX) / det;
    Friction friction;
    for (const auto& [px, py, ux, uy] : corners) {
      const Real load = weight + betaX * px + betaY * py;
      leastLoad_ = std::fmin(leastLoad_, static_cast<double>(load / weight));
      friction.x -= friction_ * load * ux;
      friction.y -= friction_ * load * uy;
      friction.turn -= friction_ * load * (px * uy - py * ux) / gyration_;
    }
    return friction;
  }

  State rate(const State& q) {
    const Real s = speed(q);
    const Real cosine = cos(q[2]);
    const Real sine = sin(q[2]);
    const Friction friction = frictionAt(q[3], q[4], q[5]);
    return {s * (cosine * q[3] - sine * q[4]),
            s * (sine * q[3] + cosine * q[4]),
            s * q[5],
            s * (friction.x + q[5] * q[4]),
            s * (friction.y - q[5] * q[3]),
            s * friction.turn,
            s};
  }

  static int intervals(std::size_t column) { return 2 * (static_cast<int>(column) + 1); }
  static State moved(const State& q, const Real& h, const State& rate) {
    State result;
    for (std::size_t i = 0; i < q.size(); ++i) {
      result[i] = q[i] + h * rate[i];
    }
    return result;
  }
  State midpoints(const State& from, const Real& duration, int count) {
    const Real h = duration / count;
    State before = from;
    State now = moved(from, h, rate(from));
    for (int i = 1; i < count; ++i) {
      const State next = moved(before, 2 * h, rate(now));
      before = now;
      now = next;
    }
    const State last = moved(before, h, rate(now));
    for (std::size_t i = 0; i < now.size(); ++i) {
      now[i] = (now[i] + last[i]) / 2;
    }
    return now;
  }
  State advanced(const State& from, const Real& duration) {
    std::array<State, kColumns> row;
    for (std::size_t k = 0; k < kColumns; ++k) {
      State above = row[0];
      row[0] = midpoints(from, duration, intervals(k));
      for (std::size_t j = 1; j <= k; ++j) {
        const Real ratio = Real(intervals(k)) / Real(intervals(k - j));
        const Real weight = ratio * ratio - 1;
        const State kept = row[j];
        for (std::size_t i = 0; i < kept.size(); ++i) {
          row[j][i] = row[j - 1][i] + (row[j - 1][i] - above[i]) / weight;
        }
        above = kept;
      }
    }
    return row[kColumns - 1];
  }

  Real gravity_;
  Real friction_;
  Real a_;
  Real b_;
  Real c_;
  Real gyration_;  // [m²] I/m
  QuadBox start_;
  double step_;
  State state_;
  Real first_ = 0;
  double leastLoad_ = 1;
};

}  // namespace careen::oracle
