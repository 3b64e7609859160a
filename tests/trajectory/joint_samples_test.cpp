#include "trajectory/joint_samples.h"

#include <gtest/gtest.h>

#include <string>

#include "support/jointed.h"
#include "trajectory/export_csv.h"

namespace careen {
namespace {

// A slide that moves at 2 m/s, pushed by 3 N from 0.5 s on, and a ball joint, which has no coordinate.
Trajectory slide() {
  Trajectory run;
  run.settings.duration = 1;
  run.world.bodies = {box("slide", Vec3::Constant(0.1), 1, Vec3::Zero(), Vec3(2, 0, 0))};
  test::join(run.world, Joint::Kind::kBall, 0, {}, Vec3::Zero());
  test::join(run.world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX()).name = "rail";
  Flight flight;
  flight.velocity = Vec3(2, 0, 0);
  run.tracks = {{.segments = {{.start = 0, .motion = flight}}}};
  run.jointEfforts = {{.time = 0.5, .joint = 1, .effort = 3}};
  return run;
}

TEST(JointSamples, areWayRateAndEffort) {
  const Trajectory run = slide();
  JointSamples samples(run);
  ASSERT_EQ(samples.joints(), std::vector<std::size_t>{1});
  EXPECT_EQ(samples.at(0.25).at(0), (JointSamples::Row{0.5, 2, 0}));
  EXPECT_EQ(samples.at(0.5).at(0), (JointSamples::Row{1, 2, 3}));
}

TEST(JointSamples, writeATable) {
  std::string text;
  writeJointsCsv(slide(), 0.5, [&text](std::string_view piece) { text += piece; });
  EXPECT_EQ(text, "time,joint,coordinate,rate,effort\n0,rail,0,2,0\n0.5,rail,1,2,3\n1,rail,2,2,3\n");
}

// 2.5 rad/s: beyond half a turn after 1.26 s.
TEST(JointSamples, countTurnsFromRowToRow) {
  Trajectory run;
  run.settings.duration = 8;
  run.world.bodies = {box("wheel", Vec3::Constant(0.1), 1, Vec3::Zero())};
  test::join(run.world, Joint::Kind::kHinge, 0, {}, Vec3::Zero());
  for (int k = 0; k < 8; ++k) {
    const auto turned = [](double angle) {
      BodyState state;
      state.pose.worldFromBody = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
      state.angularMomentum = Vec3(0, 0, 2.5 / 150);  // I = 1/150 kg m²
      return state;
    };
    run.tracks.resize(1);
    run.tracks[0].segments.add(
        {.start = static_cast<double>(k),
         .motion = SampledStep{.duration = 1, .start = turned(2.5 * k), .end = turned(2.5 * (k + 1))}});
  }
  JointSamples samples(run);
  for (int k = 0; k <= 8; ++k) {
    const JointSamples::Row row = samples.at(k).at(0);
    EXPECT_NEAR(row[0], 2.5 * k, 1e-12);
    EXPECT_NEAR(row[1], 2.5, 1e-12);
  }
}

}  // namespace
}  // namespace careen
