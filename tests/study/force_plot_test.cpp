#include "study/force_plot.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/system/scratch_folder.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

// A box of 2 kg at 3 m/s with μ = ½ slides for 0.6 s, then lies: 20 N, and 10 N until then.
Trajectory slidingBox() {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.5;
  world.bodies = {box("box", Vec3(0.5, 0.5, 0.1), 2, Vec3(0, 0, 0.1), Vec3(3, 0, 0), Vec3::Zero(), 0)};
  world.bodies[0].material.friction = 0.5;
  return record(world, {.duration = 1}, "");
}

TEST(ForcePlot, hasALineForEachPair) {
  const Plot plot = forcePlot(slidingBox(), 0.25);
  EXPECT_EQ(plot.texts, (std::vector<std::string>{"Forces of contact", "box on floor"}));
  EXPECT_EQ(std::count(plot.data.begin(), plot.data.end(), '\n'), 5);
  EXPECT_NE(plot.data.find("1\t0.25\t20\t10\n"), std::string::npos) << plot.data;
  EXPECT_NE(plot.data.find("1\t0.75\t20\t"), std::string::npos) << plot.data;
}

TEST(ForcePlot, canBeDrawnWithAndWithoutForces) {
  const ScratchFolder folder;
  const std::string svg = drawPlot(forcePlot(slidingBox(), 0.1), folder.path() / "forces");
  EXPECT_NE(svg.find("box on floor"), std::string::npos);
  World world;
  world.bodies = {box("alone", Vec3::Constant(0.5), 1, Vec3::Zero())};
  EXPECT_FALSE(drawPlot(forcePlot(record(world, {.duration = 1}, ""), 0.1), folder.path() / "none").empty());
}

}  // namespace
}  // namespace careen
