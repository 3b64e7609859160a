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

// Slippery boxes, 74 layers of them, wedge each other in a shaft under their weight: the crowd that
// took 8 passes of projection at most, and as many sweeps in every step, let them go 21 mm deep.
TEST(CrowdDepth, jamInADeepShaftStaysShallow) {
  const World world = test::pouring(295, 0.1, 0, 1, 2);
  test::CrowdRun crowd(world);
  EXPECT_LT(deepestOf(crowd, 240), 3 * Crowd::kUsualTolerance);  // measured 6.6e-4
}

}  // namespace
}  // namespace careen
