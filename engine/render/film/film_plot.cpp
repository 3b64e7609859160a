#include "render/film/film_plot.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/brief.h"
#include "core/error.h"
#include "render/overlay/energy_shares.h"
#include "render/overlay/frame.h"
#include "render/overlay/style.h"

namespace careen {
namespace {

constexpr double kShare = 0.3;  // of a picture's height
constexpr double kBeyond = 3;   // a curve that leaves the others so far behind leaves the plot
constexpr int kMostSamples = 1000;
constexpr std::array<Color, 4> kCurveColors = {kTeal, kAmber, kViolet, kMoss};

// In em squares.
constexpr double kSide = 1.2;
constexpr double kAbove = 2.2;
constexpr double kBelow = 1.9;

double fastest(const std::vector<BodyState>& states) {
  double speed = 0;
  for (const BodyState& state : states) {
    speed = std::max(speed, state.velocity.norm());
  }
  return speed;
}

double farthest(const FilmPlot::Shown& run, const std::vector<BodyState>& states,
                const FilmPlot::Shown& first, const std::vector<BodyState>& there) {
  double distance = 0;
  const std::vector<Body>& bodies = first.run->world.bodies;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto same = std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) {
      return body.name == run.run->world.bodies[k].name;
    });
    if (same != bodies.end()) {
      const auto at = static_cast<std::size_t>(same - bodies.begin());
      distance = std::max(distance, (states[k].pose.position - there[at].pose.position).norm());
    }
  }
  return distance;
}

}  // namespace

int plotHeight(int pictureHeight) { return 2 * static_cast<int>(std::lround(0.5 * kShare * pictureHeight)); }

FilmPlot::FilmPlot(PlotQuantity quantity, std::span<const Shown> runs, double duration, int width, int height)
    : title_(nameOf(quantity)),
      unit_(quantity == PlotQuantity::kEnergy  ? "J"
            : quantity == PlotQuantity::kSpeed ? "m/s"
                                               : "m"),
      duration_(duration),
      width_(width),
      height_(height),
      text_(OverlayStyle(static_cast<int>(height / kShare)).text),
      font_(findFont(kPlainFont)) {
  const bool isDistance = quantity == PlotQuantity::kDistance;
  const int samples = std::clamp(width, 2, kMostSamples);
  double least = std::numeric_limits<double>::infinity();
  for (const Shown& shown : runs.subspan(isDistance ? 1 : 0)) {
    Curve& curve = curves_.emplace_back(
        Curve{.name = shown.name,
              .color = kCurveColors.at(static_cast<std::size_t>(&shown - runs.data()) % kCurveColors.size()),
              .end = shown.filming->duration(),
              .values = {}});
    std::optional<EnergyBook> energy;
    if (quantity == PlotQuantity::kEnergy) {
      energy.emplace(*shown.run);
    }
    for (int k = 0; k < samples; ++k) {
      const double filmTime = duration * k / (samples - 1);
      const double time = shown.filming->sceneTime(filmTime);
      const std::vector<BodyState> states = shown.run->states(time);
      const Shown& first = runs.front();
      curve.values.push_back(
          energy       ? energy->sharesOf(states, time).sum()
          : isDistance ? farthest(shown, states, first, first.run->states(first.filming->sceneTime(filmTime)))
                       : fastest(states));
    }
    const double most = *std::max_element(curve.values.begin(), curve.values.end());
    most_ = std::max(most_, most);
    least = std::min(least, most);
  }
  most_ = std::min(most_, kBeyond * least);
  if (!(most_ > 0 && std::isfinite(most_))) {
    most_ = 1;
  }
}

Vec2 FilmPlot::place(double filmTime, double value) const {
  const double left = kSide * text_;
  const double top = kAbove * text_;
  const double bottom = height_ - kBelow * text_;
  const double part = duration_ > 0 ? filmTime / duration_ : 0;
  return {left + part * (width_ - 2 * left), bottom - value / most_ * (bottom - top)};
}

void FilmPlot::addAxes(OverlayShapes& shapes) const {
  shapes.emplace_back(Plate{.min = Vec2(-2, -2), .max = Vec2(width_ + 2, height_ + 2), .ink = {kSlate, 1}});
  const auto write = [&](const std::string& text, const Vec2& at, const Color& color) {
    shapes.emplace_back(Label{
        .text = text, .at = Vec2(std::round(at.x()), std::round(at.y())), .size = text_, .ink = {color, 1}});
    return font_.width(text, text_);
  };
  const double tick = roundValue(most_);
  for (const double value : {0.0, tick}) {
    const double y = std::round(place(0, value).y()) + 0.5;
    shapes.emplace_back(Stroke{.from = Vec2(place(0, 0).x(), y),
                               .to = Vec2(place(duration_, 0).x(), y),
                               .width = 1,
                               .ink = {kGrey, value > 0 ? 0.5 : 1}});
  }
  write(brief(tick, 6) + " " + unit_, place(0, tick) + Vec2(0.3 * text_, -0.35 * text_), kGrey);
  const double step = roundValue(duration_);
  for (double time = step; step > 0 && time <= duration_ * (1 + 1e-9); time += step) {
    const Vec2 at = place(time, 0);
    shapes.emplace_back(Stroke{.from = at, .to = at + Vec2(0, 0.4 * text_), .width = 1, .ink = {kGrey, 1}});
    const std::string text = brief(time, 6) + " s";
    write(text, at + Vec2(-0.5 * font_.width(text, text_), 1.5 * text_), kGrey);
  }
  Vec2 at(kSide * text_, 1.4 * text_);
  at.x() += write(title_, at, kIvory) + 1.5 * text_;
  for (const Curve& curve : curves_) {
    at.x() += write(curve.name, at, curve.color) + 1.5 * text_;
  }
}

void FilmPlot::addCurve(OverlayShapes& shapes, const Curve& curve, double filmTime) const {
  const auto last = static_cast<double>(curve.values.size() - 1);
  const double now = std::min(filmTime, curve.end);
  const double end = std::clamp(duration_ > 0 ? now / duration_ : 0, 0.0, 1.0) * last;
  const auto whole = static_cast<std::size_t>(end);
  const auto above = [&](double value) { return std::min(value, 1.2 * most_); };
  Ribbon line{.points = {}, .width = 0.16 * text_, .ink = {curve.color, 1}};
  for (std::size_t k = 0; k <= whole; ++k) {
    line.points.push_back({.at = place(duration_ * static_cast<double>(k) / last, above(curve.values[k]))});
  }
  const double next = curve.values[std::min(whole + 1, curve.values.size() - 1)];
  const double rest = end - static_cast<double>(whole);
  const Vec2 head = place(now, above((1 - rest) * curve.values[whole] + rest * next));
  line.points.push_back({.at = head});
  shapes.emplace_back(Stroke{.from = head, .to = head, .width = 0.5 * text_, .ink = line.ink});
  shapes.emplace_back(std::move(line));
}

OverlayShapes FilmPlot::shapesAt(double filmTime) const {
  OverlayShapes shapes;
  addAxes(shapes);
  for (const Curve& curve : curves_) {
    addCurve(shapes, curve, filmTime);
  }
  return shapes;
}

}  // namespace careen
