#include "question/quantity_spans.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/asked_runs.h"
#include "support/exact_runs.h"
#include "support/trajectories.h"

namespace careen {
namespace {

using test::kG;
using test::runOf;

World falling(const Body& body) {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  world.bodies = {body};
  return world;
}
World weightless(std::vector<Body> bodies) {
  World world;
  world.bodies = std::move(bodies);
  return world;
}

std::vector<TrueSpan> spansIn(const Trajectory& run, const std::string& question) {
  return quantitySpans(run, readQuestion(question, run.world), run.settings.duration);
}

void expectSpan(const std::vector<TrueSpan>& spans, double from, double to, double within = 1e-12) {
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_NEAR(spans[0].from, from, within * std::max(1.0, from));
  EXPECT_NEAR(spans[0].to, to, within * std::max(1.0, to));
}

const Vec3 kBrick(0.1, 0.2, 0.3);

// z = 2 − g t²/2 and |v| = g t, E = M v²/2; the spin changes nothing.
TEST(QuantitySpans, ofFreeFallAreThoseOfTheParabola) {
  const Trajectory run = runOf(falling(box("a", kBrick, 3, Vec3(1, 2, 2), Vec3::Zero(), Vec3(1, 2, 3))), 1);
  expectSpan(spansIn(run, "height(a) < 1"), std::sqrt(2 / kG), 1);
  expectSpan(spansIn(run, "z(a) > 1"), 0, std::sqrt(2 / kG));
  expectSpan(spansIn(run, "speed(a) > 5"), 5 / kG, 1);
  expectSpan(spansIn(run, "x(a) > 0"), 0, 1);
  EXPECT_TRUE(spansIn(run, "y(a) > 2").empty());
  EXPECT_TRUE(spansIn(run, "speed(a) < -1").empty());
  const double turning = kineticEnergy(run.world.bodies[0].mass, run.state(0, 0));
  expectSpan(spansIn(run, "energy(a) > " + std::to_string(turning + 6)),
             std::sqrt(2 * (std::stod(std::to_string(turning + 6)) - turning) / 3) / kG, 1);
}

// Up at 3 m/s: the height h is passed at (3 ∓ √(9 − 2 g h))/g, and the highest is 9/2g.
TEST(QuantitySpans, ofAThrowHaveBothRoots) {
  const Trajectory run = runOf(falling(box("a", kBrick, 1, Vec3::Zero(), Vec3(0, 0, 3))), 1);
  const double root = std::sqrt(9 - 2 * kG * 0.3);
  expectSpan(spansIn(run, "height(a) > 0.3"), (3 - root) / kG, (3 + root) / kG);
  const double top = 4.5 / kG;
  for (const double below : {1e-6, 1e-9}) {
    Question question = readQuestion("height(a) > 1", run.world);
    question.level = top - below;
    const std::vector<TrueSpan> spans = quantitySpans(run, question, 1);
    ASSERT_EQ(spans.size(), 1U) << below;
    EXPECT_NEAR(spans[0].to - spans[0].from, 2 * std::sqrt(2 * below / kG), 1e-3 * std::sqrt(below));
    question.level = top + below;
    EXPECT_TRUE(quantitySpans(run, question, 1).empty()) << below;
  }
}

// A cube turns steadily by 2 rad/s about x: its tilt is the angle ωt, folded into 0 … π.
TEST(QuantitySpans, ofTheTiltOfASteadyTurn) {
  const Trajectory run =
      runOf(weightless({box("a", Vec3::Constant(0.2), 1, Vec3::Zero(), Vec3::Zero(), Vec3(2, 0, 0))}), 10);
  for (const double degrees : {30.0, 90.0, 150.0}) {
    const double angle = degrees * M_PI / 180;
    const std::vector<TrueSpan> spans = spansIn(run, "tilt(a) > " + std::to_string(degrees));
    ASSERT_EQ(spans.size(), 3U + (20 > 6 * M_PI + angle ? 1 : 0));
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const double turns = 2 * M_PI * static_cast<double>(k);
      EXPECT_NEAR(spans[k].from, (turns + angle) / 2, 1e-12);
      EXPECT_NEAR(spans[k].to, std::min(10.0, (turns + 2 * M_PI - angle) / 2), 1e-12);
    }
  }
  EXPECT_TRUE(spansIn(run, "tilt(a) > 180").empty());
  expectSpan(spansIn(run, "tilt(a) > -1"), 0, 10);
  expectSpan(spansIn(run, "spin(a) > 1.999"), 0, 10);
  EXPECT_TRUE(spansIn(run, "spin(a) > 2.001").empty());
}

// For three hours at 20 rad/s, 34,377 turns, in one flight.
TEST(QuantitySpans, ofALongFlightAreAllThere) {
  const Trajectory run = runOf(
      weightless({box("a", Vec3::Constant(0.2), 1, Vec3::Zero(), Vec3::Zero(), Vec3(20, 0, 0))}), 10'800);
  ASSERT_EQ(run.tracks[0].segments.size(), 1U);
  const std::vector<TrueSpan> spans = spansIn(run, "tilt(a) > 170");
  ASSERT_EQ(spans.size(), 34'377U);
  for (std::size_t k = 0; k < spans.size(); k += 1000) {
    EXPECT_NEAR(spans[k].from, (2 * M_PI * static_cast<double>(k) + 170 * M_PI / 180) / 20, 1e-10);
  }
}

// By Euler's m' = m × I⁻¹m with m = (A dn u, B sn u, C cn u), moments a < b < c, u = λt (at t = 0 nothing is
// about b): λ = A √(AC·AB), B² = C² AC/AB, k² = (BC/AC) B²/A², with AB = 1/a − 1/b and so on. ω² = Σ (mᵢ/Iᵢ)²
// is linear in sn² u, so that it is halfway between its extremes where sn² u = 1/2: u = F(π/4, k).
TEST(QuantitySpans, ofTheSpinOfATumblingBox) {
  const Vec3 half(0.3, 0.2, 0.1);
  const MassProperties mass = solidBox(half, 2);
  const double a = mass.inertiaBody.x();
  const double b = mass.inertiaBody.y();
  const double c = mass.inertiaBody.z();
  ASSERT_LT(a, b);
  ASSERT_LT(b, c);
  const Vec3 spin(4, 0, 0.7);
  const double la = a * spin.x();
  const double lc = c * spin.z();
  const double ab = 1 / a - 1 / b;
  const double bc = 1 / b - 1 / c;
  const double ac = 1 / a - 1 / c;
  ASSERT_GT(la * la * ab, lc * lc * bc);  // so that a is the axis that m circles
  const double lambda = la * std::sqrt(ac * ab);
  const double lb2 = lc * lc * ac / ab;
  const double k2 = bc / ac * lb2 / (la * la);
  const double change = lb2 / (b * b) - la * la * k2 / (a * a) - lc * lc / (c * c);  // of ω², sn² from 0 to 1
  const double k = std::sqrt(k2);
  const double period = 2 * std::comp_ellint_1(k) / lambda;  // of ω²
  const double quarter = std::ellint_1(k, M_PI / 4) / lambda;
  const Trajectory run = runOf(weightless({box("a", half, 2, Vec3::Zero(), Vec3::Zero(), spin)}), 3 * period);
  Question question = readQuestion("spin(a) > 1", run.world);
  question.level = std::sqrt(spin.squaredNorm() + 0.5 * change);
  question.kind = change > 0 ? Question::Kind::kAbove : Question::Kind::kBelow;
  const std::vector<TrueSpan> spans = quantitySpans(run, question, run.settings.duration);
  ASSERT_EQ(spans.size(), 3U);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    EXPECT_NEAR(spans[i].from, static_cast<double>(i) * period + quarter, 1e-11);
    EXPECT_NEAR(spans[i].to, static_cast<double>(i + 1) * period - quarter, 1e-11);
  }
}

// About y by ω: a middle that is d behind the centre of mass along x is d sin ωt above it, and moves at ωd.
TEST(QuantitySpans, areOfTheMiddleOfTheBox) {
  Body body = box("a", kBrick, 1, Vec3::Zero(), Vec3::Zero(), Vec3(0, 3, 0));
  body.boxCenter = Vec3(-0.05, 0, 0);
  const Trajectory run = runOf(weightless({body}), 1);
  expectSpan(spansIn(run, "height(a) > 0.025"), M_PI / 18, 5 * M_PI / 18);
  expectSpan(spansIn(run, "x(a) > -0.025"), M_PI / 9, 1);
  expectSpan(spansIn(run, "speed(a) > 0.1499"), 0, 1);
  EXPECT_TRUE(spansIn(run, "speed(a) > 0.1501").empty());
}

// One passes the other 3 m aside, at 4 m/s from 10 m before: 5 m away 4 m before and behind.
TEST(QuantitySpans, ofDistancesAreThoseOfTheMiddles) {
  const Trajectory run = runOf(weightless({box("a", kBrick, 1, Vec3(-10, 3, 0), Vec3(4, 0, 0), Vec3(1, 2, 0)),
                                           box("b", kBrick, 1, Vec3::Zero())}),
                               5);
  expectSpan(spansIn(run, "distance(a, b) < 5"), 1.5, 3.5);
  expectSpan(spansIn(run, "distance(b, a) < 3.0000001"), 2.5 - std::sqrt(6e-7) / 4, 2.5 + std::sqrt(6e-7) / 4,
             1e-8);
  EXPECT_TRUE(spansIn(run, "distance(b, a) < 2.9999999").empty());
  EXPECT_TRUE(spansIn(run, "distance(b, a) < -1").empty());
  expectSpan(spansIn(run, "distance(b, a) > -1"), 0, 5);
}

// Falls 0.45 m flat, e = 0.5: the speed halves at √(2 · 0.45/g), and that very time is the moment.
TEST(QuantitySpans, jumpWhereTheRunDoes) {
  World world = falling(box("a", Vec3::Constant(0.05), 1, Vec3(0, 0, 0.5), Vec3::Zero(), Vec3::Zero(), 0.5));
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  const Trajectory run = runOf(world, 0.5);
  const std::vector<TrueSpan> spans = spansIn(run, "speed(a) < 2");
  ASSERT_EQ(spans.size(), 2U);
  EXPECT_EQ(spans[0].from, 0);
  EXPECT_NEAR(spans[0].to, 2 / kG, 1e-14);
  EXPECT_EQ(spans[1].from, run.impacts.front().time);
  EXPECT_NEAR(spans[1].from, std::sqrt(0.9 / kG), 1e-14);
}

// A step whose quaternion is (x, 0, 0, 1) with x = p (t − 0.37), of any length, turns by 2 atan x, at the
// speed 2p/(1 + x²): within √ε/p of its middle it is more than 2p/(1 + ε).
TEST(QuantitySpans, ofStepsOfContactHaveTheirPeaks) {
  constexpr double kP = 0.3;
  ContactStep step{.duration = 1};
  step.position.fill(Vec3::Zero());
  step.worldFromBody.fill(Vec4::Zero());
  step.worldFromBody[0] = Vec4(-kP * 0.37, 0, 0, 1);
  step.worldFromBody[1] = Vec4(kP, 0, 0, 0);
  Trajectory run;
  run.settings.duration = 1;
  run.world.bodies = {box("a", kBrick, 1, Vec3::Zero())};
  run.tracks = {{.segments = {{.start = 0, .motion = step}}}};
  Question question = readQuestion("spin(a) > 1", run.world);
  for (const double above : {1e-2, 1e-4, 1e-6, 1e-8}) {
    question.level = 2 * kP / (1 + above);
    const std::vector<TrueSpan> spans = quantitySpans(run, question, 1);
    ASSERT_EQ(spans.size(), 1U) << above;
    EXPECT_NEAR(spans[0].from, 0.37 - std::sqrt(above) / kP, 1e-15 / above * std::sqrt(above) + 1e-13);
    question.level = 2 * kP * (1 + above);
    EXPECT_TRUE(quantitySpans(run, question, 1).empty()) << above;
  }
}

// In 1e-13 s it goes 1e-12 m aside and back, at up to 31 m/s; in 0.1 s, by 0.1 m, it is as fast.
TEST(QuantitySpans, ofCorrectionsOfThePlaceAreNone) {
  for (const double seconds : {1e-13, 0.1}) {
    ContactStep step{.duration = seconds};
    const Vec3 way = Vec3(10 * seconds, 0, 0);
    step.position = {Vec3::Zero(), Vec3::Zero(), 16 * way, -32 * way, 16 * way, Vec3::Zero()};
    step.worldFromBody.fill(Vec4::Zero());
    step.worldFromBody[0] = Vec4(0, 0, 0, 1);
    Trajectory run;
    run.settings.duration = 1;
    run.world.bodies = {box("a", kBrick, 1, Vec3::Zero())};
    run.tracks = {{.segments = {{.start = 0, .motion = Rest()},
                                {.start = 0.5, .motion = step},
                                {.start = 0.5 + seconds, .motion = Rest()}}}};
    const bool moves = seconds > 0.01;
    EXPECT_EQ(spansIn(run, "speed(a) > 20").size(), moves ? 2U : 0U);
    EXPECT_EQ(spansIn(run, "energy(a) > 20").size(), moves ? 2U : 0U);
  }
}

// Two steps of Listing 1, out and back at 2 m/s.
TEST(QuantitySpans, ofOtherMotionsToo) {
  const Trajectory run = driftAndReturn();
  expectSpan(spansIn(run, "x(drifter) > 1.5"), 0.25, 0.75);
  expectSpan(spansIn(run, "distance(drifter, anchor) > 5"), 0, 1);
}

}  // namespace
}  // namespace careen
