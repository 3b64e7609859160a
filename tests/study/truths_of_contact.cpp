#include "study/truth_case.h"
#include "support/belt_oracles.h"
#include "support/contact_oracles.h"
#include "support/moved_oracles.h"
#include "support/pivot_oracles.h"
#include "support/sliding_spin.h"

namespace careen::study {
namespace {

using oracle::QuadBox;
using oracle::QuadPoses;
using oracle::QuadScene;
using Moments = std::span<const double>;
using Boxes = TruthCase::Boxes;

template <class PosesOf>
Boxes ofEach(const QuadScene& scene, const PosesOf& posesOf) {
  Boxes boxes;
  for (const QuadBox& box : scene.boxes) {
    boxes.push_back(posesOf(box));
  }
  return boxes;
}

Boxes slides(const QuadScene& scene, Moments times) {
  return ofEach(scene, [&](const QuadBox& box) {
    return oracle::QuadSlide(box, scene.gravity, scene.walls.at(0)).poses(times);
  });
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
  return ofEach(scene,
                [&](const QuadBox& box) { return oracle::QuadRocking(box, -scene.gravity[2]).poses(times); });
}

// Tipping is about the lower edge along y, downhill, where it starts.
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
  return ofEach(scene, [&](const QuadBox& box) { return oracle::stood(box, times); });
}

Boxes passesOn(const QuadScene& scene, Moments times) { return oracle::rowStruck(scene, times); }

Boxes tipsOver(const QuadScene& scene, Moments times) {
  return {oracle::overEdge(scene.boxes.at(0), scene.boxes.at(1), scene.gravity).poses(times)};
}

Boxes rides(const QuadScene& scene, Moments times) {
  return ofEach(scene, [&](const QuadBox& box) {
    return oracle::onBelt(box, scene.gravity, scene.walls.at(0), times);
  });
}

Boxes goesRound(const QuadScene& scene, Moments times) {
  return ofEach(scene, [&](const QuadBox& box) {
    return oracle::onTurntable(box, scene.gravity, scene.walls.at(0), times);
  });
}

Boxes isBraked(const QuadScene& scene, Moments times) {
  return ofEach(scene, [&](const QuadBox& box) { return oracle::braked(box, scene, times); });
}

// Of all movable boxes, by the first one, which is what moves.
template <class PosesOf>
Boxes ofMoved(const QuadScene& scene, const PosesOf& posesOf) {
  Boxes boxes;
  for (std::size_t i = 1; i < scene.boxes.size(); ++i) {
    boxes.push_back(posesOf(scene.boxes[i], scene.boxes.front()));
  }
  return boxes;
}

Boxes isShaken(const QuadScene& scene, Moments times) {
  return ofMoved(scene, [&](const QuadBox& box, const QuadBox& table) {
    return oracle::QuadNewmark(box, table, scene.gravity).poses(times);
  });
}

Boxes isLifted(const QuadScene& scene, Moments times) {
  return ofMoved(scene, [&](const QuadBox& box, const QuadBox& lift) {
    return oracle::onLift(box, lift, scene.gravity, times);
  });
}

Boxes isPushed(const QuadScene& scene, Moments times) {
  return ofMoved(scene, [&](const QuadBox& box, const QuadBox& plate) {
    return oracle::QuadPushed(box, plate, scene.gravity, scene.walls.at(0)).poses(times);
  });
}

}  // namespace

std::vector<TruthCase> contactCases() {
  return {
      {.name = "sliding-azimuths",
       .title = "Sliding to a stop, at 16 azimuths",
       .whyHard = "Friction must oppose the slip at full strength for every azimuth: a friction pyramid in "
                  "place of the cone bends the path or stops the box elsewhere. And integration towards the "
                  "stop must terminate.",
       .source = "closed form: v²/(2 μ g) straight ahead",
       .oracle = slides},
      {.name = "sliding-spinning",
       .title = "Sliding and spinning to a stop",
       .whyHard = "Friction slows sliding and spinning together: at each corner it opposes that corner's "
                  "slip and follows that corner's load. Slip and spin end at the same moment, where their "
                  "ratio alone determines the direction of friction.",
       .source = "quadruple precision: four corners, each with friction opposing its slip, extrapolated "
                 "midpoint rule",
       .oracle = slidesAndSpins},
      {.name = "spinning-stop",
       .title = "Spinning flat to a stop",
       .whyHard = "Every corner slips in another direction, and all of them stop at once.",
       .source = "closed form: four corners with friction, angle w²/(2 α), α = μ m g sqrt(a²+b²)/I",
       .oracle = spins},
      {.name = "incline-slide",
       .title = "Down a slope of 30°, turned to 16 azimuths",
       .whyHard = "On a slope of 30° with μ = 0.5, a box slides straight down at any azimuth: a friction "
                  "pyramid, or corners resolved one after the other, drives it sideways.",
       .source = "closed form: g/2 (sin θ - μ cos θ) t² straight down",
       .oracle = slides},
      {.name = "incline-hold",
       .title = "Held on a slope of 20°",
       .whyHard = "On a slope of 20° with μ = 0.5, friction holds a box indefinitely: any creep accumulates.",
       .source = "closed form: at rest, as tan θ < μ",
       .oracle = slides},
      {.name = "rocking-block",
       .title = "Rocking from edge to edge",
       .whyHard =
           "A slender block rocks from edge to edge. Each impact reduces its angular velocity by a factor "
           "that depends on the geometry alone, and the time of each impact depends on all previous ones.",
       .source = "quadruple precision: Taylor series of an inverted pendulum, ω times 1 - 1.5 sin²α at each "
                 "impact (G. W. Housner 1963)",
       .samples = 16,
       .oracle = rocks},
      {.name = "rocking-measured",
       .title = "Rocking as measured on concrete",
       .whyHard =
           "Three blocks rock from edge to edge and keep 0.95, 0.96 and 0.97 of the angular velocity that "
           "G. W. Housner's formula for a solid block leaves at each impact, as blocks measured on concrete "
           "do. No restitution does this, as the formula is for impacts without bounce already; mass nearer "
           "to the middle does.",
       .source = "quadruple precision: Taylor series of an inverted pendulum, ω times 1 - 2 m b²/(I + m R²) "
                 "at each impact (G. W. Housner 1963, with a given moment of inertia I)",
       .samples = 16,
       .oracle = rocks},
      {.name = "tip-or-slide",
       .title = "Either side of sliding and of tipping",
       .whyHard = "Two boxes are a thousandth either side of sliding, two a thousandth either side of "
                  "tipping: a small error of friction or shape decides, and tipping starts so slowly that "
                  "every spurious impulse shows.",
       .source = "quadruple precision: closed form of sliding, Taylor series of an inverted pendulum for the "
                 "box that tips",
       .oracle = slidesOrTips},
      {.name = "stack-10",
       .title = "A stack of ten",
       .whyHard = "Ten cubes, each offset a little from the one below: forces must propagate through nine "
                  "contacts, or the stack creeps, leans and falls.",
       .source = "closed form: at rest, each centre of mass is above its support",
       .oracle = stands},
      {.name = "stack-heavy-100",
       .title = "A stack of ten, the top one 100 times as heavy",
       .whyHard = "Ten cubes, the top one a hundred times as heavy: a solver that passes forces from contact "
                  "to contact needs a hundred times as many iterations.",
       .source = "closed form: at rest, each centre of mass is above its support",
       .oracle = stands},
      {.name = "stack-heavy-1e6",
       .title = "A stack of ten, the top one a million times as heavy",
       .whyHard =
           "Ten cubes, the top one a million times as heavy: the contact forces differ by only a millionth.",
       .source = "closed form: at rest, each centre of mass is above its support",
       .oracle = stands},
      {.name = "row-of-boxes",
       .title = "A row of five, struck",
       .whyHard = "A cube strikes a row of five touching cubes: the impulse must pass through all of them at "
                  "once and leave with the last one.",
       .source = "closed form: the last cube leaves with all of the speed",
       .oracle = passesOn},
      {.name = "overhang",
       .title = "Tipping over the edge of a table",
       .whyHard = "The centre of the box is five centimetres beyond the table's edge, so it tips over: the "
                  "contact is an edge within a face, away from every corner.",
       .source = "quadruple precision: Taylor series of an inverted pendulum about the edge",
       .oracle = tipsOver},
      {.name = "belt",
       .title = "Put on a belt, and thrown onto it",
       .whyHard = "Friction aims at the speed of the belt, in whatever direction a box comes; where the box "
                  "has that speed friction ends, and nothing may be left of the slip.",
       .source = "closed form: v²/(2 μ g) in the frame of the belt, then at rest in it",
       .oracle = rides},
      {.name = "turntable",
       .title = "Carried round by a turntable",
       .whyHard =
           "Friction alone carries the boxes round, up to 0.99 of what it can: every step that is taken "
           "along the tangent leads outwards.",
       .source = "closed form: a circle, as ω² r < μ g",
       .oracle = goesRound},
      {.name = "braked",
       .title = "Loads of a vehicle that brakes",
       .whyHard =
           "Gravity changes between two moments, as in a vehicle that brakes with 0.8 g for 0.3 s: what "
           "rests feels it at that moment, and some of it by a hundredth not enough.",
       .source = "closed form: (a - μ g) while it brakes, μ g until it stops",
       .oracle = isBraked},
      {.name = "shaking-table",
       .title = "Newmark's block on a shaking table",
       .whyHard =
           "N. M. Newmark's block: a table shakes to and fro with up to 9.6 m/s², and friction carries the "
           "blocks for as long as that is no more than μ g. One is carried always, one by a hundredth not "
           "quite, and each change between riding and slipping depends on all the earlier ones.",
       .source = "closed form: A sin ωt while it rides, μ g while it slips; changes at roots",
       .samples = 16,
       .oracle = isShaken},
      {.name = "lift-stops",
       .title = "A lift that starts and stops at once",
       .whyHard =
           "A lift starts at once, stops at once, goes down and stops again: each jump of its speed strikes "
           "what stands on it or leaves it in the air, and what bounces comes to rest on a floor that moves, "
           "after infinitely many impacts.",
       .source = "closed form: parabolas above the lift, e times the speed at each impact",
       .samples = 32,
       .oracle = isLifted},
      {.name = "pusher",
       .title = "Struck and pushed by a plate",
       .whyHard =
           "A plate that goes on evenly meets boxes at rest and boxes that slide away from it. Friction "
           "of the floor brings them back to it again and again, in ever shorter times, until it pushes "
           "them.",
       .source = "closed form: hops before the plate under μ g, e times the speed at each impact",
       .samples = 16,
       .oracle = isPushed},
      {.name = "pile",
       .title = "Poured into a pit",
       .whyHard = "128 boxes of 0.4 to 0.6 m are poured into a pit of 4.4 by 4.4 metres: their final "
                  "positions are chaotic, but boxes must never overlap.",
       .source = "closed form: rigid bodies do not overlap",
       .measure = "overlap",
       .samples = 120},
  };
}

}  // namespace careen::study
