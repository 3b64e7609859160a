#include "trajectory/pose_table.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/brief.h"
#include "support/input_error.h"

namespace careen {
namespace {

const std::string kTwoRows =
    "time,box,x,y,z,qw,qx,qy,qz\n"
    "0,crate,1,2,3,1,0,0,0\n"
    "0.5,crate,1,2,2.5,1,0,0,0\n";

std::string refusalOf(const std::string& text) {
  return inputErrorOf([&] { readPoseTable(text, "t.csv"); });
}

// The text with the first `from` replaced.
std::string with(const std::string& from, const std::string& to, std::string text = kTwoRows) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(PoseTable, rowsAreRead) {
  const PoseTable table = readPoseTable(kTwoRows, "t.csv");
  EXPECT_EQ(table.boxes, std::vector<std::string>{"crate"});
  EXPECT_FALSE(table.hasVelocities);
  EXPECT_FALSE(table.hasAngularVelocities);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1].time, 0.5);
  EXPECT_EQ(table.rows[1].position, Vec3(1, 2, 2.5));
  EXPECT_EQ(table.rows[1].place, 3U);
}

TEST(PoseTable, otherProgramsWriteOtherwise) {
  const std::string text =
      "\xEF\xBB\xBFqz, qy,qx ,qw,\"time\",z,y,x\r\n"
      " 0 , 0, 0, -1.0000001e+0, 0, 3, +2, .1e1\r\n"
      "\r\n"
      "0,0,0,1,5e-1,2.5,2,1";
  const PoseTable table = readPoseTable(text, "t.csv");
  EXPECT_FALSE(table.hasBoxes);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(table.rows[0].worldFromBody.w(), -1);  // of length 1
  EXPECT_NEAR(table.quaternionError, 1e-7, 1e-15);
  EXPECT_EQ(table.rows[1].place, 4U);
}

TEST(PoseTable, badRowsAreToldWithLineAndColumn) {
  EXPECT_EQ(refusalOf(kTwoRows), "no error");
  EXPECT_EQ(refusalOf(with("2.5", "nan")), "t.csv:3: found nan for z, expected a finite number within 1e60");
  EXPECT_EQ(refusalOf(with("2.5", "-inf")),
            "t.csv:3: found -inf for z, expected a finite number within 1e60");
  EXPECT_EQ(refusalOf(with("2.5", "1e61")),
            "t.csv:3: found 1e+61 for z, expected a finite number within 1e60");
  EXPECT_EQ(refusalOf(with("2.5", "1e999")), "t.csv:3: found '1e999' for z, expected a number");
  EXPECT_EQ(refusalOf(with("2.5", "high")), "t.csv:3: found 'high' for z, expected a number");
  EXPECT_EQ(refusalOf(with("2.5", "")), "t.csv:3: found '' for z, expected a number");
  EXPECT_EQ(refusalOf(with(",2.5", "")),
            "t.csv:3: found 8 cells, expected 9, as the first line has; the file "
            "may be cut short");
  EXPECT_EQ(refusalOf(with("1,2,3", "1,2,3,4")),
            "t.csv:2: found 10 cells, expected 9, as the first line has");
  EXPECT_EQ(refusalOf(with("0.5,crate", "0.5,\"crate")),
            "t.csv:3: found an open quote, expected 9, as the first line has; the file may be cut short");
  EXPECT_EQ(refusalOf(with("0.5,", "0,")),
            "t.csv:3: found time 0 after 0 for box 'crate', expected ascending times of each box");
  EXPECT_EQ(refusalOf(with("0,crate", "-1,crate")), "t.csv:2: found time -1, expected 0 s or later");
  EXPECT_EQ(
      refusalOf(with("2.5,1,", "2.5,1.01,")),
      "t.csv:3: found the quaternion (1.01, 0, 0, 0) for box 'crate', expected one of length 1, to 0.001");
  EXPECT_EQ(refusalOf(with("2.5,1,", "2.5,0,")),
            "t.csv:3: found the quaternion (0, 0, 0, 0) for box 'crate', expected one of length 1, to 0.001");
}

TEST(PoseTable, badColumnsAreTold) {
  EXPECT_EQ(refusalOf(with("qw", "w")).substr(0, 40), "t.csv:1: found the unknown column 'w', e");
  EXPECT_EQ(refusalOf(with("qw", "qx")), "t.csv:1: found the column qx twice, expected it once");
  EXPECT_EQ(refusalOf("time,x,y,z,qw,qx,qy\n"),
            "t.csv:1: found no column qz, expected it: a pose is x, y, z, qw, qx, qy, qz");
  EXPECT_EQ(refusalOf("time,x,y,z,qw,qx,qy,qz,vx,vy\n"),
            "t.csv:1: found no column vz, expected it: a velocity has three components, or is left out");
  EXPECT_EQ(refusalOf("x,y,z,qw,qx,qy,qz\n"),
            "t.csv:1: found no column time, expected it: each row has its time [s]");
  EXPECT_EQ(refusalOf("time,x,y,z,qw,qx,qy,qz\n"), "t.csv: found no rows, expected poses");
  EXPECT_EQ(refusalOf(""), "t.csv: is empty, expected a table of poses");
}

TEST(PoseTable, whatIsOneIsKnownByItsBeginning) {
  EXPECT_TRUE(looksLikePoseTable(kTwoRows, "theirs"));
  EXPECT_TRUE(looksLikePoseTable("x,\"time\",y", "theirs.txt"));
  EXPECT_TRUE(looksLikePoseTable("", "empty.csv"));
  EXPECT_TRUE(looksLikePoseTable("PK\x03\x04 and more", "theirs"));
  EXPECT_FALSE(looksLikePoseTable("{ \"careen\": 1, \"time\": 2 }", "scene.json"));
  EXPECT_FALSE(looksLikePoseTable("// time, and more\n{}", "scene.json"));
  EXPECT_FALSE(looksLikePoseTable("careen\r\n", "run.careen"));
}

// Tables of random numbers of boxes, in any order of rows and columns, come back number for number.
TEST(PoseTable, hundredsOfRandomTablesComeBack) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1e3, 1e3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<std::string_view> columns(kPoseColumns.begin(), kPoseColumns.end());
    std::shuffle(columns.begin(), columns.end(), random);
    const std::size_t boxes = 1 + random() % 4;
    std::vector<std::array<double, kPoseColumns.size()>> rows;
    std::vector<std::string> names;
    std::vector<double> times(boxes, 0);
    std::string text;
    for (const std::string_view column : columns) {
      text.append(text.empty() ? "" : ",").append(column);
    }
    text += '\n';
    for (std::size_t k = 0; k < 20; ++k) {
      const std::size_t box = random() % boxes;
      std::array<double, kPoseColumns.size()> row{};
      for (double& each : row) {
        each = number(random);
      }
      row[0] = times[box] += 1e-3 + std::abs(normal(random));
      const Quat q = Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
      row[5] = q.w();
      row[6] = q.x();
      row[7] = q.y();
      row[8] = q.z();
      std::string line;
      for (const std::string_view column : columns) {
        const auto place = static_cast<std::size_t>(
            std::find(kPoseColumns.begin(), kPoseColumns.end(), column) - kPoseColumns.begin());
        line +=
            (line.empty() ? "" : ",") + (place == 1 ? "box " + std::to_string(box) : brief(row[place], 17));
      }
      text += line + '\n';
      rows.push_back(row);
      names.push_back("box " + std::to_string(box));
    }
    const PoseTable table = readPoseTable(text, "t");
    ASSERT_EQ(table.rows.size(), rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const PoseRow& row = table.rows[k];
      EXPECT_EQ(table.boxes[row.box], names[k]);
      EXPECT_EQ(row.time, rows[k][0]);
      EXPECT_EQ(row.position, Vec3(rows[k][2], rows[k][3], rows[k][4]));
      EXPECT_EQ(row.velocity, Vec3(rows[k][9], rows[k][10], rows[k][11]));
      EXPECT_EQ(row.angularVelocity, Vec3(rows[k][12], rows[k][13], rows[k][14]));
      EXPECT_NEAR(row.worldFromBody.dot(Quat(rows[k][5], rows[k][6], rows[k][7], rows[k][8])), 1, 1e-15);
    }
    // Cut anywhere, a table is read up to there or refused, never read as another.
    const std::size_t cut = random() % text.size();
    const std::string refusal = inputErrorOf([&] { readPoseTable(text.substr(0, cut), "t.csv"); });
    if (refusal == "no error") {
      EXPECT_LE(readPoseTable(text.substr(0, cut), "t.csv").rows.size(), rows.size());
    }
  }
}

// The earliest row need not be the first.
TEST(PoseTable, timesCountFromTheEarliestRow) {
  const std::string text =
      "time,box,x,y,z,qw,qx,qy,qz\n"
      "101,a,0,0,0,1,0,0,0\n102.5,a,0,0,0,1,0,0,0\n100,b,0,0,0,1,0,0,0\n";
  PoseTable table = readPoseTable(text, "table.csv");
  EXPECT_EQ(table.firstTime(), 100);
  table.beginAtZero();
  EXPECT_EQ(table.firstTime(), 0);
  EXPECT_EQ(table.rows[0].time, 1);
  EXPECT_EQ(table.rows[1].time, 2.5);
  EXPECT_EQ(table.rows[2].time, 0);
}

}  // namespace
}  // namespace careen
