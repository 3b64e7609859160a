#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/font.h"
#include "render/film/filming.h"
#include "render/overlay/shapes.h"

namespace careen {

/// What a plot below a film shows of its runs.
enum class PlotQuantity {
  kEnergy,    ///< [J] of all boxes, potential energy as in the overlay
  kSpeed,     ///< [m/s] of the fastest box's centre
  kDistance,  ///< [m] of a box's centre from where it is in the first run, the largest
};
inline constexpr std::array<std::string_view, 3> kPlotQuantities = {"energy", "speed", "distance"};

inline std::string_view nameOf(PlotQuantity quantity) {
  return kPlotQuantities.at(static_cast<std::size_t>(quantity));
}

/// A plot below a film, which grows with it: a curve for each run, up to the moment that is shown.
class FilmPlot {
 public:
  struct Shown {
    const Trajectory* run;
    const Filming* filming;
    std::string name;
  };
  /// Asks the runs once for all of the film, for `duration` [s] of it. Size in pixels. MachineError if
  /// there is no font. Distances are those of the second run and further ones.
  FilmPlot(PlotQuantity quantity, std::span<const Shown> runs, double duration, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// At a moment of the film [s].
  OverlayShapes shapesAt(double filmTime) const;

 private:
  struct Curve {
    std::string name;
    Color color;
    double end;                  // [s] of the film
    std::vector<double> values;  // evenly over the film
  };
  Vec2 place(double filmTime, double value) const;
  void addAxes(OverlayShapes& shapes) const;
  void addCurve(OverlayShapes& shapes, const Curve& curve, double filmTime) const;

  std::string title_;
  std::string unit_;
  double duration_;
  int width_;
  int height_;
  double text_;  // [px]
  double most_ = 0;
  Font font_;
  std::vector<Curve> curves_;
};

/// [px] Of the plot below pictures of this height: even.
int plotHeight(int pictureHeight);

}  // namespace careen
