#include "study/truths.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "study/truth_case.h"
#include "support/closed_forms.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using oracle::QuadPoses;
using oracle::QuadScene;
using Moments = std::span<const double>;
using Boxes = TruthCase::Boxes;
using Oracle = TruthCase::Oracle;

constexpr const char* kTaylor = "quadruple precision: Taylor series of Euler's equations, order 30";
constexpr const char* kTaylorWide =
    "quadruple precision extended to 192 bits: Taylor series of Euler's equations, order 48";
constexpr const char* kRoom =
    "quadruple precision: Taylor series of Euler's equations between impacts, one impulse at the corner in "
    "contact";
constexpr const char* kPlanar =
    "quadruple precision: planar motion in elementary functions between impacts, one impulse at each edge in "
    "contact";
constexpr const char* kKept = "closed form: the total energy is conserved";

Boxes flies(const QuadScene& scene, Moments times) { return {oracle::flown(scene, times)}; }
// For motions that amplify rounding errors until they would be visible in a double.
Boxes fliesWide(const QuadScene& scene, Moments times) { return {oracle::flown<Bits192, 48>(scene, times)}; }
Boxes drops(const QuadScene& scene, Moments times) { return {dropped(scene, times)}; }

Oracle strikes(double step, int impacts) {
  return [=](const QuadScene& scene, Moments times) {
    return Boxes{struck(oracle::QuadRoom(scene, step), times, impacts)};
  };
}
Oracle strikesFloor(double step, int impacts) {
  return [=](const QuadScene& scene, Moments times) {
    return Boxes{struck(oracle::PlanarBox(scene, step), times, impacts)};
  };
}

// The cube's corner strikes the centre of the plate's front face, which acts like a wall there.
Boxes strikesPlate(const QuadScene& scene, Moments times) {
  const oracle::QuadBox& plate = scene.boxes.at(1);
  QuadScene front = scene;
  front.walls = {{.normal = {Quad(-1), Quad(0), Quad(0)},
                  .offset = plate.halfExtents[0] - plate.position[0],
                  .restitution = plate.restitution}};
  return {struck(oracle::QuadRoom(front, 1.0 / 65536), times, 1)};
}

Boxes comesBack(const QuadScene& scene, Moments times) { return {intoCornerAndBack(scene, times)}; }

Boxes unfolds(const QuadScene& scene, Moments times) {
  const oracle::QuadPair pair = galperinUnfolded(scene, times);
  return {pair[0], pair[1]};
}

TruthCase nearSeparatrix(const std::string& offset) {
  return {
      .name = "separatrix-" + offset,
      .title = "Book beside the separatrix, " + offset + " rad/s",
      .whyHard = "At " + offset +
                 " rad/s from the middle axis, the book is so close to the separatrix that it seems to spin "
                 "steadily before it flips; the time of the flip depends on the logarithm of that offset.",
      .source = kTaylorWide,
      .oracle = fliesWide};
}

TruthCase nearSimultaneous(const std::string& tilt) {
  return {.name = "near-simultaneous-" + tilt,
          .title = "Cube tilted by " + tilt + " rad lands on two edges",
          .whyHard = "Tilted by " + tilt +
                     " rad, the cube lands on one edge and almost simultaneously on the other: resolving the "
                     "two impacts one after the other leaves it spinning; resolving them as one does not.",
          .source = kPlanar,
          .oracle = strikesFloor(1.0 / 512, 2)};
}

std::vector<TruthCase> casesOfFlight() {
  return {
      {.name = "tumble-generic",
       .title = "Generic tumble",
       .whyHard = "Three different moments of inertia and a spin about none of the axes: the attitude "
                  "follows elliptic functions, and stepwise rotation drifts.",
       .source = kTaylor,
       .oracle = flies},
      {.name = "tumble-middle-axis",
       .title = "Tumbling about the middle axis",
       .whyHard = "Spin about the middle axis is unstable: a small disturbance grows until the box flips, "
                  "again and again, and every error grows with it.",
       .source = kTaylorWide,
       .oracle = fliesWide},
      nearSeparatrix("1e-3"),
      nearSeparatrix("1e-6"),
      nearSeparatrix("1e-9"),
      {.name = "needle",
       .title = "Needle, 1 : 10⁻⁴ : 10⁻⁴",
       .whyHard = "One moment of inertia is fifty million times smaller than the others: a small error of "
                  "the angular momentum across the needle is a large error of its spin.",
       .source = kTaylor,
       .oracle = flies},
      {.name = "plate",
       .title = "Plate, 1 : 1 : 10⁻⁴",
       .whyHard = "Two half extents are ten thousand times the third: one moment of inertia is nearly the "
                  "sum of the other two, as for a disc, and their differences lose digits.",
       .source = kTaylor,
       .oracle = flies},
      {.name = "fast-spin",
       .title = "Ten thousand radians per second",
       .whyHard = "Ten thousand radians in a second: every relative error of the angular velocity is ten "
                  "thousand times larger in the attitude.",
       .source = kTaylor,
       .oracle = flies},
      {.name = "free-fall",
       .title = "Tumbling in free fall",
       .whyHard = "The box falls 490 m while it tumbles: a first-order method is off by half g t dt, and no "
                  "wall hides that.",
       .source = "quadruple precision: parabola, and Taylor series of Euler's equations, order 30",
       .oracle = flies},
      {.name = "bounce-1000",
       .title = "A thousand bounces",
       .whyHard = "A thousand elastic bounces: errors in the times of impact and in the speeds accumulate, "
                  "and a time step that gains energy makes the cube bounce ever higher.",
       .source = "closed form: parabolas of equal height",
       .samples = 16,
       .oracle = drops},
      {.name = "zeno-half",
       .title = "Infinitely many bounces, e = 0.5",
       .whyHard = "Chattering: infinitely many bounces in 1.34 s, each with half the speed of the previous "
                  "one, then rest.",
       .source = "closed form: parabolas of geometric height, at rest after sqrt(2h/g) (1+e)/(1-e)",
       .samples = 16,
       .oracle = drops},
      {.name = "zeno-nine",
       .title = "Infinitely many bounces, e = 0.9",
       .whyHard = "Chattering: infinitely many bounces in 8.5 s, each with nine tenths of the speed of the "
                  "previous one: more and more of them in each time step.",
       .source = "closed form: parabolas of geometric height, at rest after sqrt(2h/g) (1+e)/(1-e)",
       .samples = 16,
       .oracle = drops},
      {.name = "corner-impact",
       .title = "Impact on a corner",
       .whyHard = "A tumbling box strikes a wall with one corner: its position, velocity and spin afterwards "
                  "all depend on the attitude at that moment.",
       .source = kRoom,
       .oracle = strikes(1.0 / 512, 1)},
      {.name = "landing-flat",
       .title = "Landing on a face",
       .whyHard =
           "Four corners land simultaneously: resolving them one after the other leaves the cube spinning.",
       .source = "closed form: parabolas of geometric height",
       .samples = 16,
       .oracle = drops},
      {.name = "landing-edge",
       .title = "Landing on an edge",
       .whyHard = "Two corners of an edge land simultaneously: afterwards the box must rotate about that "
                  "edge's direction only.",
       .source = kPlanar,
       .oracle = strikesFloor(1.0 / 512, 2)},
      {.name = "landing-room-corner",
       .title = "Into the corner of three walls",
       .whyHard = "Twelve simultaneous contacts with three walls depend on each other, and the cube must "
                  "come straight back.",
       .source = "closed form: comes straight back",
       .oracle = comesBack},
      {.name = "grazing-hit",
       .title = "Grazes the floor, 1 micrometre deep",
       .whyHard = "An edge of a rotating box dips a micrometre below the floor's plane, for less than a "
                  "millisecond: a time step that skips it misses the impact.",
       .source = kPlanar,
       .oracle = strikesFloor(1.0 / 8192, 1)},
      {.name = "grazing-miss",
       .title = "Misses the floor by 1 micrometre",
       .whyHard = "The edges of a rotating box stay a micrometre above the floor, again and again: a contact "
                  "margin turns that into an impact.",
       .source = kPlanar,
       .oracle = strikesFloor(1.0 / 8192, 0)},
      {.name = "grazing-hit-tumbling",
       .title = "Tumbles, and grazes the floor, 1 micrometre deep",
       .whyHard = "A corner of a box that tumbles about all its axes dips a micrometre below the floor's "
                  "plane, once, after four other near misses: a time step that skips it misses the impact.",
       .source = kRoom,
       .oracle = strikes(1.0 / 8192, 1)},
      {.name = "grazing-miss-tumbling",
       .title = "Tumbles, and misses the floor by 1 micrometre",
       .whyHard = "A corner of a box that tumbles about all its axes stays a micrometre above the floor: a "
                  "contact margin turns that into an impact.",
       .source = kRoom,
       .oracle = strikes(1.0 / 8192, 0)},
      nearSimultaneous("1e-3"),
      nearSimultaneous("1e-6"),
      nearSimultaneous("1e-9"),
      nearSimultaneous("1e-12"),
      {.name = "thin-wall",
       .title = "Shot at a thin plate",
       .whyHard = "At 400 m/s the cube moves 1.7 m in a time step of 1/240 s, 167 times the thickness of the "
                  "plate that it strikes head on with a corner: a method that checks only the end of a time "
                  "step finds it behind the plate (tunnelling).",
       .source = "closed form: comes straight back, except for the rounding of the initial attitude, which "
                 "is followed in quadruple precision",
       .oracle = strikesPlate},
      {.name = "room-million",
       .title = "A million impacts in a room",
       .whyHard = "A million elastic impacts: the energy errors of all of them accumulate.",
       .source = kKept,
       .measure = "energy"},
      {.name = "room-minute",
       .title = "A minute in a room",
       .whyHard = "A minute of impacts on corners and edges, none of which may gain or lose energy.",
       .source = kKept,
       .measure = "energy",
       .samples = 60},
      {.name = "reversal",
       .title = "There and back again",
       .whyHard = "Run backwards, the box must return through the same impacts to its start; each impact "
                  "multiplies errors by about five.",
       .source = "closed form: the motion run backwards",
       .measure = "reversal"},
      {.name = "galperin",
       .title = "314 impacts, the digits of π",
       .whyHard =
           "314 impacts, the closest an eighth of a millisecond apart, between a wall, a light box and one "
           "ten thousand times heavier: if one is missed or counted twice, the light box ends up elsewhere.",
       .source = "closed form: the billiard unfolded (G. Galperin 2003)",
       .samples = 16,
       .oracle = unfolds},
      {.name = "millimetre",
       .title = "Impact on a corner, in millimetres",
       .whyHard = "The corner impact a thousand times smaller: contact margins and penetration slops meant "
                  "for metres are larger than the box.",
       .source = kRoom,
       .oracle = strikes(1.0 / 16384, 1)},
      {.name = "kilometre",
       .title = "Impact on a corner, in kilometres",
       .whyHard = "The corner impact a thousand times larger: positions in metres lose digits, and limits on "
                  "speed or size take effect.",
       .source = kRoom,
       .oracle = strikes(1.0 / 16, 1)},
      {.name = "far-away",
       .title = "Impact on a corner, far from the origin",
       .whyHard = "The corner impact a million metres from the origin along every axis: a float "
                  "resolves 6 cm there, a double 0.1 nm.",
       .source = kRoom,
       .oracle = strikes(1.0 / 512, 1)},
      {.name = "scaled",
       .title = "Impact on a corner, lengths times 4, times times 2",
       .whyHard = "The corner impact with lengths four times and times twice as large, in the same gravity: "
                  "any hidden absolute tolerance shows, because everything else scales to the bit.",
       .source = "closed form: the other run, scaled by powers of two",
       .measure = "scaled"},
  };
}

const std::vector<TruthCase>& cases() {
  static const std::vector<TruthCase> kCases = [] {
    std::vector<TruthCase> all = casesOfFlight();
    for (std::vector<TruthCase> more : {contactCases(), jointCases(), publishedCases()}) {
      std::move(more.begin(), more.end(), std::back_inserter(all));
    }
    return all;
  }();
  return kCases;
}

const TruthCase& caseNamed(const std::string& name) {
  for (const TruthCase& each : cases()) {
    if (each.name == name) {
      return each;
    }
  }
  throw std::invalid_argument("no case " + name);
}

// Rounded to doubles, with the sign that gives equal attitudes equal numbers.
TruthBox rounded(const std::string& name, const QuadPoses& poses) {
  TruthBox box;
  box.name = name;
  for (const oracle::QuadPose& pose : poses) {
    auto& position = box.positions.emplace_back();
    for (int i = 0; i < 3; ++i) {
      position.at(static_cast<std::size_t>(i)) = static_cast<double>(pose.position[i]);
    }
    auto& orientation = box.orientations.emplace_back();
    double sign = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto part = static_cast<double>(pose.attitude.at(i));
      sign = sign != 0 || part == 0 ? sign : (part > 0 ? 1.0 : -1.0);
      orientation.at(i) = part == 0 ? 0 : sign * part;
    }
  }
  return box;
}

std::string number(double value) {
  std::array<char, 32> digits{};
  char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 17).ptr;
  return {digits.data(), end};
}

template <class Numbers>
std::string list(const Numbers& numbers) {
  std::string text = "[";
  for (const double value : numbers) {
    text += (text.size() > 1 ? ", " : "") + number(value);
  }
  return text + "]";
}

template <class Rows>
std::string table(const Rows& rows) {
  std::string text = "[";
  for (const auto& row : rows) {
    text += (text.size() > 1 ? ",\n        " : "\n        ") + list(row);
  }
  return text + "]";
}

std::string quoted(const std::string& text) { return '"' + text + '"'; }

}  // namespace

std::vector<std::string> truthNames() {
  std::vector<std::string> names;
  for (const TruthCase& each : cases()) {
    names.push_back(each.name);
  }
  return names;
}

std::filesystem::path scenePath(const std::string& name) {
  return std::filesystem::path(CAREEN_SOURCE_DIR) / "assets" / "scenes" / "hard" / (name + ".json");
}
std::filesystem::path truthPath(const std::string& name) {
  return std::filesystem::path(CAREEN_SOURCE_DIR) / "assets" / "truths" / (name + ".json");
}

std::vector<double> timesOf(const std::string& name, const QuadScene& scene) {
  const int samples = caseNamed(name).samples;
  std::vector<double> times;
  for (int k = 1; k <= samples; ++k) {
    times.push_back(scene.duration * k / samples);
  }
  return times;
}

Truth computeTruth(const std::string& name, std::size_t mostTimes) {
  const TruthCase& found = caseNamed(name);
  Truth truth{.name = name,
              .title = found.title,
              .whyHard = found.whyHard,
              .source = found.source,
              .measure = found.measure,
              .published = found.published};
  if (found.measure == "scaled") {
    truth.of = "corner-impact";
    truth.lengths = 4;
    truth.timesBy = 2;
    return truth;
  }
  const QuadScene scene = oracle::sceneIn(scenePath(name));
  truth.times = timesOf(name, scene);
  truth.times.resize(std::min(truth.times.size(), mostTimes));
  if (found.measure == "poses") {
    const Boxes boxes = found.oracle(scene, truth.times);
    for (const oracle::QuadBox& box : scene.boxes) {
      if (!box.fixed) {
        truth.boxes.push_back(rounded(box.name, boxes.at(truth.boxes.size())));
      }
    }
  }
  return truth;
}

std::string toText(const Truth& truth) {
  std::ostringstream text;
  text << "{\n  \"scene\": " << quoted("hard/" + truth.name + ".json")
       << ",\n  \"title\": " << quoted(truth.title) << ",\n  \"why_hard\": " << quoted(truth.whyHard)
       << ",\n  \"source\": " << quoted(truth.source) << ",\n  \"measure\": " << quoted(truth.measure);
  if (!truth.published.empty()) {
    text << ",\n  \"published\": " << quoted(truth.published);
  }
  if (truth.measure == "scaled") {
    text << ",\n  \"of\": " << quoted("hard/" + truth.of + ".json")
         << ",\n  \"lengths\": " << number(truth.lengths) << ",\n  \"times\": " << number(truth.timesBy);
  } else {
    text << ",\n  \"times\": " << list(truth.times);
  }
  if (!truth.boxes.empty()) {
    text << ",\n  \"boxes\": [";
    for (const TruthBox& box : truth.boxes) {
      text << (&box == truth.boxes.data() ? "" : ",") << "\n    {\n      \"name\": " << quoted(box.name)
           << ",\n      \"positions\": " << table(box.positions)
           << ",\n      \"orientations\": " << table(box.orientations) << "\n    }";
    }
    text << "\n  ]";
  }
  text << "\n}\n";
  return text.str();
}

}  // namespace careen::study
