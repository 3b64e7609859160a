#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "support/oracle_runs.h"

namespace careen::oracle {

inline Quad restitutionOf(const QuadBox& box, const QuadWall& wall) {
  return box.restitution > wall.restitution ? box.restitution : wall.restitution;
}

inline QuadTurn turnAbout(const QuadVector& axis, const Quad& angle) {
  const QuadVector v = sin(angle / 2) * axis;
  return {cos(angle / 2), v[0], v[1], v[2]};
}

/// A torque-free symmetric top: it precesses about L and spins about its own axis, both at constant rates.
inline QuadPoses precessed(const QuadScene& scene, std::span<const double> times) {
  const QuadBox& box = scene.boxes.at(0);
  std::size_t axis = 0;
  while (axis < 3 && box.moments.at((axis + 1) % 3) != box.moments.at((axis + 2) % 3)) {
    ++axis;
  }
  const Quad& along = box.moments.at(axis);
  const Quad& across = box.moments.at((axis + 1) % 3);
  const QuadVector momentum(box.momentum[0], box.momentum[1], box.momentum[2]);
  const Quad size = momentum.norm();
  const QuadVector direction = turned(box.attitude, QuadVector(momentum / size));
  QuadVector own(Quad(0), Quad(0), Quad(0));
  own[static_cast<Eigen::Index>(axis)] = 1;
  const Quad spin = box.momentum.at(axis) * (1 / along - 1 / across);
  QuadPoses poses;
  for (const double time : times) {
    poses.push_back(
        {fallen(scene, time), oracle::times(turnAbout(direction, size / across * time),
                                            oracle::times(box.attitude, turnAbout(own, spin * time)))});
  }
  return poses;
}

/// A box that falls straight, from rest, until its centre is at `ground`: bounces of duration 2 vₙ/g with
/// vₙ = eⁿ sqrt(2 g h), at rest after sqrt(2 h/g) (1+e)/(1−e).
inline QuadPoses bounced(const QuadBox& box, const Quad& ground, const Quad& e, const Quad& g,
                         std::span<const double> times) {
  const Quad h = box.position[2] - ground;
  const Quad fall = sqrt(2 * h / g);
  QuadPoses poses;
  for (const double time : times) {
    QuadVector position = box.position;
    const Quad t = time;
    if (t < fall) {
      position[2] -= g / 2 * t * t;
    } else if (e == 1) {
      const Quad period = 2 * fall;
      const Quad hop = (t - fall) - period * floor((t - fall) / period);
      position[2] = ground + hop * (g * fall - g / 2 * hop);
    } else if (t >= fall * (1 + e) / (1 - e)) {
      position[2] = ground;
    } else {
      Quad left = t - fall;
      Quad speed = e * g * fall;
      while (left > 2 * speed / g) {
        left -= 2 * speed / g;
        speed *= e;
      }
      position[2] = ground + left * (speed - g / 2 * left);
    }
    poses.push_back({position, box.attitude});
  }
  return poses;
}

/// A box dropped flat, from rest, on the floor z = 0.
inline QuadPoses dropped(const QuadScene& scene, std::span<const double> times) {
  const QuadBox& box = scene.boxes.at(0);
  return bounced(box, box.halfExtents[2], restitutionOf(box, scene.walls.at(0)), -scene.gravity[2], times);
}

/// A cube that flies along the diagonal into the corner of three walls at 0 and returns straight back, e =
/// 1.
inline QuadPoses intoCornerAndBack(const QuadScene& scene, std::span<const double> times) {
  const QuadBox& box = scene.boxes.at(0);
  for (int i = 1; i < 3; ++i) {
    if (box.position[i] != box.position[0] || box.velocity[i] != box.velocity[0] ||
        box.halfExtents[i] != box.halfExtents[0]) {
      throw std::invalid_argument("not along the diagonal");
    }
  }
  const Quad way = box.position[0] - box.halfExtents[0];
  const Quad speed = -box.velocity[0];
  QuadPoses poses;
  for (const double time : times) {
    const Quad left = way - speed * time;
    const Quad x = box.halfExtents[0] + (left > 0 ? left : -left);
    poses.push_back({{x, x, x}, box.attitude});
  }
  return poses;
}

/// A wall at x = 0, a light box at rest, a heavy one sliding in from the right, e = 1: [box][time].
using QuadPair = std::array<QuadPoses, 2>;

// Positions with the boxes' widths subtracted: 0 ≤ light ≤ heavy.
struct QuadRow {
  explicit QuadRow(const QuadScene& scene)
      : light(scene.boxes.at(0)), heavy(scene.boxes.at(1)), width(2 * light.halfExtents[0]) {}
  QuadBox light;
  QuadBox heavy;
  Quad width;

  Quad lightAtStart() const { return light.position[0] - light.halfExtents[0]; }
  Quad heavyAtStart() const { return heavy.position[0] - heavy.halfExtents[0] - width; }
  void add(QuadPair& pair, const Quad& lightNow, const Quad& heavyNow) const {
    pair[0].push_back(
        {{lightNow + light.halfExtents[0], light.position[1], light.position[2]}, light.attitude});
    pair[1].push_back(
        {{heavyNow + width + heavy.halfExtents[0], heavy.position[1], heavy.position[2]}, heavy.attitude});
  }
};

/// By unfolding: in (sqrt(M) x_heavy, sqrt(m) x_light) the motion is a light ray in a wedge of angle
/// atan(sqrt(m/M)), a straight line through repeated images of the wedge (G. Galperin 2003).
inline QuadPair galperinUnfolded(const QuadScene& scene, std::span<const double> times) {
  const QuadRow row(scene);
  const Quad rootLight = sqrt(row.light.mass);
  const Quad rootHeavy = sqrt(row.heavy.mass);
  const Quad wedge = atan2(rootLight, rootHeavy);
  QuadPair pair;
  for (const double time : times) {
    const Quad across = rootHeavy * (row.heavyAtStart() + row.heavy.velocity[0] * time);
    const Quad up = rootLight * (row.lightAtStart() + row.light.velocity[0] * time);
    const Quad radius = sqrt(across * across + up * up);
    const Quad angle = atan2(up, across);
    const Quad copies = floor(angle / wedge);
    const bool mirrored = floor(copies / 2) * 2 != copies;
    const Quad inWedge = mirrored ? Quad((copies + 1) * wedge - angle) : Quad(angle - copies * wedge);
    row.add(pair, radius * sin(inWedge) / rootLight, radius * cos(inWedge) / rootHeavy);
  }
  return pair;
}

/// Impact by impact; `impacts` receives their number.
inline QuadPair galperinStruck(const QuadScene& scene, std::span<const double> times, int& impacts) {
  const QuadRow row(scene);
  const Quad total = row.light.mass + row.heavy.mass;
  Quad x = row.lightAtStart();
  Quad v = row.light.velocity[0];
  Quad y = row.heavyAtStart();
  Quad w = row.heavy.velocity[0];
  Quad now = 0;
  QuadPair pair;
  impacts = 0;
  for (std::size_t k = 0; k < times.size();) {
    const Quad left = Quad(times[k]) - now;
    const bool meetsWall = v < 0;
    const bool meetsHeavy = v > w;
    const Quad toWall = meetsWall ? Quad(-x / v) : Quad(left + 1);
    const Quad toHeavy = meetsHeavy ? Quad((y - x) / (v - w)) : Quad(left + 1);
    const Quad next = toWall < toHeavy ? toWall : toHeavy;
    if (next > left) {
      row.add(pair, x + v * left, y + w * left);
      ++k;
      continue;
    }
    now += next;
    x += v * next;
    y += w * next;
    ++impacts;
    if (toWall < toHeavy) {
      v = -v;
    } else {
      const Quad common = (row.light.mass * v + row.heavy.mass * w) / total;
      v = 2 * common - v;
      w = 2 * common - w;
    }
  }
  return pair;
}

}  // namespace careen::oracle
