// Truths of contact: each is computed in two independent ways, and their assumptions hold: no corner lifts
// off, and nothing slips that should stick.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <iostream>
#include <sstream>

#include "study/truths.h"
#include "support/belt_oracles.h"
#include "support/collocated_spin.h"
#include "support/contact_oracles.h"
#include "support/pivot_oracles.h"
#include "support/quad_scene_file.h"
#include "support/sliding_spin.h"

namespace careen::study {
namespace {

using oracle::QuadBox;
using oracle::QuadPendulum;
using oracle::QuadPoses;
using oracle::QuadScene;
using oracle::QuadVector;

QuadScene sceneOf(const std::string& name) { return oracle::sceneIn(scenePath(name)); }

// Prints and returns the difference of two figures.
double printedDifference(const std::string& what, const Quad& one, const Quad& other) {
  const auto by = static_cast<double>(abs(Quad(one - other)));
  std::cout << what << ": " << static_cast<double>(one) << ", two oracles apart by " << by << '\n';
  return by;
}

QuadPoses slidAndSpun(const QuadScene& scene, const QuadBox& box, const std::vector<double>& times) {
  oracle::SlidingSpin spin(box, -scene.gravity[2], frictionOf(box, scene.walls.at(0)));
  QuadPoses poses;
  for (const double time : times) {
    poses.push_back(spin.pose(time));
  }
  EXPECT_GT(spin.leastLoad(), 0) << box.name;
  return poses;
}

// Measured 5e-30 m: SlidingSpin approaches its stop exponentially.
TEST(TruthsOfContact, ofSlidingAtEveryAzimuthStopAfterTheSquareOfTheSpeed) {
  const QuadScene scene = sceneOf("sliding-azimuths");
  const std::vector<double> times = timesOf("sliding-azimuths", scene);
  double worst = 0;
  for (std::size_t k = 0; k < scene.boxes.size(); ++k) {
    const QuadBox& box = scene.boxes[k];
    const oracle::QuadSlide slide(box, scene.gravity, scene.walls.at(0));
    const Quad slows = frictionOf(box, scene.walls.at(0)) * -scene.gravity[2];
    const Quad squared = box.velocity.squaredNorm();
    EXPECT_LT(abs(Quad(slide.way(Quad(1)) - squared / (2 * slows))), Quad(1e-30));
    EXPECT_LT(slide.stop(), Quad(scene.duration));
    if (k % 5 == 1) {  // only some, to save time
      worst = std::max(worst, oracle::furthestApart(slide.poses(times), slidAndSpun(scene, box, times)));
    }
  }
  std::cout << "sliding-azimuths: two oracles apart by " << worst << '\n';
  EXPECT_LT(worst, 1e-25);
}

TEST(TruthsOfContact, ofSpinningFlatEndAtTheAngleOfTheClosedForm) {
  const QuadScene scene = sceneOf("spinning-stop");
  const std::vector<double> times = timesOf("spinning-stop", scene);
  const QuadBox& box = scene.boxes.at(0);
  const Quad friction = frictionOf(box, scene.walls.at(0));
  const oracle::QuadSpin spin(box, -scene.gravity[2], friction);
  oracle::SlidingSpin other(box, -scene.gravity[2], friction);
  EXPECT_LT(printedDifference("spinning-stop: stops at", spin.stop(), other.stop()), 1e-25);
  EXPECT_LT(spin.stop(), Quad(scene.duration));
  const double worst = oracle::furthestApart(spin.poses(times), slidAndSpun(scene, box, times));
  std::cout << "spinning-stop: two oracles apart by " << worst << '\n';
  EXPECT_LT(worst, 1e-25);
}

TEST(TruthsOfContact, ofSlidingAndSpinningAgreeWithCollocation) {
  const QuadScene scene = sceneOf("sliding-spinning");
  const std::vector<double> times = timesOf("sliding-spinning", scene);
  for (const std::size_t puck : {1U, 3U}) {  // one that mostly slides, one that mostly spins, to save time
    const QuadBox& box = scene.boxes.at(puck);
    const Quad friction = frictionOf(box, scene.walls.at(0));
    oracle::CollocatedSpin other(box, -scene.gravity[2], friction);
    oracle::SlidingSpin end(box, -scene.gravity[2], friction);
    const Quad stop = end.stop();
    EXPECT_LT(stop, Quad(scene.duration)) << box.name;
    const QuadPoses poses = slidAndSpun(scene, box, times);
    const QuadVector up(Quad(0), Quad(0), Quad(1));
    double worst = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      Quad(times[k]) < stop ? other.advanceTo(Quad(times[k])) : other.advanceToStop(Quad(1e-27));
      const auto& [x, y, angle, vx, vy, spin] = other.state();
      worst =
          std::max(worst, apart(poses[k], {QuadVector(x, y, box.position[2]), oracle::turnAbout(up, angle)}));
    }
    std::cout << box.name << ": two oracles apart by " << worst << '\n';
    EXPECT_LT(worst, 1e-19);                                                           // measured 3e-21
    EXPECT_LT(printedDifference(box.name + ": stops at", stop, other.time()), 1e-21);  // measured 2.5e-23
  }
}

TEST(TruthsOfContact, ofTheSlopeGoStraightDownOrNotAtAll) {
  const QuadScene down = sceneOf("incline-slide");
  for (const QuadBox& box : down.boxes) {
    const QuadPoses poses =
        oracle::QuadSlide(box, down.gravity, down.walls.at(0)).poses(timesOf("incline-slide", down));
    const QuadVector way = poses.back().position - box.position;
    EXPECT_NEAR(static_cast<double>(way.norm()), 1.3143, 5e-5);
    EXPECT_EQ(way[1], 0);
    EXPECT_LT(way[2], 0);
    EXPECT_LT(abs(down.walls.at(0).normal.dot(way)), Quad(1e-32));
  }
  const QuadScene held = sceneOf("incline-hold");
  for (const QuadBox& box : held.boxes) {
    EXPECT_EQ(oracle::QuadSlide(box, held.gravity, held.walls.at(0)).way(Quad(10)), 0);
  }
}

// [s] from rest at β₀ to β₁ by energy: β'² = 2 (A (sin β − sin β₀) + B (cos β − cos β₀)); with β = β₀ ± u²
// the integrand has no pole.
Quad timeByEnergy(const Quad& a, const Quad& b, const Quad& from, const Quad& to) {
  const Quad sign = to > from ? 1 : -1;
  boost::math::quadrature::tanh_sinh<Quad> integrator;
  const auto rate = [&](const Quad& u) -> Quad {
    const Quad way = u * u;
    const Quad middle = from + sign * way / 2;
    // sin(way/2)/(way/2), by its series where the quotient loses digits.
    const Quad x = way / 2;
    const Quad sinc = x > Quad(1e-8) ? Quad(sin(x) / x) : Quad(1 - x * x / 6 + x * x * x * x / 120);
    return 2 / sqrt(2 * sign * sinc * (a * cos(middle) - b * sin(middle)));
  };
  return integrator.integrate(rate, Quad(0), Quad(sqrt(sign * (to - from))), Quad(1e-31));
}

// One block of the study, and its scene.
struct Rocker {
  QuadBox box;
  Quad gravity = 0;
  double duration = 0;
  oracle::QuadRocking motion() const { return {box, gravity}; }
};
std::vector<Rocker> rockers() {
  std::vector<Rocker> all;
  for (const char* const name : {"rocking-block", "rocking-measured"}) {
    const QuadScene scene = sceneOf(name);
    for (const QuadBox& box : scene.boxes) {
      all.push_back({box, -scene.gravity[2], scene.duration});
    }
  }
  return all;
}

TEST(TruthsOfContact, ofRockingBlocksStrikeWhenTheEnergySaysSo) {
  for (const Rocker& rocker : rockers()) {
    const oracle::QuadRocking block = rocker.motion();
    const std::vector<Quad> impacts = block.impacts(5);
    EXPECT_LT(impacts.back(), Quad(rocker.duration));
    const Quad a = -block.squareRate() * sin(block.slenderness());
    const Quad b = -block.squareRate() * cos(block.slenderness());
    // The swing starts at each extreme tilt; at the next one the energy is the squared ratio times the
    // previous energy.
    Quad top = block.startTilt();
    Quad time = timeByEnergy(a, b, top, Quad(0));
    for (const Quad& impact : impacts) {
      EXPECT_LT(printedDifference(rocker.box.name + ": impact at", impact, time), 1e-28);
      const Quad height = cos(block.slenderness() - top) - cos(block.slenderness());
      top = block.slenderness() - acos(cos(block.slenderness()) + block.ratio() * block.ratio() * height);
      time += 2 * timeByEnergy(a, b, top, Quad(0));
    }
    // The initial pose is that of the file.
    const QuadPoses poses = block.poses(std::vector<double>{0});
    EXPECT_LT(apart(poses[0], {rocker.box.position, rocker.box.attitude}), 1e-16);
  }
}

// Upright on one edge, it turns with ω = 1 about it; about the other edge it has the angular momentum of its
// turning and of its centre's motion.
TEST(TruthsOfContact, ofRockingBlocksKeepTheAngularMomentumAboutTheLandingEdge) {
  for (const Rocker& rocker : rockers()) {
    const Quad& b = rocker.box.halfExtents[0];
    const Quad& h = rocker.box.halfExtents[2];
    const QuadVector spin(Quad(0), Quad(1), Quad(0));
    const QuadVector from(-b, Quad(0), h);  // from the edge at +x, which it leaves
    const QuadVector to(b, Quad(0), h);     // from the edge at -x, where it lands
    const QuadVector momentum =
        rocker.box.moments[1] * spin + rocker.box.mass * QuadVector(to.cross(spin.cross(from)));
    const Quad inertia = rocker.box.moments[1] + rocker.box.mass * to.squaredNorm();
    EXPECT_LT(abs(Quad(momentum[1] / inertia - rocker.motion().ratio())), Quad(1e-32)) << rocker.box.name;
  }
}

// Blocks on concrete keep 0.95 to 0.97 of what a solid block keeps by Housner's formula, 1 − 1.5 sin²α.
TEST(TruthsOfContact, ofRockingBlocksKeepTheMeasuredPartOfHousnersRatio) {
  std::vector<Quad> parts;
  for (const Rocker& rocker : rockers()) {
    const oracle::QuadRocking block = rocker.motion();
    const Quad sine = sin(block.slenderness());
    parts.push_back(block.ratio() / (1 - Quad(3) / 2 * sine * sine));
  }
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_LT(abs(Quad(parts[0] - 1)), Quad(1e-32));  // solid
  for (int k = 1; k < 4; ++k) {
    EXPECT_LT(abs(Quad(parts[static_cast<std::size_t>(k)] - Quad(94 + k) / 100)), Quad(1e-15));
  }
}

// Friction of 1 suffices for the impacts, whose impulse leans by (h/b)(1 − r)/(1 + r), and for the swings.
TEST(TruthsOfContact, ofRockingBlocksDoNotSlip) {
  for (const Rocker& rocker : rockers()) {
    const QuadBox& box = rocker.box;
    const oracle::QuadRocking block = rocker.motion();
    const Quad r = block.ratio();
    EXPECT_LT(box.halfExtents[2] / box.halfExtents[0] * (1 - r) / (1 + r), Quad(0.9));
    QuadPendulum swing = block.pendulum(block.startTilt(), Quad(0));
    const Quad reach =
        sqrt(box.halfExtents[0] * box.halfExtents[0] + box.halfExtents[2] * box.halfExtents[2]);
    double steepest = 0;
    while (swing.angle() > 0) {
      // The centre moves on a circle: arm (−sin γ, cos γ), γ = α − θ.
      const Quad lean = block.slenderness() - swing.angle();
      const Quad turning = -block.squareRate() * sin(lean);
      const Quad square = swing.rate() * swing.rate();
      const Quad across = reach * (turning * cos(lean) + square * sin(lean));
      const Quad up = reach * (turning * sin(lean) - square * cos(lean)) + rocker.gravity;
      ASSERT_GT(up, 0);
      steepest = std::max(steepest, static_cast<double>(abs(Quad(across / up))));
      swing.advance(Quad(1) / 256);
    }
    std::cout << box.name << ": friction needed " << steepest << '\n';
    EXPECT_LT(steepest, 0.9);
  }
}

struct Tipping {
  oracle::QuadPivot pivot;
  QuadBox box;
  double duration;
};
Tipping tippingOf(const std::string& name) {
  const QuadScene scene = sceneOf(name);
  if (name == "overhang") {
    const QuadBox& box = scene.boxes.at(1);
    return {oracle::overEdge(scene.boxes.at(0), box, scene.gravity), box, scene.duration};
  }
  const QuadBox& box = scene.boxes.at(2);
  EXPECT_EQ(box.name, "tips");
  return {oracle::aboutLowerEdge(box, scene.gravity), box, scene.duration};
}

class TruthsOfTipping : public testing::TestWithParam<const char*> {};
std::string tippingName(const testing::TestParamInfo<const char*>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, TruthsOfTipping, testing::Values("overhang", "tip-or-slide"), tippingName);

TEST_P(TruthsOfTipping, agreeWithTheEnergy) {
  const auto [pivot, box, duration] = tippingOf(GetParam());
  QuadPendulum end = pivot.fromRest();
  end.advance(Quad(duration));
  std::cout << GetParam() << ": turned by " << static_cast<double>(end.angle()) << " rad\n";
  EXPECT_GT(end.angle(), Quad(0.1));
  for (const double part : {0.125, 0.5, 1.0}) {
    const Quad angle = part * end.angle();
    const Quad time = pivot.fromRest().advanceTo(angle);
    EXPECT_LT(printedDifference(std::string(GetParam()) + ": there at", time,
                                timeByEnergy(pivot.a(), pivot.b(), Quad(0), angle)),
              1e-28);
  }
}

// On the slope the force stays within the slope's friction cone, over the table's edge within that of the
// box's face; 0.9 of friction 1.
TEST_P(TruthsOfTipping, doNotSlip) {
  const auto [pivot, box, duration] = tippingOf(GetParam());
  const bool onSlope = box.name == "tips";
  QuadPendulum now = pivot.fromRest();
  double steepest = 0;
  for (int k = 0; k < 64; ++k) {
    const QuadVector up(Quad(0), Quad(0), Quad(1));
    const QuadVector normal = oracle::turned(onSlope ? box.attitude : pivot.pose(now.angle()).attitude, up);
    const QuadVector force = pivot.forceAt(now);
    const Quad presses = normal.dot(force);
    ASSERT_GT(presses, 0);
    const Quad across = (force - presses * normal).norm();
    steepest = std::max(steepest, static_cast<double>(across / presses));
    now.advance(Quad(duration) / 64);
  }
  std::cout << GetParam() << ": friction needed " << steepest << '\n';
  EXPECT_LT(steepest, 0.9);
}

// μ = 0.577 and 0.578 are either side of tan 30°, and so are the ratios of width to height.
TEST(TruthsOfContact, ofTheThresholdsLieOnTheirSides) {
  const QuadScene scene = sceneOf("tip-or-slide");
  const Quad slope = scene.walls.at(0).normal[0] / scene.walls.at(0).normal[2];
  const auto friction = [&](std::size_t box) { return frictionOf(scene.boxes.at(box), scene.walls.at(0)); };
  const auto shape = [&](std::size_t box) {
    return Quad(scene.boxes.at(box).halfExtents[0] / scene.boxes.at(box).halfExtents[2]);
  };
  EXPECT_LT(friction(0), slope);
  EXPECT_GT(friction(1), slope);
  EXPECT_LT(shape(2), slope);
  EXPECT_GT(shape(3), slope);
  for (const std::size_t box : {0U, 1U}) {
    EXPECT_GT(shape(box), friction(box));  // a sliding box does not tip
  }
  EXPECT_GT(oracle::QuadSlide(scene.boxes.at(0), scene.gravity, scene.walls.at(0)).way(Quad(1)), Quad(1e-4));
}

TEST(TruthsOfContact, ofStacksStandAndCarryTheWeightsAbove) {
  for (const auto& [name, top] :
       {std::pair("stack-10", 1.0), std::pair("stack-heavy-100", 100.0), std::pair("stack-heavy-1e6", 1e6)}) {
    const QuadScene scene = sceneOf(name);
    const Quad stands = oracle::standsBy(scene.boxes);
    std::cout << name << ": stands by " << static_cast<double>(stands) << " of half a width\n";
    EXPECT_GT(stands, Quad(0.5));
    const std::vector<Quad> carried = oracle::weightsAbove(scene.boxes, -scene.gravity[2]);
    EXPECT_EQ(carried.at(9), 0);
    EXPECT_EQ(carried.at(8), scene.boxes.at(9).mass * -scene.gravity[2]);
    EXPECT_LT(abs(Quad(carried.at(0) - (8 + Quad(top)) * -scene.gravity[2])), Quad(1e-25));
    for (std::size_t k = 0; k < 10; ++k) {
      EXPECT_EQ(scene.boxes.at(k).position[2] - scene.boxes.at(k).halfExtents[2], static_cast<int>(k));
    }
  }
}

// Equal cubes exchange velocities in pairs until none approaches another.
TEST(TruthsOfContact, ofTheRowAgreeWithPairwiseImpacts) {
  const QuadScene scene = sceneOf("row-of-boxes");
  std::vector<Quad> velocities;
  for (const QuadBox& box : scene.boxes) {
    velocities.push_back(box.velocity[0]);
  }
  for (std::size_t k = 0; k + 1 < velocities.size(); ++k) {
    std::swap(velocities[k], velocities[k + 1]);
  }
  const std::vector<QuadPoses> poses = rowStruck(scene, std::vector<double>{0.25, 1.5, 2});
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_EQ(poses[k][2].position[0] - poses[k][1].position[0], velocities[k] / 2);
  }
  EXPECT_EQ(poses[0][0].position[0], Quad(-1.5));
  EXPECT_EQ(poses[0][2].position[0], Quad(-1));
}

// By hand, with g = 9.81: from rest on a belt of 1.5 m/s and μ = .3 a box is 1.5² / (2 μ g) = .3823 m behind
// it after all; a load of that friction gains .5 g for .3 s, .2207 m, and slides 1.4715² / (2 μ g) = .3679 m
// further.
TEST(TruthsOfContact, ofBeltsAndBrakesAreThoseWorkedOutByHand) {
  const QuadScene belt = sceneOf("belt");
  const std::vector<double> end{belt.duration};
  const oracle::QuadPose rides = oracle::onBelt(belt.boxes.at(0), belt.gravity, belt.walls.at(0), end).back();
  EXPECT_NEAR(static_cast<double>(rides.position[0]), 4.5 - 0.38226, 1e-5);
  const QuadScene brake = sceneOf("braked");
  const auto wayOf = [&](std::size_t box) {
    return static_cast<double>(
        oracle::braked(brake.boxes.at(box), brake, std::vector<double>{2.0}).back().position[0]);
  };
  EXPECT_NEAR(wayOf(0), 0.22073 + 0.36788, 1e-5);
  EXPECT_GT(wayOf(2), 1e-4);
  EXPECT_EQ(wayOf(3), 0);
  const QuadScene table = sceneOf("turntable");
  for (const QuadBox& box : table.boxes) {  // once round after π s
    const std::vector<double> round{static_cast<double>(quadPi())};
    const oracle::QuadPose back = oracle::onTurntable(box, table.gravity, table.walls.at(0), round).back();
    EXPECT_LT(static_cast<double>((back.position - box.position).norm()), 1e-15);
  }
}

}  // namespace
}  // namespace careen::study
