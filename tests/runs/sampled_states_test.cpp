#include "runs/sampled_states.h"

#include <gtest/gtest.h>

#include <vector>

#include "physics/simulate.h"
#include "physics/world/method.h"
#include "support/exact_runs.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

TEST(SampledStates, areThoseOfTheWholeTrajectory) {
  World world = elasticRoom();
  world.bodies.push_back(
      box("anchor", Vec3(0.1, 0.1, 0.1), 1, Vec3(-2.5, -1.5, 0.2)));  // a second box, to tell them apart
  world.bodies[1].mass = immovable();
  const std::vector<double> times = {0, 0.25, 1, 2.5, 3};
  for (const Method method : {Method::kExact, Method::kTaylor8}) {
    const RunSettings settings{.method = method, .duration = 3, .dt = 1.0 / 60};
    SampledStates sampled(world, times);
    simulate(world, settings, sampled);
    const std::vector<std::vector<BodyState>> states = sampled.finish();
    const Trajectory trajectory = record(world, settings, "");
    ASSERT_EQ(states.size(), times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
      for (std::size_t body = 0; body < 2; ++body) {
        const BodyState expected = trajectory.state(body, times[k]);
        EXPECT_EQ(states[k][body].pose.position, expected.pose.position);
        EXPECT_EQ(states[k][body].pose.worldFromBody, expected.pose.worldFromBody);
        EXPECT_EQ(states[k][body].velocity, expected.velocity);
        EXPECT_EQ(states[k][body].angularMomentum, expected.angularMomentum);
      }
    }
  }
}

}  // namespace
}  // namespace careen
