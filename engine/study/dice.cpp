#include "study/dice.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <exception>
#include <optional>
#include <sstream>
#include <thread>
#include <variant>

#include "core/brief.h"
#include "core/error.h"
#include "core/table.h"
#include "physics/simulate.h"
#include "physics/world/method.h"

namespace careen {
namespace {

constexpr double kUpright = 0.999;  // cosine: at rest on a face, to the tolerance of contact

// SplitMix64 (G. Steele and others 2014): the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// From -1 to 1.
  double next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t state_;
};

// Uniform in the unit ball, by rejection.
template <class Vector>
Vector inBall(Random& random) {
  Vector v;
  do {
    for (double& part : v) {
      part = random.next();
    }
  } while (!(v.squaredNorm() <= 1 && v.squaredNorm() > 1e-6));
  return v;
}

// The last motion of the only body.
class LastMotion : public Recorder {
 public:
  void moves(BodyIndex /*body*/, double /*time*/, const Motion& motion) override { last_ = motion; }
  void strikes(const Impact& /*impact*/) override {}
  const Rest* rest() const { return std::get_if<Rest>(&last_); }

 private:
  Motion last_;
};

World thrown(double ratio, const ThrowSettings& settings, std::uint64_t number) {
  constexpr double kSteel = 7850;  // [kg/m³]
  Random random(number * 0x2545f4914f6cdd1dU + 1);
  const Material material{.restitution = settings.restitution, .friction = settings.friction};
  Body die{.name = "die",
           .halfExtents = 0.5 * kDieEdge * Vec3(ratio, 1, 1),
           .mass = {},
           .material = material,
           .initial = {}};
  die.mass = solidBox(die.halfExtents, kSteel * 8 * die.halfExtents.prod());
  const Vec4 q = inBall<Vec4>(random).normalized();
  die.initial.pose = {.position = Vec3(0, 0, settings.height),
                      .worldFromBody = Quat(q[0], q[1], q[2], q[3]).toRotationMatrix()};
  die.initial.velocity = Vec3(settings.speed, 0, 0);
  die.initial.angularMomentum =
      angularMomentum(die.mass, die.initial.pose.worldFromBody, settings.spin * inBall<Vec3>(random));
  World world;
  world.bodies.push_back(std::move(die));
  world.walls.push_back({.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = material});
  world.gravity = Vec3(0, 0, -9.81);
  return world;
}

// The axis of the box that is upright at the end; none if it is not on a face.
std::optional<int> axisUp(const World& world, const std::stop_token& stop) {
  LastMotion motion;
  RunSettings settings;
  settings.method = Method::kExact;
  settings.duration = kLongestThrow;
  try {
    simulate(world, settings, motion, stop);
  } catch (const Error&) {
    return std::nullopt;
  }
  if (motion.rest() == nullptr) {
    return std::nullopt;
  }
  const Vec3 up = motion.rest()->pose.worldFromBody.row(2).cwiseAbs();
  for (int axis = 0; axis < 3; ++axis) {
    if (up[axis] > kUpright) {
      return axis;
    }
  }
  return std::nullopt;
}

std::string partOf(double p) { return brief(p, 3); }

}  // namespace

double Faces::probability() const {
  return square + other > 0 ? static_cast<double>(square) / (square + other) : 0;
}

Faces throwDice(double ratio, const ThrowSettings& settings, const std::stop_token& stop,
                const std::function<void(int)>& progress) {
  std::atomic<int> next = 0;
  std::atomic<int> square = 0;
  std::atomic<int> other = 0;
  std::exception_ptr failure;
  std::atomic<bool> failed = false;
  const auto work = [&](const std::function<void(int)>& tell) {
    try {
      for (int k = next++; k < settings.throws && !failed; k = next++) {
        const std::optional<int> up = axisUp(thrown(ratio, settings, static_cast<std::uint64_t>(k)), stop);
        square += up == 0 ? 1 : 0;
        other += up && *up != 0 ? 1 : 0;
        if (tell) {
          tell(std::min(next.load(), settings.throws));
        }
      }
    } catch (...) {
      if (!failed.exchange(true)) {
        failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 1; i < settings.threads; ++i) {
      threads.emplace_back(work, nullptr);
    }
    work(progress);
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  return {.square = square, .other = other, .undecided = settings.throws - square - other};
}

// With z = 1.96: centre (p + z²/2n)/(1 + z²/n), half width z √(p(1−p)/n + z²/4n²)/(1 + z²/n).
Band bandOf(double p, int count) {
  constexpr double kZ = 1.96;
  const double n = count;
  const double scale = 1 / (1 + kZ * kZ / n);
  const double middle = scale * (p + kZ * kZ / (2 * n));
  const double half = scale * kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

// The variances are of the pooled part, which is never 0 where the two differ.
double deviationOf(const Faces& thrown, const MeasuredDie& measured) {
  const double mine = thrown.square + thrown.other;
  const double theirs = measured.rolls;
  const double pooled = (thrown.square + measured.square * theirs) / (mine + theirs);
  const double variance = pooled * (1 - pooled) * (1 / mine + 1 / theirs);
  const double apart = thrown.probability() - measured.square;
  return apart == 0 ? 0 : apart / std::sqrt(variance);
}

int DiceResult::within() const {
  int count = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    count += std::fabs(deviationOf(faces[i], kMeasuredDice.at(i))) <= 2 ? 1 : 0;
  }
  return count;
}

std::string diceCsv(const std::vector<DiceResult>& results) {
  Table table{.head = {"restitution", "friction", "height", "speed", "spin", "ratio", "throws", "square",
                       "undecided", "probability", "low", "high", "measured", "rolls", "deviation"}};
  for (const DiceResult& result : results) {
    const ThrowSettings& settings = result.settings;
    for (std::size_t i = 0; i < result.faces.size(); ++i) {
      const Faces& faces = result.faces[i];
      const MeasuredDie& measured = kMeasuredDice.at(i);
      const Band band = bandOf(faces.probability(), faces.square + faces.other);
      table.rows.push_back({inFull(settings.restitution), inFull(settings.friction), inFull(settings.height),
                            inFull(settings.speed), inFull(settings.spin), inFull(measured.ratio),
                            std::to_string(settings.throws), std::to_string(faces.square),
                            std::to_string(faces.undecided), inFull(faces.probability()), inFull(band.low),
                            inFull(band.high), inFull(measured.square), std::to_string(measured.rolls),
                            inFull(deviationOf(faces, measured))});
    }
  }
  return table.csv();
}

std::string diceMarkdown(const std::vector<DiceResult>& results) {
  std::ostringstream text;
  text
      << "# Cuboid dice\n\nPart of the throws that end with a square face up, of cuboids with edges y, y and "
         "x; measured: 9329 rolls\n(Mathematical Gazette 97.16, 2013). The bands hold the true probability "
         "in 95 of 100 cases.\n";
  if (results.empty()) {
    return text.str();
  }
  const DiceResult& first = results.front();
  text << "\n## Restitution " << brief(first.settings.restitution) << ", friction "
       << brief(first.settings.friction) << ", from " << brief(first.settings.height) << " m at "
       << brief(first.settings.speed) << " m/s and up to " << brief(first.settings.spin) << " rad/s\n\n";
  Table shapes{.head = {"x/y", "thrown", "band", "measured", "band", "standard deviations"}};
  for (std::size_t i = 0; i < first.faces.size(); ++i) {
    const Faces& faces = first.faces[i];
    const MeasuredDie& measured = kMeasuredDice.at(i);
    const Band mine = bandOf(faces.probability(), faces.square + faces.other);
    const Band theirs = bandOf(measured.square, measured.rolls);
    shapes.rows.push_back({brief(measured.ratio), partOf(faces.probability()),
                           partOf(mine.low) + "–" + partOf(mine.high), partOf(measured.square),
                           partOf(theirs.low) + "–" + partOf(theirs.high),
                           brief(deviationOf(faces, measured), 2)});
  }
  Table unknown{.head = {"restitution", "friction", "height [m]", "speed [m/s]", "spin [rad/s]",
                         "within two standard deviations", "mean distance", "undecided"}};
  for (const DiceResult& result : results) {
    double sum = 0;
    int undecided = 0;
    for (std::size_t i = 0; i < result.faces.size(); ++i) {
      sum += std::fabs(result.faces[i].probability() - kMeasuredDice.at(i).square);
      undecided += result.faces[i].undecided;
    }
    const ThrowSettings& settings = result.settings;
    unknown.rows.push_back(
        {brief(settings.restitution), brief(settings.friction), brief(settings.height), brief(settings.speed),
         brief(settings.spin), std::to_string(result.within()) + " of " + std::to_string(result.faces.size()),
         brief(sum / static_cast<double>(result.faces.size()), 2), std::to_string(undecided)});
  }
  text << shapes.markdown() << "\n## What is not known of the throws\n\n" << unknown.markdown();
  return text.str();
}

}  // namespace careen
