#include "study/own_methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "physics/world/method.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

TEST(OwnMethods, areAllMethodsUnderTheirNames) {
  const Contestants all = ownMethods();
  ASSERT_EQ(all.size(), kMethods.size() + 1);
  EXPECT_EQ(all.back()->name(), "crowd");
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    EXPECT_EQ(all[i]->name(), kMethods.at(i).name);
    EXPECT_EQ(all[i]->steps(), kMethods.at(i).steps());
  }
}

TEST(OwnMethods, refuseWhatTheyDoNotModel) {
  World two = elasticRoom();
  two.bodies.push_back(box("second", Vec3(0.1, 0.1, 0.1), 1, Vec3(2, 1, 1)));
  World springs = elasticRoom();
  springs.springs.emplace_back();
  World moved = elasticRoom();
  moved.bodies.emplace_back();
  moved.bodies.back().course = courseOf({.path = {}, .velocity = Vec3(1, 0, 0)}, {});
  for (const auto& method : ownMethods()) {
    if (method->name() == "crowd") {
      EXPECT_EQ(method->refuses(two), "asked for joints only");
      springs.joints.emplace_back();
      EXPECT_EQ(method->refuses(springs), "");
      continue;
    }
    EXPECT_EQ(method->refuses(elasticRoom()), "") << method->name();
    EXPECT_EQ(method->refuses(two), method->name() == "exact" ? "" : "no collisions between boxes")
        << method->name();
    EXPECT_EQ(method->refuses(moved), method->name() == "exact" ? "" : "no fixed boxes that move")
        << method->name();
    EXPECT_EQ(method->refuses(springs),
              method->name() == "listing1" || method->name() == "exact" ? "" : "no springs, no drag")
        << method->name();
  }
}

TEST(OwnMethods, comeToTheSameStatesWhileTheyAreFlying) {
  const World world = elasticRoom();
  const std::vector<double> times = {0.05, 0.1};
  const Contestants all = ownMethods();
  const auto truth = all[0]->run(world, 1, times, {});
  for (const auto& method : all) {
    if (method->name() == "crowd") {
      continue;
    }
    const auto states = method->run(world, 1.0 / 3840, times, {});
    ASSERT_EQ(states.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      // measured: listing1 2.3e-4 and 1.3e-4 m, strang 1e-8, the others 1.2e-14
      const bool euler = method->name() == "listing1";
      const int order = traitsOf(*methodNamed(method->name())).order;
      const double bound = euler ? 5e-4 : order == 2 ? 3e-8 : 5e-14;
      EXPECT_LT((states[k][0].pose.worldFromBody - truth[k][0].pose.worldFromBody).norm(), bound)
          << method->name();
      EXPECT_LT((states[k][0].pose.position - truth[k][0].pose.position).norm(), euler ? 5e-4 : 1e-15)
          << method->name();
    }
  }
}

}  // namespace
}  // namespace careen
