#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "support/closed_forms.h"
#include "support/oracle_runs.h"
#include "support/quad_scene.h"

// Exact solutions of boxes that rotate about an edge without slipping: rocking, tipping, falling over a
// table's edge.
namespace careen::oracle {

/// A body rotating about a fixed axis under gravity: β'' = A cos β − B sin β, integrated by its Taylor
/// series: with S = sin β and C = cos β, S' = C β' and C' = −S β'.
class QuadPendulum {
 public:
  QuadPendulum(const Quad& a, const Quad& b, const Quad& angle, const Quad& rate)
      : a_(a), b_(b), angle_(angle), rate_(rate) {}

  const Quad& angle() const { return angle_; }
  const Quad& rate() const { return rate_; }

  void advance(const Quad& duration) {
    for (Quad left = duration; left > 0;) {
      const Series series = expanded();
      const Quad step = left < series.reach ? left : series.reach;
      angle_ = valueOf(series.angle, step);
      rate_ = slopeOf(series.angle, step);
      left -= step;
    }
  }

  /// Advances to the angle `to`, which must be reached in the initial direction; returns the time needed
  /// [s].
  Quad advanceTo(const Quad& to) {
    Quad time = 0;
    for (int step = 0; step < 10000; ++step) {
      const Series series = expanded();
      const Quad end = valueOf(series.angle, series.reach);
      const bool up = to > angle_;
      // Past it, perhaps turned round beyond it: the first root is the only one on the way out.
      if (up ? end >= to : end <= to) {
        const Quad root = rootOf(series, to);
        angle_ = to;
        rate_ = slopeOf(series.angle, root);
        return time + root;
      }
      time += series.reach;
      rate_ = slopeOf(series.angle, series.reach);
      angle_ = end;
    }
    throw std::runtime_error("does not come to that angle");
  }

 private:
  static constexpr std::size_t kOrder = 30;
  using Terms = std::array<Quad, kOrder + 1>;
  struct Series {
    Terms angle;
    Quad reach;  // [s]
  };

  Series expanded() const {
    Series series;
    Terms sine;
    Terms cosine;
    Terms rate;
    series.angle[0] = angle_;
    rate[0] = rate_;
    sine[0] = sin(angle_);
    cosine[0] = cos(angle_);
    for (std::size_t n = 0; n < kOrder; ++n) {
      const auto next = static_cast<int>(n) + 1;
      Quad sineSum = 0;
      Quad cosineSum = 0;
      for (std::size_t j = 0; j <= n; ++j) {
        sineSum += cosine[j] * rate[n - j];
        cosineSum -= sine[j] * rate[n - j];
      }
      series.angle[n + 1] = rate[n] / next;
      rate[n + 1] = (a_ * cosine[n] - b_ * sine[n]) / next;
      sine[n + 1] = sineSum / next;
      cosine[n + 1] = cosineSum / next;
    }
    // |β''| ≤ k²: everything rotates by less than a radian in 1/k and in 1/|β'|, where the terms decrease by
    // 2⁻⁴ each.
    const Quad k = sqrt(sqrt(a_ * a_ + b_ * b_));
    series.reach = 1 / (16 * (k + abs(rate_)));
    return series;
  }
  static Quad valueOf(const Terms& terms, const Quad& t) {
    Quad sum = terms[kOrder];
    for (std::size_t n = kOrder; n-- > 0;) {
      sum = sum * t + terms[n];
    }
    return sum;
  }
  static Quad slopeOf(const Terms& terms, const Quad& t) {
    Quad sum = 0;
    for (std::size_t n = kOrder; n > 0; --n) {
      sum = sum * t + static_cast<int>(n) * terms[n];
    }
    return sum;
  }
  // Bisection to where Newton's method is safe.
  static Quad rootOf(const Series& series, const Quad& to) {
    const bool up = valueOf(series.angle, series.reach) > to;
    Quad low = 0;
    Quad high = series.reach;
    for (int i = 0; i < 12; ++i) {
      const Quad middle = (low + high) / 2;
      ((valueOf(series.angle, middle) > to) == up ? high : low) = middle;
    }
    Quad root = (low + high) / 2;
    for (int i = 0; i < 8; ++i) {
      root -= (valueOf(series.angle, root) - to) / slopeOf(series.angle, root);
    }
    return root;
  }

  Quad a_;
  Quad b_;
  Quad angle_;
  Quad rate_;
};

/// A box that rotates from rest about a fixed line along one of its own axes: an inverted pendulum. It
/// neither slips nor lifts off as long as the contact force stays in the friction cone; check with
/// `forceAt`.
class QuadPivot {
 public:
  /// `point` [m] on the line; `line`: the box axis 0…2 along it; `angles` are positive about it.
  QuadPivot(const QuadBox& box, const QuadVector& gravity, const QuadVector& point, std::size_t line)
      : box_(box), gravity_(gravity), point_(point), arm_(box.position - point) {
    QuadVector own = QuadVector::Zero();
    own[static_cast<Eigen::Index>(line)] = 1;
    axis_ = turned(box.attitude, own);
    arm_ -= axis_.dot(arm_) * axis_;
    point_ = box.position - arm_;
    const Quad perMass = box.mass / (box.moments.at(line) + box.mass * arm_.squaredNorm());
    across_ = axis_.cross(arm_);
    a_ = perMass * gravity.dot(across_);
    b_ = perMass * gravity.dot(arm_);
  }

  const Quad& a() const { return a_; }
  const Quad& b() const { return b_; }
  QuadPendulum fromRest() const { return {a_, b_, Quad(0), Quad(0)}; }

  QuadPose pose(const Quad& angle) const {
    return {point_ + turnedArm(angle), times(turnAbout(axis_, angle), box_.attitude)};
  }
  QuadPoses poses(std::span<const double> times) const {
    QuadPendulum pendulum = fromRest();
    Quad now = 0;
    QuadPoses poses;
    for (const double time : times) {
      pendulum.advance(Quad(time) - now);
      now = time;
      poses.push_back(pose(pendulum.angle()));
    }
    return poses;
  }
  /// [N/kg] force of the line's support.
  QuadVector forceAt(const QuadPendulum& pendulum) const {
    const Quad& angle = pendulum.angle();
    const QuadVector arm = turnedArm(angle);
    const Quad turning = a_ * cos(angle) - b_ * sin(angle);
    return QuadVector(turning * axis_.cross(arm) - pendulum.rate() * pendulum.rate() * arm - gravity_);
  }

 private:
  QuadVector turnedArm(const Quad& angle) const { return cos(angle) * arm_ + sin(angle) * across_; }

  QuadBox box_;
  QuadVector gravity_;
  QuadVector point_;
  QuadVector arm_;  // [m] from the line to the centre at the start
  QuadVector axis_;
  QuadVector across_;  // axis × arm
  Quad a_;
  Quad b_;
};

/// A box on a slope that descends towards +x, about its lower edge along its own y.
inline QuadPivot aboutLowerEdge(const QuadBox& box, const QuadVector& gravity) {
  const QuadVector edge(box.halfExtents[0], Quad(0), Quad(-box.halfExtents[2]));
  return {box, gravity, box.position + turned(box.attitude, edge), 1};
}

/// A box on an upright, fixed table, about the table's edge at +x, along its own y.
inline QuadPivot overEdge(const QuadBox& table, const QuadBox& box, const QuadVector& gravity) {
  QuadVector edge = table.position;
  edge[0] += table.halfExtents[0];
  edge[2] += table.halfExtents[2];
  return {box, gravity, edge, 1};
}

/// A block that rocks on its two lower edges without slipping or bouncing, on the floor z = 0, about the
/// world's y: a pendulum on one edge. The angular momentum about the landing edge is conserved (G. W. Housner
/// 1963), so each impact multiplies ω by 1 − 2 m b²/(I + m R²); of a solid block this is 1 − 1.5 sin²α, tan α
/// = b/h.
class QuadRocking {
 public:
  QuadRocking(const QuadBox& box, const Quad& gravity)
      : half_(box.halfExtents[0]),
        height_(box.halfExtents[2]),
        slenderness_(atan2(half_, height_)),
        reach_(sqrt(half_ * half_ + height_ * height_)),
        squareGyration_(reach_ * reach_ + box.moments[1] / box.mass),
        squareRate_(gravity * reach_ / squareGyration_),
        tilt_(2 * atan2(box.attitude[2], box.attitude[0])) {
    if (box.attitude[1] != 0 || box.attitude[3] != 0 || box.momentum[1] != 0 || tilt_ == 0) {
      throw std::invalid_argument("no block that starts tilted about y, at rest");
    }
    side_ = tilt_ > 0 ? 1 : -1;
    tilt_ *= side_;
    place_ = box.position;
    place_[0] -= side_ * (half_ - reach_ * sin(slenderness_ - tilt_));
  }

  /// Factor of ω at an impact.
  Quad ratio() const { return 1 - 2 * half_ * half_ / squareGyration_; }
  const Quad& slenderness() const { return slenderness_; }
  /// [1/s²] θ'' = −p² sin(α − θ).
  const Quad& squareRate() const { return squareRate_; }
  const Quad& startTilt() const { return tilt_; }

  /// θ measured from the side it leans to: θ'' = −p² (sin α cos θ − cos α sin θ).
  QuadPendulum pendulum(const Quad& tilt, const Quad& rate) const {
    return {Quad(-squareRate_ * sin(slenderness_)), Quad(-squareRate_ * cos(slenderness_)), tilt, rate};
  }

  /// [s] times of the first impacts.
  std::vector<Quad> impacts(int count) const {
    std::vector<Quad> times;
    QuadPendulum now = pendulum(tilt_, Quad(0));
    Quad time = now.advanceTo(Quad(0));
    for (int k = 0; k < count; ++k) {
      times.push_back(time);
      now = pendulum(Quad(0), Quad(-now.rate() * ratio()));
      time += halfSwing(now);
    }
    return times;
  }

  QuadPoses poses(std::span<const double> moments) const {
    QuadPoses poses;
    int side = side_;
    Quad started = 0;
    QuadPendulum start = pendulum(tilt_, Quad(0));
    QuadPendulum end = start;
    Quad ends = end.advanceTo(Quad(0));
    for (const double moment : moments) {
      while (Quad(moment) > ends) {
        started = ends;
        start = pendulum(Quad(0), Quad(-end.rate() * ratio()));
        end = start;
        ends += halfSwing(end);
        side = -side;
      }
      QuadPendulum there = start;
      there.advance(Quad(moment) - started);
      poses.push_back(pose(side, there.angle()));
    }
    return poses;
  }

 private:
  // Up and down again; the way down mirrors the way up, so it lands with the initial rate.
  Quad halfSwing(QuadPendulum& now) const {
    const Quad rate = now.rate();
    // θ at the top: cos(α − θ) = cos α + θ'²/(2p²).
    const Quad sine = sin(slenderness_);
    const Quad rise = rate * rate / (2 * squareRate_);
    const Quad rest = sine * sine - 2 * cos(slenderness_) * rise - rise * rise;  // sin²(α − θ)
    if (rest <= 0) {
      throw std::invalid_argument("it falls over");
    }
    const Quad top = slenderness_ - atan2(sqrt(rest), Quad(cos(slenderness_) + rise));
    QuadPendulum down = pendulum(top, Quad(0));
    const Quad time = 2 * down.advanceTo(Quad(0));
    now = pendulum(Quad(0), Quad(-rate));
    return time;
  }
  QuadPose pose(int side, const Quad& tilt) const {
    const QuadVector y(Quad(0), Quad(1), Quad(0));
    QuadVector position = place_;
    position[0] += side * (half_ - reach_ * sin(slenderness_ - tilt));
    position[2] = reach_ * cos(slenderness_ - tilt);
    return {position, turnAbout(y, side * tilt)};
  }

  Quad half_;            // [m] b
  Quad height_;          // [m] h
  Quad slenderness_;     // [rad] α
  Quad reach_;           // [m] from edge to centre
  Quad squareGyration_;  // [m²] moment of inertia about the edge, over the mass
  Quad squareRate_;      // [1/s²] p²
  Quad tilt_;            // [rad] at the start, towards side_
  int side_ = 1;
  QuadVector place_;  // [m] centre when upright
};

}  // namespace careen::oracle
