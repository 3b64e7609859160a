// Truths of published scenes: each is computed in a second way or held against a law that it must obey, and
// its assumptions hold: no contact pulls, and nothing slips that should stick.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "study/truths.h"
#include "support/published_oracles.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using oracle::QuadBox;
using oracle::QuadCard;
using oracle::QuadPoses;
using oracle::QuadScene;
using oracle::QuadVector;

QuadScene publishedScene(const std::string& name) { return oracle::sceneIn(scenePath(name)); }
double rounded(const Quad& number) { return static_cast<double>(number); }

// tan 26.565° = 0.5 = μ of the box that holds; the other has 0.49.
TEST(TruthsOfPublished, ofTheThresholdLieOnItsSides) {
  const QuadScene scene = publishedScene("friction-threshold");
  const oracle::QuadWall& slope = scene.walls.at(0);
  EXPECT_LE(abs(Quad(slope.normal[0] / slope.normal[2] - Quad(1) / 2)), Quad(1e-30));
  EXPECT_EQ(frictionOf(scene.boxes.at(0), slope), Quad(1) / 2);
  EXPECT_NEAR(rounded(frictionOf(scene.boxes.at(1), slope)), 0.49, 1e-15);
  // g (sin θ − μ cos θ) t²/2 with 3 s: 9.81 (0.5 − 0.49) 2/√5 · 4.5
  const QuadPoses poses =
      oracle::QuadSlide(scene.boxes.at(1), scene.gravity, slope).poses(std::vector<double>{3});
  EXPECT_NEAR(rounded((poses[0].position - scene.boxes.at(1).position).norm()),
              9.81 * 0.01 * 2 / std::sqrt(5) * 4.5, 1e-12);
}

// √3, √2 or 1 half edges from the centre; centres on one vertical, and as much below as above.
TEST(TruthsOfPublished, ofLandingsTouchAtTheHeightOfTheirCorners) {
  struct Landing {
    const char* name;
    double below;
    double above;
  };
  for (const Landing& each : {Landing{"land-corner-corner", std::sqrt(3), std::sqrt(3)},
                              Landing{"land-edge-edge", std::sqrt(2), std::sqrt(2)},
                              Landing{"land-crossed-edges", std::sqrt(2), std::sqrt(2)},
                              Landing{"land-corner-face", 1, std::sqrt(3)}}) {
    const QuadScene scene = publishedScene(each.name);
    const double half = rounded(scene.boxes.at(0).halfExtents[0]);
    EXPECT_NEAR(rounded(oracle::heightOf(scene.boxes.at(0))), half * each.below, 1e-15) << each.name;
    EXPECT_NEAR(rounded(oracle::heightOf(scene.boxes.at(1))), half * each.above, 1e-15) << each.name;
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_EQ(scene.boxes[1].position[axis], scene.boxes[0].position[axis]) << each.name;
    }
    // Falls 0.2 m to the first impact, and is back at the top after twice that time.
    const double fall = std::sqrt(2 * 0.2 / 9.81);
    const QuadPoses poses = oracle::landedOn(scene, std::vector<double>{fall, 2 * fall});
    EXPECT_NEAR(rounded(scene.boxes[1].position[2] - poses[0].position[2]), 0.2, 1e-15) << each.name;
    EXPECT_NEAR(rounded(scene.boxes[1].position[2] - poses[1].position[2]), 0, 1e-15) << each.name;
  }
}

// The same card in Cartesian coordinates x, z and φ with both contacts as constraints, whose multipliers are
// the forces; classical Runge–Kutta in double precision.
class ConstrainedCard {
 public:
  ConstrainedCard(double length, double thickness, double mass, double moment, double friction, double angle)
      : length_(length), thickness_(thickness), mass_(mass), moment_(moment), friction_(friction) {
    state_ = {(length * std::sin(angle) + thickness * std::cos(angle)) / 2,
              (length * std::cos(angle) + thickness * std::sin(angle)) / 2, angle};
  }
  double angle() const { return state_[2]; }
  void advance(double duration, int steps) {
    const double h = duration / steps;
    for (int i = 0; i < steps; ++i) {
      const State k1 = slope(state_);
      const State k2 = slope(moved(state_, k1, h / 2));
      const State k3 = slope(moved(state_, k2, h / 2));
      const State k4 = slope(moved(state_, k3, h));
      for (std::size_t k = 0; k < 6; ++k) {
        state_.at(k) += h / 6 * (k1.at(k) + 2 * k2.at(k) + 2 * k3.at(k) + k4.at(k));
      }
    }
  }

 private:
  using State = std::array<double, 6>;  // x z φ and their rates
  static State moved(const State& state, const State& by, double h) {
    State result = state;
    for (std::size_t k = 0; k < 6; ++k) {
      result.at(k) += h * by.at(k);
    }
    return result;
  }
  // The foot at height 0: z − a(φ) = 0 with a = (l cos + d sin)/2; the top at x = 0: x − b(φ) = 0.
  State slope(const State& state) const {
    const double s = std::sin(state[2]);
    const double c = std::cos(state[2]);
    const double rate = state[5];
    const double foot = (length_ * s - thickness_ * c) / 2;  // lever of N: from the centre along x
    const double top = (length_ * c - thickness_ * s) / 2;   // lever of H: from the centre along z
    const double height = (length_ * c + thickness_ * s) / 2;
    const double away = (length_ * s + thickness_ * c) / 2;
    // x″ = (H − μN)/M, z″ = N/M − g, φ″ = (N (foot − μ height) − H top)/I, with
    // z″ = −foot φ″ − height φ′² and x″ = top φ″ − away φ′²: two equations for N and H.
    const double lever = foot - friction_ * height;
    const double a11 = 1 / mass_ + foot * lever / moment_;
    const double a12 = -foot * top / moment_;
    const double b1 = 9.81 - height * rate * rate;
    const double a21 = -friction_ / mass_ - top * lever / moment_;
    const double a22 = 1 / mass_ + top * top / moment_;
    const double b2 = -away * rate * rate;
    const double determinant = a11 * a22 - a12 * a21;
    const double n = (b1 * a22 - a12 * b2) / determinant;
    const double h = (a11 * b2 - a21 * b1) / determinant;
    return {state[3],         state[4],
            state[5],         (h - friction_ * n) / mass_,
            n / mass_ - 9.81, (n * lever - h * top) / moment_};
  }

  double length_;
  double thickness_;
  double mass_;
  double moment_;
  double friction_;
  State state_{};
};

TEST(TruthsOfPublished, ofTheTentsAgreeWithCartesianCoordinates) {
  const QuadScene scene = publishedScene("tent");
  const std::vector<QuadCard> cards = cardsOf(scene);
  ASSERT_EQ(cards.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const QuadBox& box = scene.boxes[i];
    EXPECT_EQ(cards[i].sticks(), box.name.starts_with("stands")) << box.name;
    const double friction = rounded(frictionOf(box, scene.walls.at(0)));
    const double threshold = std::tan(rounded(cards[i].angle())) / 2 - 0.01;  // d/(2 l) = 0.004/0.4
    EXPECT_NEAR(friction / threshold, box.name.starts_with("stands") ? 1.01 : 0.99, 1e-12) << box.name;
    EXPECT_LT(apart(cards[i].pose(), {box.position, box.attitude}), 1e-16) << box.name;
    if (cards[i].sticks()) {
      continue;
    }
    QuadCard card = cards[i];
    ConstrainedCard other(0.2, 0.004, rounded(box.mass), rounded(box.moments[1]), friction,
                          rounded(card.angle()));
    for (int k = 0; k < 8; ++k) {
      // It slides outward, the floor pushes and the cards press on each other: else other equations hold.
      const QuadCard::Forces forces = card.forces(card.angle(), card.rate());
      EXPECT_GT(forces.foot, 0);
      EXPECT_GT(forces.top, 0);
      EXPECT_GE(card.rate(), 0);
      card.advance(Quad(scene.duration) / 8);
      other.advance(scene.duration / 8, 4000);
      EXPECT_NEAR(rounded(card.angle()), other.angle(), 1e-12);  // measured 2e-13
    }
    std::cout << box.name << ": from 25° to " << rounded(card.angle()) * 57.29578 << "°\n";
    EXPECT_GT(card.angle(), Quad(0.6));
  }
}

// Forces that hold a house: every tent of a level carries an equal share of what is above, each of its cards
// half of that, straight down, on its outer upper edge. Moments about the foot give the thrust.
TEST(TruthsOfPublished, ofHousesOfCardsAreHeldByForcesWithinTheCones) {
  for (const int levels : {2, 3, 4}) {
    const QuadScene scene = publishedScene("card-house-" + std::to_string(levels));
    double above = 0;  // [N]
    double most = 0;
    std::size_t end = scene.boxes.size();
    for (int tents = 1; tents <= levels; ++tents) {
      const std::size_t first = end - 2 * static_cast<std::size_t>(tents);
      double floor = 1e9;
      double roof = 0;
      for (std::size_t i = first; i < end; i += 2) {
        const QuadBox& left = scene.boxes.at(i);
        const QuadBox& right = scene.boxes.at(i + 1);
        const double angle = rounded(-2 * atan2(right.attitude[2], right.attitude[0]));
        EXPECT_NEAR(angle, 25 / 57.295779513082320877, 1e-14);
        const double length = 2 * rounded(right.halfExtents[2]);
        const double thick = 2 * rounded(right.halfExtents[0]);
        const double weight = rounded(right.mass) * 9.81;
        const double load = above / (2 * tents);
        const double thrust = (weight * (length * std::sin(angle) - thick * std::cos(angle)) / 2 +
                               load * (length * std::sin(angle) - thick * std::cos(angle))) /
                              (length * std::cos(angle));
        most = std::max(most, thrust / (weight + load));
        // Their inner upper edges meet, without overlap.
        const double inner = (length * std::sin(angle) + thick * std::cos(angle)) / 2;
        EXPECT_NEAR(rounded(right.position[0] - left.position[0]), 2 * inner, 1e-16);
        const double half = (length * std::cos(angle) + thick * std::sin(angle)) / 2;
        floor = std::min(floor, rounded(right.position[2]) - half);
        roof = std::max(roof, rounded(right.position[2]) + half);
      }
      end = first;
      for (std::size_t i = first; i < first + 2 * static_cast<std::size_t>(tents); ++i) {
        above += rounded(scene.boxes.at(i).mass) * 9.81;
      }
      if (tents < levels) {
        const QuadBox& plank = scene.boxes.at(--end);
        EXPECT_TRUE(plank.name.starts_with("plank"));
        EXPECT_NEAR(rounded(plank.position[2] + plank.halfExtents[2]), floor, 1e-15);
        EXPECT_EQ(plank.position[0], 0);
        above += rounded(plank.mass) * 9.81;
      } else {
        EXPECT_NEAR(floor, 0, 1e-16);
      }
      EXPECT_GT(roof, floor);
    }
    EXPECT_EQ(end, 0U);
    std::cout << "card-house-" << levels << ": friction needed " << most << '\n';
    EXPECT_LT(most, 0.9 * 0.5);
  }
}

TEST(TruthsOfPublished, ofTheThreeBoxesKeepMomentumAndEnergy) {
  const QuadScene scene = publishedScene("bernoulli");
  const std::vector<double> times = {0.25, 0.5};
  const std::vector<QuadPoses> poses = struckAtOnce(scene, times);
  Quad momentum = 0;
  Quad energy = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const QuadVector velocity = (poses[i][1].position - poses[i][0].position) / (times[1] - times[0]);
    EXPECT_EQ(scene.boxes.at(i).mass, scene.boxes.at(0).mass);
    momentum += velocity[0];
    energy += velocity.squaredNorm();
  }
  EXPECT_NEAR(rounded(momentum), 1, 1e-15);
  EXPECT_NEAR(rounded(energy), 1, 1e-15);
  EXPECT_NEAR(rounded(poses[0][1].position[0] - poses[0][0].position[0]), -0.2 * 0.25, 1e-15);
  // Its front edges meet the middles of the faces.
  const QuadBox& shot = scene.boxes.at(0);
  for (std::size_t i : {1U, 2U}) {
    const QuadBox& other = scene.boxes.at(i);
    const QuadVector normal = oracle::turned(other.attitude, QuadVector(Quad(1), Quad(0), Quad(0)));
    const QuadVector face = other.position - other.halfExtents[0] * normal;
    EXPECT_NEAR(rounded(face[1]), rounded(shot.halfExtents[1]) * (i == 1 ? 1 : -1), 1e-16);
  }
}

// The edge that leads sinks under any force of it, so it stops; the impulse that does it is within the cone.
// Then the rod turns about it without slipping, and neither energy nor, at the stop, the angular momentum
// about it changes.
TEST(TruthsOfPublished, ofPainlevesRodAreInTheParadoxAndDoNotSlip) {
  const QuadScene scene = publishedScene("painleve-rod");
  const QuadBox& box = scene.boxes.at(0);
  const Quad friction = frictionOf(box, scene.walls.at(0));
  EXPECT_EQ(friction, 2);
  const oracle::QuadRod rod(box, scene.gravity, friction);
  EXPECT_LT(rod.lift(), 0);
  EXPECT_GT(oracle::QuadRod(box, scene.gravity, Quad(1)).lift(), 0);  // below 4/3 there is no paradox
  // Velocities right after: the centre moves about the edge. The impulse is M (v⁺ − v⁻).
  const double h = 1e-9;
  const QuadPoses poses = rod.poses(std::vector<double>{h, 0.25});
  const QuadVector after = (poses[0].position - box.position) / Quad(h);
  const QuadVector impulse = after - box.velocity;
  std::cout << "painleve-rod: impulse " << rounded(impulse[0] / impulse[2])
            << " of friction, starts to turn at " << rounded(rod.start().rate()) << " rad/s\n";
  EXPECT_GT(impulse[2], 0);
  EXPECT_LT(abs(impulse[0]), Quad(0.95) * friction * impulse[2]);
  const QuadVector arm =
      -oracle::turned(box.attitude, QuadVector(box.halfExtents[0], Quad(0), Quad(-box.halfExtents[2])));
  const Quad before = box.mass * arm[2] * box.velocity[0];
  const Quad now = (box.moments[1] + box.mass * arm.squaredNorm()) * rod.start().rate();
  EXPECT_NEAR(rounded(now / before), 1, 1e-15);
  double steepest = 0;
  oracle::QuadPendulum turning = rod.start();
  for (int k = 0; k < 64; ++k) {
    const QuadVector force = rod.pivot().forceAt(turning);
    ASSERT_GT(force[2], 0) << k;
    steepest = std::max(steepest, std::fabs(rounded(force[0] / force[2])));
    turning.advance(Quad(scene.duration) / 64);
  }
  std::cout << "painleve-rod: friction needed " << steepest << '\n';
  EXPECT_LT(steepest, 1.9);
  const Quad kinetic = (box.moments[1] + box.mass * arm.squaredNorm()) / 2;
  const Quad lost = kinetic * (rod.start().rate() * rod.start().rate() - turning.rate() * turning.rate());
  const Quad risen = -scene.gravity[2] * box.mass * (poses[1].position[2] - box.position[2]);
  EXPECT_NEAR(rounded(lost / risen), 1, 1e-13);
}

// Three hold, two slide by g (sin θ − μ cos θ) t²/2.
TEST(TruthsOfPublished, ofRampsSlideWhereTheyAreSteeperThanFriction) {
  const QuadScene scene = publishedScene("omnibench-incline");
  ASSERT_EQ(scene.boxes.size(), 10U);
  const std::array<double, 5> degrees = {15, 20, 25, 30, 35};
  for (std::size_t i = 0; i < 5; ++i) {
    const QuadBox& box = scene.boxes.at(2 * i + 1);
    const oracle::QuadWall ramp = oracle::topOf(scene.boxes.at(2 * i));
    EXPECT_EQ(box.name, "box-" + std::to_string(static_cast<int>(degrees.at(i))));
    EXPECT_NEAR(rounded(ramp.normal.dot(box.position) - ramp.offset), 0.1, 1e-15);
    const QuadPoses poses = oracle::QuadSlide(box, scene.gravity, ramp).poses(std::vector<double>{3});
    const double angle = degrees.at(i) / 57.295779513082320877;
    const double way = std::max(0.0, 9.81 * (std::sin(angle) - 0.5 * std::cos(angle)) * 4.5);
    EXPECT_NEAR(rounded((poses[0].position - box.position).norm()), way, 1e-13);
    EXPECT_LT(way, 8);  // the ramp is 10 m long
  }
}

// Box k falls k mm and finds the one below at rest since √(2 · 1 mm/g) (√k − √(k−1)) before.
TEST(TruthsOfPublished, ofTheStackLandOneAfterTheOther) {
  const QuadScene scene = publishedScene("omnibench-stack");
  double before = 0;
  for (std::size_t k = 0; k < scene.boxes.size(); ++k) {
    const double fall = rounded(scene.boxes[k].position[2]) - 0.05 * static_cast<double>(2 * k + 1);
    EXPECT_NEAR(fall, 0.001 * static_cast<double>(k + 1), 1e-15);
    EXPECT_GT(fall, before);
    before = fall;
  }
  const Truth truth = computeTruth("omnibench-stack");
  EXPECT_NEAR(truth.boxes.at(9).positions.at(0).at(2), 0.95, 1e-15);
}

// Each layer of two planks is symmetric about the middle of those it rests on.
TEST(TruthsOfPublished, ofTheTowerRestAmidTheirSupports) {
  const QuadScene scene = publishedScene("kapla-tower");
  ASSERT_EQ(scene.boxes.size(), 32U);
  for (std::size_t k = 0; k < 16; ++k) {
    const QuadBox& a = scene.boxes.at(2 * k);
    const QuadBox& b = scene.boxes.at(2 * k + 1);
    const int along = k % 2 == 0 ? 0 : 1;
    EXPECT_EQ(a.position[along], 0);
    EXPECT_EQ(a.position[1 - along], -b.position[1 - along]);
    // It reaches over those below, at ±0.08 m along it.
    EXPECT_GT(a.halfExtents[along], Quad(0.08) + a.halfExtents[1 - along]);
    EXPECT_NEAR(rounded(a.position[2]), 0.016 * static_cast<double>(k) + 0.008, 1e-16);
    EXPECT_EQ(a.position[2], b.position[2]);
  }
}

}  // namespace
}  // namespace careen::study
