#include "render/overlay/titles.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace careen {
namespace {

constexpr double kTitleSize = 1.6;     // of the panels' text
constexpr double kTitleRow = 1.35;     // em squares from line to line
constexpr double kTitlePadding = 0.6;  // em squares
constexpr double kTitleMargin = 0.07;  // of the picture's height

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines = {""};
  for (const char each : text) {
    if (each == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += each;
    }
  }
  return lines;
}

double strengthOf(const Title& title, double filmTime) {
  const double fade = std::min(kTitleFade, 0.25 * (title.to - title.from));
  return std::clamp(std::min(filmTime - title.from, title.to - filmTime) / fade, 0.0, 1.0);
}

/// A title, as it is written at a moment.
struct WrittenTitle {
  WrittenTitle(const OverlayFrame& frame, const Title& title, double filmTime)
      : lines(linesOf(title.text)), alpha(strengthOf(title, filmTime)), size(kTitleSize * frame.style.text) {
    for (const std::string& line : lines) {
      width = std::max(width, frame.fonts->plain.width(line, size) + 2 * kTitlePadding * size);
    }
    const double fits = std::min(1.0, frame.screen.width() / width);  // too long a line is written smaller
    size *= fits;
    width *= fits;
  }

  double height() const { return kTitleRow * size * static_cast<double>(lines.size()); }

  std::vector<std::string> lines;
  double alpha;
  double size;       // [px] of the em square
  double width = 1;  // [px]
};

double topOf(TitlePlace place, double height, double all) {
  const double margin = std::round(kTitleMargin * height);
  switch (place) {
    case TitlePlace::kTop:
      return margin;
    case TitlePlace::kMiddle:
      return 0.5 * (height - all);
    case TitlePlace::kBottom:
      break;
  }
  return height - margin - all;
}

void addTitle(OverlayShapes& shapes, const OverlayFrame& frame, const WrittenTitle& title, double top) {
  const Vec2 middle(0.5 * frame.screen.width(), top + 0.5 * title.height());
  const Vec2 half = 0.5 * Vec2(title.width, title.height());
  Plate plate = plateFor(frame.style, middle - half, middle + half);
  plate.ink.alpha *= title.alpha;
  shapes.emplace_back(plate);
  double baseline = top + 0.5 * (kTitleRow * title.size + frame.fonts->plain.capitalHeight(title.size));
  for (const std::string& line : title.lines) {
    const double left = middle.x() - 0.5 * frame.fonts->plain.width(line, title.size);
    shapes.emplace_back(Label{.text = line,
                              .at = Vec2(std::round(left), std::round(baseline)),
                              .size = title.size,
                              .ink = {kIvory, title.alpha}});
    baseline += kTitleRow * title.size;
  }
}

}  // namespace

void addTitles(OverlayShapes& shapes, const OverlayFrame& frame, std::span<const Title> titles,
               double filmTime) {
  for (const TitlePlace place : {TitlePlace::kTop, TitlePlace::kMiddle, TitlePlace::kBottom}) {
    std::vector<WrittenTitle> written;
    double all = 0;
    for (const Title& title : titles) {
      if (title.place == place && filmTime > title.from && filmTime < title.to) {
        all += written.emplace_back(frame, title, filmTime).height();
      }
    }
    double top = std::round(topOf(place, frame.screen.height(), all));
    for (const WrittenTitle& title : written) {
      addTitle(shapes, frame, title, top);
      top += title.height();
    }
  }
}

}  // namespace careen
