#include "study/dice_plots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/system/scratch_folder.h"

namespace careen {
namespace {

DiceResult thrownWith(double friction, double spin, int square) {
  DiceResult result;
  result.settings.friction = friction;
  result.settings.spin = spin;
  result.settings.throws = 100;
  for (std::size_t i = 0; i < kMeasuredDice.size(); ++i) {
    result.faces.push_back({.square = square, .other = 100 - square});
  }
  return result;
}

TEST(DicePlots, areOneForEachQuantityThatVaries) {
  const std::vector<DicePlot> plots =
      dicePlots({thrownWith(0.3, 40, 50), thrownWith(0.1, 40, 20), thrownWith(0.3, 100, 80)});
  ASSERT_EQ(plots.size(), 2U);
  EXPECT_EQ(plots[0].of, "friction");
  EXPECT_EQ(plots[0].plot.texts, (std::vector<std::string>{"Cuboid dice, 100 throws of each", "measured",
                                                           "friction 0.3", "friction 0.1"}));
  EXPECT_EQ(plots[1].of, "spin");
  EXPECT_EQ(plots[1].plot.texts.back(), "spin 100 rad/s");
  const std::string& data = plots[0].plot.data;
  EXPECT_EQ(std::count(data.begin(), data.end(), '\n'), 45);
  // Wilson's band of 20 of 100, z = 1.96: (0.2 + 0.019208 ± 1.96 sqrt(0.0016 + 0.000096))/1.038416.
  EXPECT_NE(data.find("\n2\t0.47\t0.2\t0.1333"), std::string::npos) << data;
}

TEST(DicePlots, isOneOfTheUsualThrowIfNothingVaries) {
  EXPECT_TRUE(dicePlots({}).empty());
  const std::vector<DicePlot> plots = dicePlots({thrownWith(0.3, 40, 50)});
  ASSERT_EQ(plots.size(), 1U);
  EXPECT_EQ(plots[0].of, "usual");
}

TEST(DicePlots, canBeDrawn) {
  const ScratchFolder folder;
  for (const DicePlot& each : dicePlots({thrownWith(0.3, 40, 50), thrownWith(0.1, 40, 20)})) {
    const std::string svg = drawPlot(each.plot, folder.path() / each.of);
    EXPECT_NE(svg.find("friction 0.1"), std::string::npos);
    EXPECT_NE(svg.find("measured"), std::string::npos);
  }
}

}  // namespace
}  // namespace careen
