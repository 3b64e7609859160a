#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "support/closed_forms.h"
#include "support/oracle_runs.h"
#include "support/quad_scene.h"

// Exact solutions of boxes in resting contact: standing, sliding, spinning, hit in a row. Those that rotate
// about an edge are in pivot_oracles.h.
namespace careen::oracle {

/// Coulomb friction coefficient μ of a pair: the geometric mean.
inline Quad frictionOf(const QuadBox& box, const QuadWall& wall) {
  return sqrt(box.friction * wall.friction);
}

inline QuadPoses stood(const QuadBox& box, std::span<const double> times) {
  return QuadPoses(times.size(), QuadPose{box.position, box.attitude});
}

/// A box flat on the plane it starts on, not spinning, that moves along a line: from rest, or on a level
/// plane. Friction opposes the motion and is the same in all directions.
class QuadSlide {
 public:
  QuadSlide(const QuadBox& box, const QuadVector& gravity, const QuadWall& plane) : box_(box) {
    const QuadVector across = gravity - plane.normal.dot(gravity) * plane.normal;
    const Quad rubs = -frictionOf(box, plane) * plane.normal.dot(gravity);
    const Quad pull = across.norm();
    speed_ = box.velocity.norm();
    if (speed_ > 0) {
      if (pull > Quad(1e-30) * gravity.norm()) {
        throw std::invalid_argument("slides neither from rest nor on a level plane");
      }
      way_ = box.velocity / speed_;
      rate_ = -rubs;
      stop_ = rubs > 0 ? Quad(speed_ / rubs) : Quad(1e300);
    } else if (pull > rubs) {
      way_ = across / pull;
      rate_ = pull - rubs;
      stop_ = 1e300;
    }
  }

  /// [s] time of the stop; beyond all times if it does not stop, 0 if it sticks from the start.
  const Quad& stop() const { return stop_; }
  /// [m] distance travelled.
  Quad way(const Quad& time) const {
    const Quad t = time < stop_ ? time : stop_;
    return t * (speed_ + t / 2 * rate_);
  }
  QuadPoses poses(std::span<const double> times) const {
    QuadPoses poses;
    for (const double time : times) {
      poses.push_back({box_.position + way(time) * way_, box_.attitude});
    }
    return poses;
  }

 private:
  QuadBox box_;
  QuadVector way_ = QuadVector::Zero();  // [1]
  Quad speed_ = 0;                       // [m/s] at the start
  Quad rate_ = 0;                        // [m/s²] rate of the speed
  Quad stop_ = 0;
};

/// A box spinning flat in place about the vertical; friction μ λ = μ m g/4 on each corner against its slip:
/// α = μ m g sqrt(a²+b²)/I, stop at w/α and angle w²/(2α).
class QuadSpin {
 public:
  QuadSpin(const QuadBox& box, const Quad& gravity, const Quad& friction) : box_(box) {
    const QuadVector& half = box.halfExtents;
    spin_ = box.momentum[2] / box.moments[2];
    slowing_ = friction * box.mass * gravity * sqrt(half[0] * half[0] + half[1] * half[1]) / box.moments[2];
  }

  Quad stop() const { return (spin_ < 0 ? Quad(-spin_) : spin_) / slowing_; }
  Quad angle(const Quad& time) const {
    const Quad t = time < stop() ? time : stop();
    return t * (spin_ - (spin_ < 0 ? -t : t) / 2 * slowing_);
  }
  QuadPoses poses(std::span<const double> times) const {
    const QuadVector up(Quad(0), Quad(0), Quad(1));
    QuadPoses poses;
    for (const double time : times) {
      poses.push_back({box_.position, oracle::times(turnAbout(up, angle(time)), box_.attitude)});
    }
    return poses;
  }

 private:
  QuadBox box_;
  Quad spin_;     // [rad/s] at the start
  Quad slowing_;  // [rad/s²]
};

/// Equal cubes in a row along x on a frictionless floor, e = 1: the first ones, which touch, come from the
/// left, stop where they touch the others, and as many leave at the other end with their speed.
inline std::vector<QuadPoses> rowStruck(const QuadScene& scene, std::span<const double> times) {
  std::size_t coming = 0;
  while (scene.boxes.at(coming).velocity[0] != 0) {
    ++coming;
  }
  const QuadBox& last = scene.boxes.at(coming - 1);
  const QuadBox& next = scene.boxes.at(coming);
  const Quad& speed = last.velocity[0];
  const Quad way = next.position[0] - last.position[0] - next.halfExtents[0] - last.halfExtents[0];
  const Quad strikes = way / speed;
  std::vector<QuadPoses> poses;
  for (const QuadBox& box : scene.boxes) {
    poses.push_back(stood(box, times));
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Quad t = times[k];
    for (std::size_t i = 0; i < coming; ++i) {
      poses.at(i)[k].position[0] += speed * (t < strikes ? t : strikes);
      poses.at(poses.size() - 1 - i)[k].position[0] += t < strikes ? Quad(0) : Quad(speed * (t - strikes));
    }
  }
  return poses;
}

/// Load [N] that each box of a stack, lowest first, carries: the weights above it.
inline std::vector<Quad> weightsAbove(const std::vector<QuadBox>& stack, const Quad& gravity) {
  std::vector<Quad> carried(stack.size(), Quad(0));
  for (std::size_t k = stack.size(); k-- > 1;) {
    carried[k - 1] = carried[k] + stack[k].mass * gravity;
  }
  return carried;
}

/// Stability margin of a stack of upright boxes, lowest first: above each joint the common centre of mass
/// must be over the contact area. In half widths of that area; negative if the stack falls.
inline Quad standsBy(const std::vector<QuadBox>& stack) {
  Quad margin = 1;
  QuadVector moment = QuadVector::Zero();
  Quad mass = 0;
  for (std::size_t k = stack.size(); k-- > 1;) {
    mass += stack[k].mass;
    moment += stack[k].mass * stack[k].position;
    for (int axis = 0; axis < 2; ++axis) {
      const auto end = [&](std::size_t box, int side) {
        return Quad(stack[box].position[axis] + side * stack[box].halfExtents[axis]);
      };
      const Quad low = end(k, -1) > end(k - 1, -1) ? end(k, -1) : end(k - 1, -1);
      const Quad high = end(k, 1) < end(k - 1, 1) ? end(k, 1) : end(k - 1, 1);
      const Quad off = abs(Quad(moment[axis] / mass - (low + high) / 2));
      const Quad left = 1 - off / ((high - low) / 2);
      margin = left < margin ? left : margin;
    }
  }
  return margin;
}

}  // namespace careen::oracle
