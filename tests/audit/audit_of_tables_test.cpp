// Runs that come from tables of poses: what is right passes, and each kind of wrong is found.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "audit/audit.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/export_csv.h"
#include "trajectory/given_run.h"
#include "trajectory/pose_table.h"

namespace careen {
namespace {

const std::string kTumbling = R"({"careen": 1, "duration": 1, "gravity": [0, 0, -9.81], "boxes": [
  {"name": "crate", "half_extents": [0.1, 0.2, 0.3], "mass": 2, "position": [0, 0, 9],
   "velocity": [1, 0, 2], "angular_velocity": [3, 2, 1]}]})";
const std::string kBouncingTable = R"({"careen": 1, "duration": 2, "gravity": [0, 0, -9.81],
  "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.6, "friction": 0.4}],
  "boxes": [{"name": "crate", "half_extents": [0.1, 0.2, 0.3], "mass": 2, "position": [0, 0, 1], "friction": 0.4,
             "angular_velocity": [1, 2, 3], "velocity": [1, 0, 0]}]})";
const std::string kMeeting = R"({"careen": 1, "duration": 2, "boxes": [
  {"name": "left", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [-1, 0, 0], "velocity": [1, 0, 0],
   "angular_velocity": [1, 2, 3], "restitution": 1},
  {"name": "right", "half_extents": [0.1, 0.2, 0.1], "mass": 2, "position": [1, 0.05, 0], "velocity": [-1, 0, 0],
   "restitution": 1}]})";
const std::string kSlidingTable = R"({"careen": 1, "duration": 1, "gravity": [0, 0, -9.81],
  "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.5}],
  "boxes": [{"name": "slider", "half_extents": [0.3, 0.2, 0.1], "mass": 2, "position": [0, 0, 0.1],
             "velocity": [2, 0, 0], "friction": 0.5},
            {"name": "rider", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [0, 0, 0.3],
             "velocity": [2, 0, 0], "friction": 0.5}]})";

PoseTable tableOf(const std::string& scene, double every = 1.0 / 240) {
  std::string text;
  writePosesCsv(record(setupOf(parseScene(scene, "s"))), every,
                [&text](std::string_view piece) { text += piece; });
  return readPoseTable(text, "t.csv");
}

Audit auditOf(const std::string& scene, const PoseTable& table, const AuditLimits& limits = {}) {
  return audit(givenRun(setupOf(parseScene(scene, "s")), table), AuditDepth::kFull, {}, limits);
}

std::string kindsOf(const Audit& audit) {
  std::string kinds;
  for (const AuditBreach& breach : audit.breaches) {
    kinds.append(kinds.empty() ? "" : " ").append(traitsOf(breach.kind).name);
  }
  return kinds;
}

TEST(AuditOfTables, soundTablesPass) {
  for (const std::string& scene : {kTumbling, kBouncingTable, kMeeting, kSlidingTable}) {
    PoseTable table = tableOf(scene);
    for (const bool hasVelocities : {true, false}) {
      table.hasVelocities = hasVelocities;
      table.hasAngularVelocities = hasVelocities;
      const Audit found = auditOf(scene, table);
      EXPECT_EQ(kindsOf(found), "") << scene << hasVelocities;
      EXPECT_GT(found.looks, 200U);
    }
  }
}

// What is flown at the table's rows is known to rounding.
TEST(AuditOfTables, aFlightThatIsGivenIsHeldToRounding) {
  EXPECT_EQ(kindsOf(auditOf(kTumbling, tableOf(kTumbling), {.table = 1e-9})), "");
}

struct WrongTable {
  const char* what;
  std::string scene;
  std::function<void(PoseTable&)> make;
  std::string kinds;  // that begin the list
};

TEST(AuditOfTables, everyKindOfWrongIsFound) {
  const auto after = [](double time, const std::function<void(PoseRow&)>& change) {
    return [time, change](PoseTable& table) {
      for (PoseRow& row : table.rows) {
        if (row.time > time) {
          change(row);
        }
      }
    };
  };
  const std::vector<WrongTable> wrongs = {
      {"another gravity", kTumbling,
       [](PoseTable& table) {
         for (PoseRow& row : table.rows) {
           row.velocity.z() += 0.4 * row.time;
           row.position.z() += 0.2 * row.time * row.time;
         }
       },
       "linear_momentum"},
      {"a kick in flight", kTumbling,
       after(0.5,
             [](PoseRow& row) {
               row.velocity.x() += 0.3;
               row.position.x() += 0.3 * (row.time - 0.5);
             }),
       "linear_momentum energy_rise"},
      {"spin that slows down", kTumbling,
       [](PoseTable& table) {
         for (PoseRow& row : table.rows) {
           row.angularVelocity *= 1 - 0.05 * row.time;
         }
       },
       "angular_momentum"},
      {"spin in the frame of the body", kTumbling,
       [](PoseTable& table) {
         for (PoseRow& row : table.rows) {
           row.angularVelocity = row.worldFromBody.conjugate() * row.angularVelocity;
         }
       },
       "angular_momentum"},
      {"a jump", kTumbling, after(0.5, [](PoseRow& row) { row.position.x() += 0.02; }), "continuity"},
      {"velocities in another unit", kTumbling,
       [](PoseTable& table) {
         for (PoseRow& row : table.rows) {
           row.velocity *= 1000;
         }
       },
       "continuity"},
      {"a box in the floor", kBouncingTable, after(0.3, [](PoseRow& row) { row.position.z() -= 0.05; }),
       "continuity wall_overlap"},
      {"boxes in each other", kMeeting,
       after(-1,
             [](PoseRow& row) {
               row.position.x() *= row.box == 0 ? 0.95 : 1;
               row.velocity.x() *= row.box == 0 ? 0.95 : 1;
             }),
       "box_overlap"},
      {"restitution above 1", kBouncingTable,
       [](PoseTable& table) {
         bool isUp = false;
         for (PoseRow& row : table.rows) {
           isUp = isUp || row.velocity.z() > 0;
           row.velocity.z() *= isUp ? 2 : 1;
         }
       },
       "energy_rise"},
  };
  for (const WrongTable& wrong : wrongs) {
    PoseTable table = tableOf(wrong.scene);
    wrong.make(table);
    const Audit found = auditOf(wrong.scene, table);
    const std::string kinds = kindsOf(found);
    for (std::size_t at = 0; at < wrong.kinds.size();) {
      const std::size_t end = std::min(wrong.kinds.find(' ', at), wrong.kinds.size());
      EXPECT_NE(kinds.find(wrong.kinds.substr(at, end - at)), std::string::npos)
          << wrong.what << ": " << kinds;
      at = end + 1;
    }
    ASSERT_FALSE(found.breaches.empty()) << wrong.what;
  }
}

TEST(AuditOfTables, whatIsAllowedIsNoBreach) {
  PoseTable table = tableOf(kTumbling);
  for (PoseRow& row : table.rows) {
    row.velocity.z() += 0.4 * row.time;
    row.position.z() += 0.2 * row.time * row.time;
  }
  const auto any = [](std::initializer_list<AuditKind> kinds) {
    AuditLimits limits;
    for (const AuditKind kind : kinds) {
      limits.sizes[kind] = std::nullopt;
    }
    return limits;
  };
  EXPECT_EQ(kindsOf(auditOf(kTumbling, table, {.table = 10})), "");
  EXPECT_EQ(kindsOf(auditOf(
                kTumbling, table,
                any({AuditKind::kLinearMomentum, AuditKind::kAngularMomentum, AuditKind::kEnergyLoss}))),
            "");
  AuditLimits one = any({AuditKind::kAngularMomentum, AuditKind::kEnergyLoss});
  const double largest = auditOf(kTumbling, table).figure(AuditKind::kLinearMomentum).size;
  one.sizes[AuditKind::kLinearMomentum] = 1.01 * largest;
  EXPECT_EQ(kindsOf(auditOf(kTumbling, table, one)), "");
  one.sizes[AuditKind::kLinearMomentum] = 0.99 * largest;
  const Audit found = auditOf(kTumbling, table, one);
  ASSERT_EQ(kindsOf(found), "linear_momentum");
  const std::string text = describe(found.breaches[0], givenRun(setupOf(parseScene(kTumbling, "s")), table));
  EXPECT_NE(text.find("crate: unexplained linear momentum"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with(" is allowed")) << text;
}

}  // namespace
}  // namespace careen
