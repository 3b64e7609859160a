#include "study/truth_case.h"
#include "support/published_oracles.h"

namespace careen::study {
namespace {

using oracle::QuadBox;
using oracle::QuadScene;
using Moments = std::span<const double>;
using Boxes = TruthCase::Boxes;

constexpr const char* kRigidIpc = "Rigid-IPC (Ferguson and others 2021)";
constexpr const char* kReflections = "Reflections on Simultaneous Impact (Smith and others 2012)";
constexpr const char* kOmniBench = "OmniBench";

Boxes stands(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (const QuadBox& box : scene.boxes) {
    boxes.push_back(oracle::stood(box, times));
  }
  return boxes;
}

Boxes slides(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (const QuadBox& box : scene.boxes) {
    boxes.push_back(oracle::QuadSlide(box, scene.gravity, scene.walls.at(0)).poses(times));
  }
  return boxes;
}

// Each box is on the ramp before it.
Boxes slidesOnRamps(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (std::size_t i = 1; i < scene.boxes.size(); i += 2) {
    boxes.push_back(
        oracle::QuadSlide(scene.boxes[i], scene.gravity, oracle::topOf(scene.boxes[i - 1])).poses(times));
  }
  return boxes;
}

Boxes lands(const QuadScene& scene, Moments times) { return {oracle::landedOn(scene, times)}; }

Boxes leans(const QuadScene& scene, Moments times) {
  Boxes boxes;
  for (const oracle::QuadCard& card : oracle::cardsOf(scene)) {
    boxes.push_back(card.poses(times));
  }
  return boxes;
}

Boxes meetsTwo(const QuadScene& scene, Moments times) { return oracle::struckAtOnce(scene, times); }
Boxes passesOn(const QuadScene& scene, Moments times) { return oracle::rowStruck(scene, times); }

Boxes stopsAndTurns(const QuadScene& scene, Moments times) {
  const QuadBox& box = scene.boxes.at(0);
  return {oracle::QuadRod(box, scene.gravity, frictionOf(box, scene.walls.at(0))).poses(times)};
}

// The lowest lands first, and each of the others on one at rest, since it falls further.
Boxes stacksUp(const QuadScene& scene, Moments times) {
  Boxes boxes = stands(scene, times);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Quad& half = scene.boxes[i].halfExtents[2];
    const Quad ground = half * (2 * static_cast<int>(i) + 1);
    boxes[i] = oracle::bounced(scene.boxes[i], ground, Quad(0), -scene.gravity[2], times);
  }
  return boxes;
}

Boxes flies(const QuadScene& scene, Moments times) { return {oracle::flown<Bits192, 48>(scene, times)}; }

TruthCase landing(const std::string& name, const std::string& title, const std::string& whyHard) {
  return {.name = name,
          .title = title,
          .whyHard = whyHard,
          .source = "closed form: parabolas of equal height",
          .published = kRigidIpc,
          .oracle = lands};
}

TruthCase cardHouse(const std::string& levels) {
  return {.name = "card-house-" + levels,
          .title = "A house of cards of " + levels + " levels",
          .whyHard = "A house of cards of " + levels +
                     " levels at 25°, with μ = 0.5, planks between the levels: every card leans on another "
                     "one, so that an error of one contact force is passed on to all, and a little slip "
                     "brings it down.",
          .source = "closed form: at rest, forces within the friction cones exist for μ ≥ tan(25°)",
          .published = kRigidIpc,
          .oracle = stands};
}

}  // namespace

std::vector<TruthCase> publishedCases() {
  return {
      {.name = "friction-threshold",
       .title = "Either side of the threshold of friction, 26.565°",
       .whyHard = "On the slope of angle arctan 0.5 (26.565°), a box with μ = 0.5 holds and one with μ = "
                  "0.49 slides: an error of two hundredths of the friction force shows.",
       .source = "closed form: g (sin θ - μ cos θ) t²/2 straight down, or at rest",
       .published = kRigidIpc,
       .oracle = slides},
      {.name = "cube-1000-on-1",
       .title = "A cube on one that is a thousand times lighter",
       .whyHard = "A cube rests on another that is a thousand times lighter: a solver that passes forces "
                  "from contact to contact, or gives contacts the stiffness of the light one, presses it "
                  "into the floor.",
       .source = "closed form: at rest",
       .published = kRigidIpc,
       .oracle = stands},
      landing("land-corner-corner", "Landing corner on corner",
              "A cube falls with one corner on the corner of another: the contact has no normal of its own. "
              "By symmetry it is vertical, and the elastic cube comes straight back up."),
      landing("land-edge-edge", "Landing edge on parallel edge",
              "A cube falls with one edge on a parallel edge of another: their cross product is zero, and "
              "the contact is a line. By symmetry the elastic cube comes straight back up."),
      landing("land-crossed-edges", "Landing edge across edge",
              "A cube falls with one edge across an edge of another: no corner of either touches the other. "
              "By symmetry the elastic cube comes straight back up."),
      landing("land-corner-face", "Landing corner on face",
              "A cube falls with one corner on the middle of a face of another: one point carries it. By "
              "symmetry the elastic cube comes straight back up."),
      {.name = "tent",
       .title = "Two tents of cards, either side of falling",
       .whyHard = "Two cards of thickness d and length l lean on each other at 25° from the vertical. They "
                  "stand if and only if μ ≥ tan(25°)/2 - d/(2 l); one tent is a hundredth above that, the "
                  "other a hundredth below.",
       .source = "quadruple precision: a ladder with friction at its foot, extrapolated midpoint rule; or at "
                 "rest",
       .published = kRigidIpc,
       .oracle = leans},
      cardHouse("2"),
      cardHouse("3"),
      cardHouse("4"),
      {.name = "bernoulli",
       .title = "One box strikes two at once",
       .whyHard = "A box strikes two others at once, whose faces stand at 30° (the problem of Bernoulli, for "
                  "spheres). Impacts one after the other would push it aside; at once, it comes straight "
                  "back with a fifth of its speed.",
       .source = "closed form: both impulses are 2 M v cos φ/(1 + 2 cos² φ)",
       .published = kReflections,
       .oracle = meetsTwo},
      {.name = "cradle-two",
       .title = "A cradle of cubes, struck by two",
       .whyHard = "Two touching cubes strike a row of three that touch: two must leave at the other end, "
                  "though one of twice the speed would keep the momentum as well.",
       .source = "closed form: the last two cubes leave with all of the speed",
       .published = kReflections,
       .oracle = passesOn},
      {.name = "painleve-rod",
       .title = "Painlevé's rod",
       .whyHard = "A rod slides at 2 m/s, its front end on a floor with μ = 2: no contact force keeps that "
                  "end from sinking in (the paradox of Painlevé). It stops in an instant, without an impact "
                  "before, and the rod turns about it.",
       .source = "quadruple precision: angular momentum about the end kept at the stop, then Taylor series "
                 "of a pendulum",
       .published = "P. Painlevé 1895",
       .oracle = stopsAndTurns},
      {.name = "omnibench-incline",
       .title = "Boxes on ramps of 15 to 35°",
       .whyHard = "Boxes on ramps of 15, 20, 25, 30 and 35° with μ = 0.5, for three seconds: three hold and "
                  "two slide, whatever the ramp.",
       .source = "closed form: g (sin θ - μ cos θ) t²/2 straight down, or at rest",
       .published = kOmniBench,
       .oracle = slidesOnRamps},
      {.name = "omnibench-stack",
       .title = "Ten boxes fall into a stack",
       .whyHard = "Ten boxes, 1 mm apart, fall on each other and must stand as a stack: each landing presses "
                  "all those below into the floor.",
       .source = "closed form: each falls freely, and rests where it lands",
       .published = kOmniBench,
       .oracle = stacksUp},
      {.name = "omnibench-spin",
       .title = "A box spun about its middle axis",
       .whyHard = "A box with edges of 0.4, 0.2 and 0.1 m spins at 5 rad/s about its middle axis, with a "
                  "hundredth of a radian per second about the others: it flips over again and again.",
       .source = "quadruple precision extended to 192 bits: Taylor series of Euler's equations, order 48",
       .published = kOmniBench,
       .oracle = flies},
      {.name = "kapla-tower",
       .title = "A tower of crossed planks",
       .whyHard = "A tower of 16 crossed layers of two planks: each plank rests on two others, and each "
                  "layer carries all above it through four contacts, with more forces than equations.",
       .source = "closed form: at rest, each centre of mass is amid its supports",
       .published = "a classic of the field",
       .oracle = stands},
  };
}

}  // namespace careen::study
