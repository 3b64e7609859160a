#include "study/truth_case.h"
#include "support/jointed_oracles.h"

namespace careen::study {
namespace {

using oracle::QuadScene;
using Moments = std::span<const double>;
using Boxes = TruthCase::Boxes;
using Oracle = TruthCase::Oracle;

constexpr const char* kChain =
    "quadruple precision: Newton's and Euler's equations of all links in their turns alone, extrapolated "
    "midpoint rule";

// In steps no longer than this [s]: half of it changes no digit of a double, see truths_oracles_joints_test.
Oracle hangs(double step) {
  return
      [step](const QuadScene& scene, Moments times) { return oracle::QuadChain(scene).poses(times, step); };
}

TruthCase heavyEnd(const std::string& name, const std::string& ratio, double step) {
  return {.name = name,
          .title = "A chain of ten, the last link " + ratio + " times as heavy",
          .whyHard = "Ten links are let go, the last one " + ratio +
                     " times as heavy as the others: joints that are corrected one after the other are "
                     "pulled open.",
          .source = kChain,
          .samples = 16,
          .oracle = hangs(step)};
}

}  // namespace

std::vector<TruthCase> jointCases() {
  return {
      {.name = "pendulum",
       .title = "A bar on a hinge",
       .whyHard = "A bar swings on its hinge by two radians either way: its period depends on how far, so "
                  "that energy lost or gained is time lost or gained.",
       .source = "closed form: elliptic functions of a pendulum",
       .samples = 16,
       .oracle = [](const QuadScene& scene,
                    Moments times) { return Boxes{oracle::swungFromRest(scene, times)}; }},
      {.name = "parallelogram",
       .title = "A loop of four hinges",
       .whyHard = "Two cranks carry a bridge: four hinges in a loop hold three more directions than there "
                  "are, so that their forces are not unique.",
       .source = "closed form: elliptic functions of a pendulum",
       .samples = 16,
       .oracle = oracle::parallelogram},
      heavyEnd("chain-heavy-100", "100", 1.0 / 512),
      heavyEnd("chain-heavy-1e4", "ten thousand", 1.0 / 2048),
      {.name = "heavy-top",
       .title = "A heavy top, 60 rad/s",
       .whyHard = "A top on a ball joint precesses and nods: forces in the joint are as large as its weight, "
                  "and all that they do wrong turns the axis.",
       .source = kChain,
       .samples = 16,
       .oracle = hangs(1.0 / 64)},
      {.name = "double-pendulum",
       .title = "A double pendulum",
       .whyHard = "Two bars on hinges, let go above the horizontal: small errors grow, and energy goes from "
                  "one bar to the other and back.",
       .source = kChain,
       .samples = 16,
       .oracle = hangs(1.0 / 32)},
      {.name = "triple-pendulum",
       .title = "A triple pendulum",
       .whyHard = "Three bars on hinges, let go above the horizontal: errors grow e times in a third of a "
                  "second.",
       .source = kChain,
       .samples = 16,
       .oracle = hangs(1.0 / 64)},
      {.name = "weld",
       .title = "Two halves of a box",
       .whyHard = "Two halves that are fixed to each other tumble as the whole box does, without a joint "
                  "between them.",
       .source = "quadruple precision: parabola, and Taylor series of Euler's equations of the whole box, "
                 "order 30",
       .samples = 16,
       .oracle = oracle::flownAsOne},
      {.name = "rope-taut",
       .title = "A rope becomes taut",
       .whyHard = "A tumbling box falls until its rope is taut, at once and for good: a rope that gives way "
                  "like a spring, or is looked at once in a step, is late and too long.",
       .source = "quadruple precision: parabola, then a pendulum by the extrapolated midpoint rule; Taylor "
                 "series of Euler's equations",
       .samples = 16,
       .oracle = [](const QuadScene& scene,
                    Moments times) { return Boxes{oracle::caughtByRope(scene, times)}; }},
      {.name = "limit-half",
       .title = "A hinge that bounces at its limit, e = 0.5",
       .whyHard = "A bar swings down to its hinge's limit, at its lowest point, and bounces with half of its "
                  "speed, again and again.",
       .source = "closed form: elliptic functions of a pendulum, between bounces",
       .samples = 16,
       .oracle = [](const QuadScene& scene,
                    Moments times) { return Boxes{oracle::swungAtLimit(scene, times)}; }},
      {.name = "cart-pole",
       .title = "A cart keeps its pole up",
       .whyHard = "A motor that chooses its force fifty times a second pushes a cart so that the pole on it "
                  "stands: without it the lean grows e times in a quarter of a second.",
       .source = "quadruple precision: equations of cart and pole, force held, extrapolated midpoint rule",
       .samples = 16,
       .oracle = oracle::polesUp},
      {.name = "slide-pd",
       .title = "A slide is driven to its target",
       .whyHard = "A motor that looks fifty times a second moves a box on a slide with a spring and a "
                  "damper: all that is wrong shows, as what is right is a sum of exponentials.",
       .source = "quadruple precision: a damped oscillator, force held, extrapolated midpoint rule",
       .samples = 16,
       .oracle = [](const QuadScene& scene,
                    Moments times) { return Boxes{oracle::drivenToTarget(scene, times)}; }},
      {.name = "chain-free",
       .title = "A chain of ten is thrown",
       .whyHard = "Ten links on ball joints fly and writhe: nothing but joints acts on them, and nothing "
                  "that they do may change the momenta or the energy of all.",
       .source = kChain,
       .samples = 16,
       .oracle = hangs(1.0 / 16)},
  };
}

}  // namespace careen::study
