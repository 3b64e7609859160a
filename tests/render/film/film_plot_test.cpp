#include "render/film/film_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/stage.h"

namespace careen {
namespace {

constexpr int kPlotWide = 400;
constexpr int kPlotHigh = 120;

class FilmPlotTest : public testing::Test {
 protected:
  Trajectory run(const Vec3& velocity, double duration = 1) const {
    Trajectory run = drifting(scene_, velocity);
    run.settings.duration = duration;
    return run;
  }
  static std::vector<Ribbon> curvesOf(const OverlayShapes& shapes) {
    std::vector<Ribbon> curves;
    for (const OverlayShape& shape : shapes) {
      if (const Ribbon* const ribbon = std::get_if<Ribbon>(&shape)) {
        curves.push_back(*ribbon);
      }
    }
    return curves;
  }
  // [px] Of the line of zero: the lowest.
  static double baseOf(const OverlayShapes& shapes) {
    double base = 0;
    for (const OverlayShape& shape : shapes) {
      const Stroke* const stroke = std::get_if<Stroke>(&shape);
      if (stroke != nullptr && stroke->from.y() == stroke->to.y() && stroke->from.x() != stroke->to.x()) {
        base = std::max(base, stroke->from.y());
      }
    }
    return base;
  }

  Scene scene_ = crateInRoom();
};

// Two boxes that part at 2 m/s: their distance is a straight line through the origin.
TEST_F(FilmPlotTest, distanceOfTwoRunsGrowsAsTheyPart) {
  const Trajectory first = run(Vec3(1, 0, 0));
  const Trajectory other = run(Vec3(-1, 0, 0));
  const Filming one(first);
  const Filming two(other);
  const std::vector<FilmPlot::Shown> runs = {{&first, &one, "one"}, {&other, &two, "two"}};
  const FilmPlot plot(PlotQuantity::kDistance, runs, 1, kPlotWide, kPlotHigh);
  const std::vector<Ribbon> half = curvesOf(plot.shapesAt(0.5));
  const std::vector<Ribbon> whole = curvesOf(plot.shapesAt(1));
  ASSERT_EQ(half.size(), 1U) << "the first is no distance from itself";
  const Vec2 start = whole[0].points.front().at;
  const Vec2 end = whole[0].points.back().at;
  EXPECT_NEAR(half[0].points.back().at.x(), 0.5 * (start.x() + end.x()), 1e-9);
  EXPECT_NEAR(half[0].points.back().at.y(), 0.5 * (start.y() + end.y()), 1e-9);
  for (const RibbonPoint& point : whole[0].points) {
    const double part = (point.at.x() - start.x()) / (end.x() - start.x());
    EXPECT_NEAR(point.at.y(), start.y() + part * (end.y() - start.y()), 1e-9);
  }
  EXPECT_NEAR(start.y(), baseOf(plot.shapesAt(1)), 0.51);
  EXPECT_GT(start.y() - end.y(), 40) << "of the plot's height";
}

TEST_F(FilmPlotTest, speedsStandInProportion) {
  const Trajectory first = run(Vec3(0, 3, 4));
  const Trajectory other = run(Vec3(2, 0, 0));
  const Filming one(first);
  const Filming two(other);
  const std::vector<FilmPlot::Shown> runs = {{&first, &one, "one"}, {&other, &two, "two"}};
  const FilmPlot plot(PlotQuantity::kSpeed, runs, 1, kPlotWide, kPlotHigh);
  const OverlayShapes shapes = plot.shapesAt(0.7);
  const std::vector<Ribbon> curves = curvesOf(shapes);
  ASSERT_EQ(curves.size(), 2U);
  const double base = baseOf(shapes);
  EXPECT_NEAR((base - curves[1].points[0].at.y()) / (base - curves[0].points[0].at.y()), 0.4, 0.01);
}

// The energy of a drift without gravity is M v² / 2, twice as much for √2 of the speed.
TEST_F(FilmPlotTest, energiesToo) {
  scene_.gravity = Vec3::Zero();
  const Trajectory first = run(Vec3(1, 1, 0));
  const Trajectory other = run(Vec3(0, 1, 0));
  const Filming one(first);
  const Filming two(other);
  const std::vector<FilmPlot::Shown> runs = {{&first, &one, "one"}, {&other, &two, "two"}};
  const OverlayShapes shapes = FilmPlot(PlotQuantity::kEnergy, runs, 1, kPlotWide, kPlotHigh).shapesAt(1);
  const std::vector<Ribbon> curves = curvesOf(shapes);
  ASSERT_EQ(curves.size(), 2U);
  const double base = baseOf(shapes);
  EXPECT_NEAR((base - curves[1].points[0].at.y()) / (base - curves[0].points[0].at.y()), 0.5, 0.01);
}

TEST_F(FilmPlotTest, aCurveEndsWithItsRun) {
  const Trajectory first = run(Vec3(1, 0, 0));
  const Trajectory other = run(Vec3(1, 0, 0), 0.25);
  const Filming one(first);
  const Filming two(other);
  const std::vector<FilmPlot::Shown> runs = {{&first, &one, "one"}, {&other, &two, "two"}};
  const std::vector<Ribbon> curves =
      curvesOf(FilmPlot(PlotQuantity::kSpeed, runs, 1, kPlotWide, kPlotHigh).shapesAt(1));
  const double start = curves[0].points.front().at.x();
  const double breadth = curves[0].points.back().at.x() - start;
  EXPECT_NEAR(curves[1].points.back().at.x() - start, 0.25 * breadth, 1e-9);
}

// A run that gains energy without end would press all others onto the line of zero.
TEST_F(FilmPlotTest, aRunThatLeavesTheOthersLeavesThePlot) {
  const Trajectory first = run(Vec3(1, 0, 0));
  const Trajectory other = run(Vec3(1000, 0, 0));
  const Filming one(first);
  const Filming two(other);
  const std::vector<FilmPlot::Shown> runs = {{&first, &one, "one"}, {&other, &two, "two"}};
  const OverlayShapes shapes = FilmPlot(PlotQuantity::kSpeed, runs, 1, kPlotWide, kPlotHigh).shapesAt(1);
  const std::vector<Ribbon> curves = curvesOf(shapes);
  EXPECT_GT(baseOf(shapes) - curves[0].points[0].at.y(), 15);
}

TEST(FilmPlot, hasAnEvenHeight) {
  for (const int height : {36, 180, 360, 719, 720, 1081}) {
    EXPECT_EQ(plotHeight(height) % 2, 0) << height;
    EXPECT_NEAR(plotHeight(height), 0.3 * height, 1.01) << height;
  }
}

}  // namespace
}  // namespace careen
