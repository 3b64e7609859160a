#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "support/closed_forms.h"
#include "support/contact_oracles.h"
#include "support/pivot_oracles.h"
#include "support/quad_scene.h"

// Exact solutions of scenes that others published: landings, tents of two cards, Bernoulli's problem, the
// cradle, Painlevé's rod.
namespace careen::oracle {

/// [m] Height of the highest corner above the centre; by symmetry the lowest is as far below.
inline Quad heightOf(const QuadBox& box) {
  Quad height = 0;
  for (int axis = 0; axis < 3; ++axis) {
    QuadVector half = QuadVector::Zero();
    half[axis] = box.halfExtents[axis];
    height += abs(Quad(turned(box.attitude, half)[2]));
  }
  return height;
}

/// The second box falls from rest on the first, which is fixed, e = 1; by symmetry it comes straight back up.
inline QuadPoses landedOn(const QuadScene& scene, std::span<const double> times) {
  const QuadBox& box = scene.boxes.at(1);
  if (scene.boxes.at(0).restitution != 1 || !scene.boxes.at(0).fixed || box.velocity.norm() != 0) {
    throw std::invalid_argument("no elastic landing from rest on a fixed box");
  }
  const Quad ground = scene.boxes[0].position[2] + heightOf(scene.boxes[0]) + heightOf(box);
  return bounced(box, ground, Quad(1), -scene.gravity[2], times);
}

/// One of two mirrored cards that lean on each other, from rest: a ladder of thickness d whose top slides
/// down without friction at the plane of symmetry, since by symmetry the force there is horizontal, and whose
/// foot slides outward on the floor z = 0, with friction μ, or sticks. The points of contact are the ends of
/// its inner face. With the angle φ from the vertical the centre is at
///     x = (l sin φ + d cos φ)/2,   z = (l cos φ + d sin φ)/2,
/// and the forces N at the foot and H at the top follow from M x″ = H − μN, M z″ = N − Mg and
/// I φ″ = N (l sin φ − x − μ z) − H (l cos φ − z).
class QuadCard {
 public:
  /// The plane of symmetry is at `apex`; `side` is 1 for the card at larger x.
  QuadCard(const QuadBox& box, const Quad& apex, int side, const Quad& gravity, const Quad& friction)
      : box_(box),
        apex_(apex),
        side_(side),
        gravity_(gravity),
        friction_(friction),
        length_(2 * box.halfExtents[2]),
        thickness_(2 * box.halfExtents[0]),
        angle_(-2 * side * atan2(box.attitude[2], box.attitude[0])),
        sticks_(tan(angle_) / 2 - thickness_ / (2 * length_) <= friction) {}

  struct Forces {
    Quad turning;  // [rad/s²] φ″
    Quad foot;     // [N] N
    Quad top;      // [N] H
  };
  /// While it slides.
  Forces forces(const Quad& angle, const Quad& rate) const {
    const Quad x = (length_ * sin(angle) + thickness_ * cos(angle)) / 2;
    const Quad z = (length_ * cos(angle) + thickness_ * sin(angle)) / 2;
    const Quad xSlope = (length_ * cos(angle) - thickness_ * sin(angle)) / 2;
    const Quad zSlope = (thickness_ * cos(angle) - length_ * sin(angle)) / 2;
    const Quad square = rate * rate;
    const Quad& mass = box_.mass;
    const Quad lever = -zSlope - friction_ * length_ * cos(angle);
    Forces forces;
    forces.turning = mass * (lever * (gravity_ - z * square) + xSlope * x * square) /
                     (box_.moments[1] + mass * (xSlope * xSlope - lever * zSlope));
    forces.foot = mass * (gravity_ + zSlope * forces.turning - z * square);
    forces.top = mass * (xSlope * forces.turning - x * square) + friction_ * forces.foot;
    return forces;
  }

  bool sticks() const { return sticks_; }
  const Quad& angle() const { return angle_; }
  const Quad& rate() const { return rate_; }
  QuadPose pose() const {
    const Quad x = (length_ * sin(angle_) + thickness_ * cos(angle_)) / 2;
    const Quad z = (length_ * cos(angle_) + thickness_ * sin(angle_)) / 2;
    return {QuadVector(Quad(apex_ + side_ * x), box_.position[1], z),
            turnAbout(QuadVector(Quad(0), Quad(-side_), Quad(0)), angle_)};
  }
  void advance(const Quad& duration) {
    constexpr int kSteps = 32;
    for (int i = 0; i < kSteps && !sticks_; ++i) {
      step(duration / kSteps);
    }
  }
  QuadPoses poses(std::span<const double> times) const {
    QuadCard card = *this;
    Quad now = 0;
    QuadPoses poses;
    for (const double time : times) {
      card.advance(Quad(time) - now);
      now = time;
      poses.push_back(card.pose());
    }
    return poses;
  }

 private:
  using State = std::array<Quad, 2>;  // φ, φ'

  State slope(const State& state) const { return {state[1], forces(state[0], state[1]).turning}; }
  // The midpoint rule in `count` steps; its error is a series in squares of the step.
  State midpoint(const Quad& duration, int count) const {
    const Quad h = duration / count;
    State before = {angle_, rate_};
    State slopes = slope(before);
    State now = {before[0] + h * slopes[0], before[1] + h * slopes[1]};
    for (int i = 1; i < count; ++i) {
      slopes = slope(now);
      const State next = {before[0] + 2 * h * slopes[0], before[1] + 2 * h * slopes[1]};
      before = now;
      now = next;
    }
    return now;
  }
  void step(const Quad& duration) {
    constexpr std::size_t kColumns = 10;
    std::array<State, kColumns> table;
    for (std::size_t i = 0; i < kColumns; ++i) {
      table.at(i) = midpoint(duration, static_cast<int>(2 * (i + 1)));
      for (std::size_t j = i; j-- > 0;) {
        const Quad ratio = Quad(static_cast<int>(i + 1)) / static_cast<int>(j + 1);
        for (std::size_t k = 0; k < 2; ++k) {
          table.at(j)[k] = table.at(j + 1)[k] + (table.at(j + 1)[k] - table.at(j)[k]) / (ratio * ratio - 1);
        }
      }
    }
    angle_ = table[0][0];
    rate_ = table[0][1];
  }

  QuadBox box_;
  Quad apex_;
  int side_;
  Quad gravity_;
  Quad friction_;
  Quad length_;
  Quad thickness_;
  Quad angle_;
  Quad rate_ = 0;
  bool sticks_;
};

/// Pairs of cards, each left one before its right one.
inline std::vector<QuadCard> cardsOf(const QuadScene& scene) {
  std::vector<QuadCard> cards;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const QuadBox& box = scene.boxes[i];
    const bool isLeft = i % 2 == 0;
    const Quad apex = (box.position[0] + scene.boxes.at(isLeft ? i + 1 : i - 1).position[0]) / 2;
    cards.emplace_back(box, apex, isLeft ? -1 : 1, -scene.gravity[2], frictionOf(box, scene.walls.at(0)));
  }
  return cards;
}

/// A box flies along x into the faces of two mirrored ones at rest, whose normals lean by φ; all of equal
/// mass, e = 1, no friction. By symmetry both impulses are J: with M u = M v − 2 J cos φ and
/// u cos φ − J/M = −v cos φ, J/M = 2 v cos φ/(1 + 2 cos² φ).
inline std::vector<QuadPoses> struckAtOnce(const QuadScene& scene, std::span<const double> times) {
  const QuadBox& shot = scene.boxes.at(0);
  const QuadBox& left = scene.boxes.at(1);
  const QuadVector normal = turned(left.attitude, QuadVector(Quad(1), Quad(0), Quad(0)));
  const Quad face = left.position[0] - left.halfExtents[0] * normal[0];
  const Quad& speed = shot.velocity[0];
  const Quad meets = (face - shot.position[0] - shot.halfExtents[0]) / speed;
  const Quad push = 2 * speed * normal[0] / (1 + 2 * normal[0] * normal[0]);
  const Quad back = speed - 2 * push * normal[0];
  std::vector<QuadPoses> poses;
  for (const QuadBox& box : scene.boxes) {
    poses.push_back(stood(box, times));
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Quad t = times[k];
    const Quad after = t < meets ? Quad(0) : Quad(t - meets);
    poses[0][k].position[0] += speed * (t < meets ? t : meets) + back * after;
    for (std::size_t i : {1U, 2U}) {
      poses[i][k].position[0] += push * after * normal[0];
      poses[i][k].position[1] += (i == 1 ? 1 : -1) * push * after * normal[1];
    }
  }
  return poses;
}

/// Painlevé's rod: its lower edge at +x slides along the floor z = 0 towards +x. Where W, the acceleration
/// of that edge per force (−μ, 1), points into the floor, no force can keep it from sinking, and it stops at
/// once: the impulse that stops it is within the friction cone exactly then. The angular momentum about it is
/// kept, and the rod turns about it.
class QuadRod {
 public:
  QuadRod(const QuadBox& box, const QuadVector& gravity, const Quad& friction)
      : box_(box), gravity_(gravity), friction_(friction) {
    const QuadVector edge(box.halfExtents[0], Quad(0), Quad(-box.halfExtents[2]));
    arm_ = turned(box.attitude, edge);
    rate_ = -box.mass * box.velocity[0] * arm_[2] /
            (box.moments[1] + box.mass * (arm_[0] * arm_[0] + arm_[2] * arm_[2]));
  }

  /// [1/kg] W: negative in the paradox.
  Quad lift() const { return 1 / box_.mass + arm_[0] * (arm_[0] + friction_ * arm_[2]) / box_.moments[1]; }
  QuadPivot pivot() const { return {box_, gravity_, QuadVector(box_.position + arm_), 1}; }
  /// As it starts to turn.
  QuadPendulum start() const { return {pivot().a(), pivot().b(), Quad(0), rate_}; }
  QuadPoses poses(std::span<const double> times) const {
    const QuadPivot turns = pivot();
    QuadPendulum now = start();
    Quad reached = 0;
    QuadPoses poses;
    for (const double time : times) {
      now.advance(Quad(time) - reached);
      reached = time;
      poses.push_back(turns.pose(now.angle()));
    }
    return poses;
  }

 private:
  QuadBox box_;
  QuadVector gravity_;
  Quad friction_;
  QuadVector arm_;  // [m] from the centre to the edge
  Quad rate_;       // [rad/s] after the stop
};

/// The plane of the top face of a fixed box.
inline QuadWall topOf(const QuadBox& box) {
  QuadWall top;
  top.normal = turned(box.attitude, QuadVector(Quad(0), Quad(0), Quad(1)));
  top.offset = top.normal.dot(box.position) + box.halfExtents[2];
  top.friction = box.friction;
  return top;
}

}  // namespace careen::oracle
