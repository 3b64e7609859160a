#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "support/quad_scene.h"

namespace careen::oracle {

/// A box over the floor z = 0 that rotates only about the world's y, one of its own axes: x, z and the angle
/// are elementary functions of time between impacts, and each of its four edges along y collides as one
/// point. Quadruple precision; impacts may follow each other at any interval.
class PlanarBox {
 public:
  /// The scene's first box; `step` [s] between the samples in the search for contact.
  explicit PlanarBox(const QuadScene& scene, double step = 1.0 / 512)
      : box_(scene.boxes.at(0)), gravity_(-scene.gravity[2]), step_(step) {
    const QuadTurn& q = box_.attitude;
    if (q[1] != 0 || q[3] != 0 || box_.momentum[0] != 0 || box_.momentum[2] != 0 || box_.velocity[1] != 0 ||
        scene.gravity[0] != 0 || scene.gravity[1] != 0) {
      throw std::invalid_argument("not a planar motion");
    }
    if (scene.walls.size() == 1) {
      const QuadWall& floor = scene.walls[0];
      restitution_ = floor.restitution > box_.restitution ? floor.restitution : box_.restitution;
    }
    if (scene.walls.size() != 1 || scene.walls[0].normal[2] != 1 || scene.walls[0].offset != 0) {
      throw std::invalid_argument("not one floor at z = 0");
    }
    angle_ = 2 * atan2(q[2], q[0]);
    spin_ = box_.momentum[1] / box_.moments[1];
  }

  const Quad& time() const { return time_; }

  /// Advances to and through the next impact; returns false, unchanged, if there is none up to the time
  /// `until`.
  bool strike(double until) {
    const Quad left = Quad(until) - time_;
    for (int sample = 0; sample * step_ < left; ++sample) {
      const Quad low = sample * step_;
      const Quad high = low + step_;
      std::optional<Quad> first;
      std::size_t corner = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (reduced(k, high) < 0) {
          const Quad root = rootOf(k, low, high);
          if (!first || root < *first) {
            first = root;
            corner = k;
          }
        }
      }
      if (first) {
        if (*first > left) {
          return false;
        }
        bounce(*first, corner);
        return true;
      }
    }
    return false;
  }

  QuadPose pose(const Quad& elapsed) const {
    const Quad half = (angle_ + spin_ * elapsed) / 2;
    QuadVector position = box_.position + elapsed * box_.velocity;
    position[2] -= gravity_ / 2 * elapsed * elapsed;
    return {position, {cos(half), Quad(0), sin(half), Quad(0)}};
  }

 private:
  static Quad sideX(std::size_t corner) { return (corner & 2U) == 0 ? 1 : -1; }
  static Quad sideZ(std::size_t corner) { return (corner & 1U) == 0 ? 1 : -1; }

  Quad height(std::size_t corner, const Quad& elapsed) const {
    const Quad angle = angle_ + spin_ * elapsed;
    return box_.position[2] + elapsed * (box_.velocity[2] - gravity_ / 2 * elapsed) -
           sideX(corner) * box_.halfExtents[0] * sin(angle) +
           sideZ(corner) * box_.halfExtents[2] * cos(angle);
  }
  // Along x, from the centre of mass.
  Quad arm(std::size_t corner) const {
    return sideX(corner) * box_.halfExtents[0] * cos(angle_) +
           sideZ(corner) * box_.halfExtents[2] * sin(angle_);
  }
  Quad climb(std::size_t corner) const { return box_.velocity[2] - spin_ * arm(corner); }

  // The height; for the edge that has just hit, which leaves the floor at exactly height 0, height over
  // time.
  Quad reduced(std::size_t corner, const Quad& elapsed) const {
    if (corner != struck_) {
      return height(corner, elapsed);
    }
    return elapsed > 0 ? Quad((height(corner, elapsed) - height(corner, Quad(0))) / elapsed) : climb(corner);
  }

  Quad rootOf(std::size_t corner, Quad low, Quad high) const {
    Quad atLow = reduced(corner, low);
    Quad atHigh = reduced(corner, high);
    Quad root = high;
    for (int i = 0; i < 200 && high - low > Quad(1e-33) * high; ++i) {
      // Illinois method: the value at an end kept twice is halved.
      root = high - atHigh * (high - low) / (atHigh - atLow);
      const Quad at = reduced(corner, root);
      if (at == 0) {
        break;
      }
      if (at < 0) {
        high = root;
        atHigh = at;
        atLow /= 2;
      } else {
        low = root;
        atLow = at;
        atHigh /= 2;
      }
    }
    return root;
  }

  void bounce(const Quad& elapsed, std::size_t corner) {
    time_ += elapsed;
    box_.position = pose(elapsed).position;
    box_.velocity[2] -= gravity_ * elapsed;
    angle_ += spin_ * elapsed;
    struck_ = corner;
    const Quad x = arm(corner);
    const Quad impulse = -(1 + restitution_) * climb(corner) / (1 / box_.mass + x * x / box_.moments[1]);
    box_.velocity[2] += impulse / box_.mass;
    spin_ -= x * impulse / box_.moments[1];
  }

  QuadBox box_;
  Quad gravity_;
  double step_;
  Quad restitution_ = 0;
  Quad angle_ = 0;
  Quad spin_ = 0;
  Quad time_ = 0;
  std::size_t struck_ = 4;  // no edge
};

}  // namespace careen::oracle
