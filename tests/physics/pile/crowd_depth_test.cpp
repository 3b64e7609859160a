// How deep the members of a crowd go into each other.
#include <gtest/gtest.h>

#include <algorithm>

#include "physics/pile/crowd.h"
#include "support/crowd_run.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

// [m] At the ends of frames.
double deepestOf(test::CrowdRun& crowd, int frames) {
  double deepest = 0;
  for (int frame = 0; frame < frames; ++frame) {
    crowd.step();
    deepest = std::max(deepest, crowd.deepest());
    for (const BodyState& state : crowd.states()) {
      EXPECT_LT(state.pose.position.norm(), 100) << frame;
    }
  }
  return deepest;
}

TEST(CrowdDepth, overlapStaysSmallAtEveryFrameOfPouring) {
  const World world = test::pouring(60, 0.5, 0, 1, 3);
  test::CrowdRun crowd(world);
  const double deepest = deepestOf(crowd, 360);
  EXPECT_LT(deepest, 1e-3);
  EXPECT_LT(crowd.deepest(), 3e-4);
  EXPECT_GT(deepest, 0);
}

}  // namespace
}  // namespace careen
