#include "trajectory/motor_work.h"

#include <gtest/gtest.h>

#include <array>

#include "support/jointed.h"

namespace careen {
namespace {

// A slide that moves at 2 m/s, pushed by 3 N from 0.5 s on and by −1 N from 1 s on.
TEST(MotorWork, isEffortTimesWay) {
  Trajectory run;
  run.settings.duration = 2;
  run.world.bodies = {box("slide", Vec3::Constant(0.1), 1, Vec3::Zero(), Vec3(2, 0, 0))};
  test::join(run.world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  Flight flight;
  flight.velocity = Vec3(2, 0, 0);
  run.tracks = {{.segments = {{.start = 0, .motion = flight}}}};
  run.jointEfforts = {{.time = 0.5, .joint = 0, .effort = 3}, {.time = 1, .joint = 0, .effort = -1}};
  const std::array<std::size_t, 1> joints{0};
  MotorWork work(run, joints);
  EXPECT_NEAR(work.until(0.25), 0, 1e-15);
  EXPECT_NEAR(work.until(0.75), 3 * 2 * 0.25, 1e-15);
  EXPECT_NEAR(work.until(1.5), 3 * 2 * 0.25 - 1 * 2 * 0.5, 1e-15);
  EXPECT_NEAR(MotorWork(run, {}).until(2), 0, 0);
}

// The same slide with a drive forwards of at most 5 N, which gives no more, until it lets go after 1 s.
TEST(MotorWork, ofADriveIsAtMostItsLargestEffortTimesWay) {
  Trajectory run;
  run.settings.duration = 2;
  run.world.bodies = {box("slide", Vec3::Constant(0.1), 1, Vec3::Zero(), Vec3(2, 0, 0))};
  Joint& rail = test::join(run.world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  rail.grip = 5;
  rail.until = 1;
  Flight flight;
  flight.velocity = Vec3(2, 0, 0);
  run.tracks = {{.segments = {{.start = 0, .motion = flight}}}};
  const std::array<std::size_t, 1> joints{0};
  EXPECT_EQ(MotorWork(run, joints).until(2), 0);  // dry friction gives none
  for (const double speed : {3.0, -3.0}) {
    run.world.joints[0].keptRate = speed;
    MotorWork work(run, joints);
    const double effort = speed > 0 ? 5 : -5;
    EXPECT_NEAR(work.until(0.75), effort * 1.5, 1e-14);
    EXPECT_NEAR(work.until(1.5), effort * 0.5, 1e-14);
    EXPECT_EQ(work.until(2), 0);
  }
}

// A wheel that turns by 2.5 rad in each of its four segments, under 2 N m: work of all ten radians.
TEST(MotorWork, countsTurnsByTheSegments) {
  Trajectory run;
  run.settings.duration = 4;
  run.world.bodies = {box("wheel", Vec3::Constant(0.1), 1, Vec3::Zero())};
  test::join(run.world, Joint::Kind::kHinge, 0, {}, Vec3::Zero());
  for (int k = 0; k < 4; ++k) {
    SampledStep step{.duration = 1, .start = {}, .end = {}};
    const auto turned = [](double angle) {
      BodyState state;
      state.pose.worldFromBody = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
      state.angularMomentum = Vec3(0, 0, 2.5 / 150);  // I = 1/150 kg m²
      return state;
    };
    step.start = turned(2.5 * k);
    step.end = turned(2.5 * (k + 1));
    run.tracks.resize(1);
    run.tracks[0].segments.add({.start = static_cast<double>(k), .motion = step});
  }
  run.jointEfforts = {{.time = 0, .joint = 0, .effort = 2}};
  const std::array<std::size_t, 1> joints{0};
  EXPECT_NEAR(MotorWork(run, joints).until(4), 20, 1e-9);
}

}  // namespace
}  // namespace careen
