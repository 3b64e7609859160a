#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace careen {

/// A steel cuboid with edges y, y and x, and what was measured of it: Mathematical Gazette 97.16 (2013).
struct MeasuredDie {
  double ratio = 0;   ///< [1] x/y
  double square = 0;  ///< [1] part of the rolls that ended with a square face, y by y, up
  int rolls = 0;
};
/// Fifteen. The rolls add up to 9329, where 9299 is quoted as their sum.
inline constexpr std::array<MeasuredDie, 15> kMeasuredDice = {{{0.47, 0.916, 332},
                                                               {0.63, 0.738, 840},
                                                               {0.75, 0.548, 799},
                                                               {0.81, 0.496, 740},
                                                               {0.93, 0.399, 516},
                                                               {0.97, 0.385, 530},
                                                               {1.16, 0.148, 1011},
                                                               {1.23, 0.154, 532},
                                                               {1.44, 0.052, 654},
                                                               {1.55, 0.040, 606},
                                                               {1.60, 0.017, 702},
                                                               {1.71, 0.031, 609},
                                                               {1.87, 0.009, 680},
                                                               {2.12, 0.007, 275},
                                                               {2.65, 0.006, 503}}};

/// How dice are thrown on a level floor; none of it is known of the measurement. The attitude is uniformly
/// distributed, the angular velocity uniformly in a ball.
struct ThrowSettings {
  double restitution = 0.5;
  double friction = 0.3;
  double height = 0.2;  ///< [m] of the centre
  double speed = 1;     ///< [m/s] along the floor
  double spin = 40;     ///< [rad/s] largest angular speed
  int throws = 10000;
  int threads = 1;
};

/// Edge y [m]: of a die as large as dice are.
inline constexpr double kDieEdge = 0.015;

/// The faces that dice of one shape ended on.
struct Faces {
  int square = 0;
  int other = 0;
  int undecided = 0;  ///< still moving after kLongestThrow, on an edge or leaning, or lost by the method

  /// [1] part of the throws that ended on a face.
  double probability() const;
};
inline constexpr double kLongestThrow = 20;  ///< [s]

/// Throws one shape. Throw k is the same whatever the number of throws and threads. Interrupted if stopped.
/// `progress` is told of the throws begun, now and then, by the thread that called.
Faces throwDice(double ratio, const ThrowSettings& settings, const std::stop_token& stop,
                const std::function<void(int)>& progress = {});

/// The interval around a part `p` of `count` trials that holds the true probability in 95 of 100 cases (E. B.
/// Wilson 1927).
struct Band {
  double low = 0;
  double high = 0;
};
Band bandOf(double p, int count);

/// Distance of the thrown from the measured part, in standard deviations of their difference, both of
/// binomial distributions.
double deviationOf(const Faces& thrown, const MeasuredDie& measured);

/// All fifteen with one setting.
struct DiceResult {
  ThrowSettings settings;
  std::vector<Faces> faces;  ///< as kMeasuredDice

  /// How many are within two standard deviations.
  int within() const;
};
/// One row for each die and setting.
std::string diceCsv(const std::vector<DiceResult>& results);
/// The first setting in full, then one row for each.
std::string diceMarkdown(const std::vector<DiceResult>& results);

}  // namespace careen
