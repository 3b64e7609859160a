// What the audit of a table finds as it follows boxes from row to row. Without it, friction, restitution and
// attitudes are not found.
#include "audit/between_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "audit/audit.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/export_csv.h"
#include "trajectory/given_run.h"
#include "trajectory/pose_table.h"

namespace careen {
namespace {

std::string blockOnFloor(double friction, double restitution, double height, double tilt = 0) {
  const std::string pair =
      R"("friction": )" + std::to_string(friction) + R"(, "restitution": )" + std::to_string(restitution);
  const double sine = std::sin(tilt);
  const double cosine = std::cos(tilt);
  const auto at = [&](double x, double z) {
    return "[" + std::to_string(x) + ", 0, " + std::to_string(z) + "]";
  };
  return R"({"careen": 1, "duration": 1, "gravity": )" + at(-9.81 * sine, -9.81 * cosine) +
         R"(, "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], )" + pair +
         R"(}], "boxes": [{"name": "block", "half_extents": [0.2, 0.15, 0.1], "mass": 2, "position": )" +
         at(0, 0.1 + height) + R"(, "velocity": [1, 0, 0], )" + pair + "}]}";
}

PoseTable rowsOf(const std::string& scene, double rate) {
  std::string text;
  writePosesCsv(record(setupOf(parseScene(scene, "s"))), 1 / rate,
                [&text](std::string_view piece) { text += piece; });
  return readPoseTable(text, "t.csv");
}

std::string breachesOf(const std::string& scene, const PoseTable& table) {
  std::string kinds;
  for (const AuditBreach& breach :
       audit(givenRun(setupOf(parseScene(scene, "s")), table), AuditDepth::kUsual).breaches) {
    kinds.append(traitsOf(breach.kind).name).append(" ");
  }
  return kinds;
}

TEST(BetweenRows, frictionThatIsMissing) {
  const std::string scene = blockOnFloor(0.5, 0, 0);
  for (const double rate : {30., 60., 120., 240., 1000.}) {
    EXPECT_EQ(breachesOf(scene, rowsOf(scene, rate)), "") << rate;
    EXPECT_EQ(breachesOf(scene, rowsOf(blockOnFloor(0, 0, 0), rate)), "friction ") << rate;
    EXPECT_EQ(breachesOf(scene, rowsOf(blockOnFloor(0.25, 0, 0), rate)), "friction ") << rate;
  }
}

TEST(BetweenRows, bouncesOfAnotherRestitution) {
  const std::string scene = blockOnFloor(0, 0.5, 0.3);
  for (const double rate : {30., 60., 120., 240., 1000.}) {
    EXPECT_EQ(breachesOf(scene, rowsOf(scene, rate)), "") << rate;
    for (const double wrong : {0., 0.2, 0.8, 1.}) {
      if (wrong == 0 && rate < 60) {
        continue;  // what lands and stays gets as large an impulse by its weight
      }
      EXPECT_NE(breachesOf(scene, rowsOf(blockOnFloor(0, wrong, 0.3), rate)).find("restitution"),
                std::string::npos)
          << rate << ' ' << wrong;
    }
  }
}

TEST(BetweenRows, hoveringAboveASlope) {
  const std::string scene = blockOnFloor(0.8, 0, 0, 0.3);
  for (const double rate : {60., 120., 240., 1000.}) {
    PoseTable table = rowsOf(scene, rate);
    EXPECT_EQ(breachesOf(scene, table), "") << rate;
    for (PoseRow& row : table.rows) {
      row.position.z() += 1e-3;
    }
    EXPECT_NE(breachesOf(scene, table).find("linear_momentum"), std::string::npos) << rate;
  }
}

TEST(BetweenRows, attitudesThatDoNotFollowFromSpins) {
  const std::string scene = R"({"careen": 1, "duration": 1, "boxes": [{"name": "a", "mass": 1,
    "half_extents": [0.1, 0.2, 0.3], "position": [0, 0, 0], "angular_velocity": [1, 2, 3]}]})";
  PoseTable table = rowsOf(scene, 60);
  EXPECT_EQ(breachesOf(scene, table), "");
  for (PoseRow& row : table.rows) {
    row.worldFromBody = row.worldFromBody.conjugate();
  }
  EXPECT_NE(breachesOf(scene, table).find("continuity"), std::string::npos);
}

// Both walls of an edge are struck between two rows: neither flight reaches both.
TEST(BetweenRows, twoWallsBetweenTwoRows) {
  const std::string scene = R"({"careen": 1, "duration": 1, "walls": [
    {"name": "x", "point": [0, 0, 0], "normal": [1, 0, 0], "restitution": 1},
    {"name": "z", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 1}], "boxes": [
    {"name": "a", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [1.1, 0, 1.12],
     "velocity": [-2, 0, -2], "restitution": 1}]})";
  for (const double rate : {5., 8., 30.}) {
    EXPECT_EQ(breachesOf(scene, rowsOf(scene, rate)), "") << rate;
  }
}

}  // namespace
}  // namespace careen
