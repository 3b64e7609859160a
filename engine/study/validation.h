#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "trajectory/pose_table.h"
#include "trajectory/trajectory.h"

namespace careen {

/// How a simulation begins where a measurement does.
enum class MeasuredStart : int {
  kFitted,  ///< the free flight closest to all rows before the first impact
  kFirst    ///< the first row; its velocities are the table's, or estimated
};

/// One measured toss beside the same one simulated.
struct Toss {
  std::string name;              ///< of its file
  std::vector<double> times;     ///< [s] of the measured rows, from 0
  std::vector<double> place;     ///< [m] distance of the simulated from the measured, mean of all boxes
  std::vector<double> attitude;  ///< [rad] likewise
  double meanPlace = 0;          ///< [m] over all rows
  double largestPlace = 0;       ///< [m]
  double meanAttitude = 0;       ///< [rad]
  double largestAttitude = 0;    ///< [rad]
  double floorPlace = 0;     ///< [m] mean distance of runs from starts that the measurement allows as well
  double floorAttitude = 0;  ///< [rad] likewise
  std::size_t fitted = 0;    ///< rows that the start was fitted to; 0: it was not
  double positionNoise = 0;  ///< [m] of the rows in flight, for each coordinate
  double attitudeNoise = 0;  ///< [rad] likewise, about each axis
  std::string measuredFace;  ///< of the first box, up in the last row: "+x" … "-z"
  std::string simulatedFace;
  std::size_t impacts = 0;  ///< of the simulation
  double seconds = 0;       ///< [s] that it took
};

/// What is done to the scene's parameters before it is simulated.
enum class Parameter : int { kFriction, kRestitution, kInertia };
inline constexpr std::array<std::string_view, 3> kParameterNames = {"friction", "restitution", "inertia"};

/// A value of a parameter: of friction and restitution that of every pair, of inertia a factor of all
/// moments.
struct Setting {
  Parameter parameter{};
  double value = 0;
};

struct ValidationSettings {
  MeasuredStart start = MeasuredStart::kFitted;
  int floorRuns = 8;  ///< starts that the noise floor is the mean of
  std::optional<Setting> setting = {};
};

/// The setup that measurements are simulated with: all of the scene, by method exact.
RunSetup setupOfMeasured(const Scene& scene);

/// Simulates what was measured. Times count from the first row of the table. `simulated`, if not null, gets
/// the run. InputError if the table is not one of the setup's boxes; an Error of the method passes.
Toss validate(const RunSetup& setup, const PoseTable& measured, const ValidationSettings& settings,
              const std::stop_token& stop, Trajectory* simulated = nullptr);

/// [m] What places are relative to: the geometric mean of the sides of the boxes that can move.
double sizeOf(const World& world);

/// The value that every touching pair has, or the only moment factor: what a sweep's curve is compared with.
/// Absent if pairs differ.
std::optional<double> valueOf(const World& world, Parameter parameter);

/// Mean and standard deviation over tosses.
struct Spread {
  double mean = 0;
  double deviation = 0;
};
Spread spreadOf(const std::vector<Toss>& tosses, double Toss::*figure);

/// A sweep's point: the mean over all tosses with one value.
struct SweepPoint {
  double value = 0;
  double place = 0;     ///< [m]
  double attitude = 0;  ///< [rad]
};

/// The point of least place. `points` are not empty, with ascending values.
const SweepPoint& leastOf(const std::vector<SweepPoint>& points);
/// The value where the parabola through that point and its neighbours has its minimum.
double minimumOf(const std::vector<SweepPoint>& points);

/// results.csv: a row for each toss. errors.csv: a row for each measured moment. sweep.csv.
std::string tossesCsv(const std::vector<Toss>& tosses, double size);
std::string errorsCsv(const std::vector<Toss>& tosses);
std::string sweepCsv(const std::vector<SweepPoint>& points, Parameter parameter);

}  // namespace careen
