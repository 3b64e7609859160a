#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// Columns of a table of poses, in the order in which careen writes them.
inline constexpr std::array<std::string_view, 15> kPoseColumns = {
    "time", "box", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"};

/// What each of them is measured in.
inline constexpr std::array<std::string_view, 15> kPoseUnits = {
    "s", "", "m", "m", "m", "1", "1", "1", "1", "m/s", "m/s", "m/s", "rad/s", "rad/s", "rad/s"};

/// One row: the pose of one box at one time, world frame.
struct PoseRow {
  double time = 0;                        ///< [s]
  std::size_t box = 0;                    ///< index in PoseTable::boxes
  Vec3 position = Vec3::Zero();           ///< [m] centre of mass
  Quat worldFromBody = Quat::Identity();  ///< of length 1, with either sign
  Vec3 velocity = Vec3::Zero();           ///< [m/s] 0 if the table has none
  Vec3 angularVelocity = Vec3::Zero();    ///< [rad/s] likewise
  std::size_t place = 0;                  ///< line of the file from 1, or row of an array from 0

  /// In the order of kPoseColumns, from "x" on.
  std::array<double, kPoseColumns.size() - 2> numbers() const;
};

/// A table of poses, read from CSV or NPZ, not yet compared with any scene.
struct PoseTable {
  std::string name;                ///< of its file, for messages
  std::string placeFormat;         ///< "line" or "row": what PoseRow::place counts
  std::vector<std::string> boxes;  ///< in order of appearance; one without a name if there is no such column
  bool hasBoxes = false;           ///< there is a column of names
  bool hasVelocities = false;
  bool hasAngularVelocities = false;
  std::vector<PoseRow> rows;   ///< finite numbers; of each box with ascending times
  double quaternionError = 0;  ///< [1] the largest |length − 1| found

  /// [s] of the earliest row.
  double firstTime() const;
  /// Subtracts it from all times: clocks begin anywhere.
  void beginAtZero();
  /// InputError: "table.csv:17: found …, expected …", "run.npz: row 3: found …, expected …"
  [[noreturn]] void fail(const PoseRow& row, const std::string& found, const std::string& expected) const;
};

/// Whether the bytes, or the name's extension, are those of a table of poses: NPZ, .npz, .csv, or text whose
/// first line is a list of words with commas between, one of them "time".
bool looksLikePoseTable(std::string_view bytes, std::string_view name);

/// Reads CSV (RFC 4180), or NPZ with arrays of the same names. The first line of CSV names the columns, in
/// any order: kPoseColumns. Needed are time, position and quaternion, of velocities either all three or none,
/// and box unless there is only one. An NPZ file has arrays of equal length, or arrays of times × boxes with
/// `time` of the first and `box` of the second length.
///
/// InputError names file, line and column for everything else: unknown, missing or doubled columns, a row
/// of another length, what is no finite number or beyond ±1e60, times before 0 or not ascending, quaternions
/// whose length differs from 1 by more than 1e-3.
PoseTable readPoseTable(const std::string& bytes, const std::string& name);

/// The quaternions may be this far from length 1.
inline constexpr double kMostQuaternionError = 1e-3;

/// Checks and takes in the rows of a table as they are read.
class PoseTableBuilder {
 public:
  /// `columns`: names, in the file's order. InputError, which `where` begins, if they are not those of a
  /// table.
  PoseTableBuilder(PoseTable table, const std::vector<std::string>& columns, const std::string& where);

  /// The index of this column in the file; kAbsent if it is not there.
  static constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);
  std::size_t indexOf(std::string_view column) const;

  /// `numbers` and `box` of one row; numbers[k] is that of kPoseColumns[k], anything for absent columns.
  void add(std::size_t place, const std::array<double, kPoseColumns.size()>& numbers, std::string_view box);

  PoseTable finish();
  const PoseTable& table() const { return table_; }

 private:
  std::size_t boxNamed(std::string_view name);
  std::string nameShown(const PoseRow& row) const;

  PoseTable table_;
  std::array<std::size_t, kPoseColumns.size()> places_{};
  std::map<std::string, std::size_t> indices_;
  std::vector<double> lastTimes_;  // of each box
  std::size_t lastBox_ = 0;
};

}  // namespace careen
