#include "study/truth_case.h"
#include "support/contact_oracles.h"
#include "support/pivot_oracles.h"
#include "support/sliding_spin.h"

namespace careen::study {
namespace {

using oracle::QuadBox;
using oracle::QuadPoses;
using oracle::QuadScene;
using Moments = std::span<const double>;
using Boxes = TruthCase::Boxes;

Boxes slides(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (const QuadBox& box : scene.boxes) {
    boxes.push_back(oracle::QuadSlide(box, scene.gravity, scene.walls.at(0)).poses(times));
  }
  return boxes;
}

Boxes slidesAndSpins(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (const QuadBox& box : scene.boxes) {
    oracle::SlidingSpin puck(box, -scene.gravity[2], frictionOf(box, scene.walls.at(0)));
    QuadPoses& poses = boxes.emplace_back();
    for (const double time : times) {
      poses.push_back(puck.pose(time));
    }
  }
  return boxes;
}

Boxes spins(const QuadScene& scene, Moments times) {
  const QuadBox& box = scene.boxes.at(0);
  return {oracle::QuadSpin(box, -scene.gravity[2], frictionOf(box, scene.walls.at(0))).poses(times)};
}

Boxes rocks(const QuadScene& scene, Moments times) {
  return {oracle::QuadRocking(scene.boxes.at(0), -scene.gravity[2]).poses(times)};
}

// About the lower edge along y, downhill, where what tips begins to.
Boxes slidesOrTips(const QuadScene& scene, Moments times) {
  Boxes boxes = slides(scene, times);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (scene.boxes[i].name == "tips") {
      boxes[i] = oracle::aboutLowerEdge(scene.boxes[i], scene.gravity).poses(times);
    }
  }
  return boxes;
}

Boxes stands(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (const QuadBox& box : scene.boxes) {
    boxes.push_back(oracle::stood(box, times));
  }
  return boxes;
}

Boxes passesOn(const QuadScene& scene, Moments times) { return oracle::rowStruck(scene, times); }

Boxes tipsOver(const QuadScene& scene, Moments times) {
  return {oracle::overEdge(scene.boxes.at(0), scene.boxes.at(1), scene.gravity).poses(times)};
}

}  // namespace

std::vector<TruthCase> contactCases() {
  return {
      {.name = "sliding-azimuths",
       .title = "Sliding to a stop, at 16 azimuths",
       .whyHard = "Friction must act against the slip and with its full strength whatever its azimuth: "
                  "a pyramid in place of the cone bends the path or stops the box elsewhere. And "
                  "integrating into the stop must come to an end.",
       .source = "closed form: v²/(2 μ g) straight ahead",
       .oracle = slides},
      {.name = "sliding-spinning",
       .title = "Sliding and spinning to a stop",
       .whyHard = "A box that slides and spins is slowed in both at once, each corner against its own "
                  "slip and by its own load; slip and spin end at the same moment, where their ratio "
                  "alone says how the friction points.",
       .source = "quadruple precision: four corners with friction against each one's slip, the "
                 "midpoint rule extrapolated",
       .oracle = slidesAndSpins},
      {.name = "spinning-stop",
       .title = "Spinning flat to a stop",
       .whyHard = "Every corner slips another way, and at the stop all of them at once.",
       .source = "closed form: four corners with friction, angle w²/(2 α), α = μ m g sqrt(a²+b²)/I",
       .oracle = spins},
      {.name = "incline-slide",
       .title = "Down a slope of 30°, turned to 16 azimuths",
       .whyHard = "On a slope of 30° with μ = 0.5 a box slides straight down, however it is turned: a "
                  "friction pyramid, or corners treated one after the other, drives it sideways.",
       .source = "closed form: g/2 (sin θ - μ cos θ) t² straight down",
       .oracle = slides},
      {.name = "incline-hold",
       .title = "Held on a slope of 20°",
       .whyHard = "On a slope of 20° with μ = 0.5 friction holds a box for as long as one likes: "
                  "whatever lets it creep adds up.",
       .source = "closed form: at rest, as tan θ < μ",
       .oracle = slides},
      {.name = "rocking-block",
       .title = "Rocking from edge to edge",
       .whyHard = "A slender block rocks from edge to edge, and each impact takes a share of its spin "
                  "that depends on the corners alone; when the next one comes depends on all before.",
       .source = "quadruple precision: Taylor series of a pendulum on its head, ω times 1 - 1.5 sin²α "
                 "at each impact (G. W. Housner 1963)",
       .samples = 16,
       .oracle = rocks},
      {.name = "tip-or-slide",
       .title = "Either side of sliding and of tipping",
       .whyHard = "Two boxes a thousandth either side of sliding, two a thousandth either side of "
                  "tipping: so little of friction or of shape decides, and what tips begins so slowly "
                  "that every push too much shows.",
       .source = "quadruple precision: closed form of sliding, Taylor series of a pendulum on its head"
                 " for the box that tips",
       .oracle = slidesOrTips},
      {.name = "stack-10",
       .title = "A stack of ten",
       .whyHard = "Ten cubes, each a little beside the one below: forces must find their way through "
                  "nine joints, or the stack creeps, leans and falls.",
       .source = "closed form: at rest, each centre of mass over what carries it",
       .oracle = stands},
      {.name = "stack-heavy-100",
       .title = "A stack of ten, the top one 100 times as heavy",
       .whyHard = "Ten cubes, the top one a hundred times as heavy: whoever passes forces from joint to"
                  " joint needs a hundred times as long to find them.",
       .source = "closed form: at rest, each centre of mass over what carries it",
       .oracle = stands},
      {.name = "stack-heavy-1e6",
       .title = "A stack of ten, the top one a million times as heavy",
       .whyHard = "Ten cubes, the top one a million times as heavy: the forces of the joints differ by "
                  "a millionth of themselves.",
       .source = "closed form: at rest, each centre of mass over what carries it",
       .oracle = stands},
      {.name = "row-of-boxes",
       .title = "A row of five, struck",
       .whyHard = "A cube strikes a row of five that touch: the impulse has to go through all of them "
                  "at once and leave with the last.",
       .source = "closed form: the last one leaves with all the speed",
       .oracle = passesOn},
      {.name = "overhang",
       .title = "Tipping over the edge of a table",
       .whyHard = "Its centre five centimetres beyond the table's edge, a box tips over it: the contact"
                  " is an edge within a face, and lies where no corner is.",
       .source = "quadruple precision: Taylor series of a pendulum on its head about the edge",
       .oracle = tipsOver},
      {.name = "pile",
       .title = "Poured into a pit",
       .whyHard = "128 boxes of 0.4 to 0.6 m are poured into a pit of 4.4 by 4.4 metres: where they end "
                  "is chaos, but at no moment may one be inside another.",
       .source = "closed form: bodies are solid",
       .measure = "overlap",
       .samples = 120},
  };
}

}  // namespace careen::study
