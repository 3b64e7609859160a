#include "trajectory/export_csv.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/article_equations.h"
#include "support/trajectories.h"

namespace careen {
namespace {

std::vector<std::string> posesOf(const Trajectory& trajectory, double every) {
  std::string text;
  writePosesCsv(trajectory, every, [&text](std::string_view piece) { text += piece; });
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

TEST(PosesCsv, hasARowPerBodyAndSampleFromZeroToTheEnd) {
  const std::vector<std::string> lines = posesOf(driftAndReturn(), 0.25);
  ASSERT_EQ(lines.size(), 1U + 5U * 2U);
  EXPECT_EQ(lines[0], "time,box,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
  EXPECT_EQ(lines[1], "0,drifter,1,0,0,1,0,0,0,2,0,0,0,0,0");
  EXPECT_EQ(lines[2], "0,anchor,0,5,0,1,0,0,0,0,0,0,0,0,0");
  EXPECT_EQ(lines[3], "0.25,drifter,1.5,0,0,1,0,0,0,2,0,0,0,0,0");
  EXPECT_TRUE(lines[9].starts_with("1,drifter,1,0,0,")) << lines[9];
}

TEST(PosesCsv, leavesOutASampleBehindTheEnd) {
  EXPECT_EQ(posesOf(driftAndReturn(), 0.3).size(), 1U + 4U * 2U);  // 0, 0.3, 0.6, 0.9
  EXPECT_EQ(posesOf(driftAndReturn(), 5).size(), 1U + 2U);
}

// 24 · 0.05 is 1.2000000000000002.
TEST(PosesCsv, keepsTheLastSampleThatRoundingPutsBehindTheEnd) {
  Trajectory trajectory = driftAndReturn();
  trajectory.settings.duration = 1.2;
  const std::vector<std::string> lines = posesOf(trajectory, 0.05);
  ASSERT_EQ(lines.size(), 1U + 25U * 2U);
  EXPECT_TRUE(lines.back().starts_with("1.2,") || lines.back().starts_with("1.19999999999999"))
      << lines.back();
}

TEST(PosesCsv, refusesMoreSamplesThanAnybodyReads) {
  EXPECT_THROW(posesOf(driftAndReturn(), 1e-300), InputError);
}

TEST(PosesCsv, writesDoublesThatComeBackBitForBit) {
  Trajectory trajectory = driftAndReturn();
  const double third = 1. / 3;
  std::get<EulerStep>(trajectory.tracks[0].segments.open()[0].motion).start.pose.position.x() = third;
  const std::string row = posesOf(trajectory, 5)[1];
  EXPECT_TRUE(row.starts_with("0,drifter,0.33333333333333331,")) << row;
  EXPECT_EQ(std::stod(row.substr(10)), third);
}

// ω = L / I about z: I = 2/12 (0.2² + 0.4²) = 1/30, so L = 1/3 gives 10 rad/s.
TEST(PosesCsv, givesAngularVelocityOfTheWorldFrame) {
  const std::string row = posesOf(driftAndReturn(), 0.5)[3];
  EXPECT_NEAR(std::stod(row.substr(row.rfind(',') + 1)), 10.0, 1e-14) << row;  // measured 0
}

TEST(PosesCsv, choosesTheQuaternionWithPositiveFirstPart) {
  Trajectory trajectory = driftAndReturn();
  Mat3& turned = std::get<Rest>(trajectory.tracks[1].segments.open()[0].motion).pose.worldFromBody;
  turned = axisAngle(Vec3(0, 0, -1), 3.0);
  const std::string row = posesOf(trajectory, 5)[2];
  // cos 1.5, and -sin 1.5 about z
  EXPECT_TRUE(row.starts_with("0,anchor,0,5,0,0.07073720166770")) << row;
}

TEST(PosesCsv, refusesAStepThatIsNotPositive) {
  const TextSink nowhere = [](std::string_view) {};
  for (const double every :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(writePosesCsv(driftAndReturn(), every, nowhere), InputError) << every;
  }
}

TEST(ImpactsCsv, namesWhatWasStruck) {
  Trajectory trajectory = driftAndReturn();
  Impact other = trajectory.impacts[0];
  other.time = 0.75;
  other.b = Partner::ofBody(1);
  trajectory.impacts.push_back(other);
  std::string text;
  writeImpactsCsv(trajectory, [&text](std::string_view piece) { text += piece; });
  EXPECT_EQ(text,
            "time,a,b,x,y,z,nx,ny,nz,approach,impulse,tangential\n"
            "0.5,drifter,room+x,2.1000000000000001,0,0,-1,0,0,2,8,0\n"
            "0.75,drifter,anchor,2.1000000000000001,0,0,-1,0,0,2,8,0\n");
}

}  // namespace
}  // namespace careen
