// The legend of the arrows, and where panels have room.
#include "render/overlay/panels.h"

#include <algorithm>
#include <cmath>

#include "core/brief.h"

namespace careen {
namespace {

// Overlays with arrows, in the order of the legend.
std::vector<ShownOverlay> rowsOf(std::span<const ShownOverlay> shown) {
  std::vector<ShownOverlay> rows;
  std::copy_if(shown.begin(), shown.end(), std::back_inserter(rows),
               [](const ShownOverlay& each) { return each.kind->legend && each.largest > 0; });
  std::sort(rows.begin(), rows.end(), [](const ShownOverlay& a, const ShownOverlay& b) {
    return a.kind->legend->row < b.kind->legend->row;
  });
  return rows;
}

// The meaning of the arrows of `shown`, with an arrow of a round value as scale.
void addLegend(OverlayShapes& shapes, const OverlayFrame& frame, std::span<const ShownOverlay> shown) {
  const std::vector<ShownOverlay> rows = rowsOf(shown);
  if (rows.empty()) {
    return;
  }
  const double em = frame.style.text;
  std::vector<std::string> texts;
  double widest = 0;
  for (const ShownOverlay& each : rows) {
    const ArrowMeaning& arrow = *each.kind->legend;
    texts.push_back(std::string(arrow.name) + "  " + brief(roundValue(each.largest), 6) + " " + arrow.unit);
    widest = std::max(widest, frame.fonts->plain.width(texts.back(), em));
  }
  const double arrows = 0.6 * frame.style.longestArrow;
  const double margin = std::round(kPanelMargin * em);
  const Vec2 size(arrows + widest + (2 * kPanelPadding + 0.8) * em,
                  (kPanelRow * static_cast<double>(texts.size()) + 0.5) * em);
  const double left = frame.screen.width() - margin - size.x();
  const Plate plate = plateFor(frame.style, Vec2(left, margin), Vec2(left, margin) + size);
  shapes.emplace_back(plate);
  double top = plate.min.y() + 0.25 * em;
  const double start = plate.min.x() + std::round(kPanelPadding * em);
  for (std::size_t i = 0; i < texts.size(); ++i, top += kPanelRow * em) {
    const ShownOverlay& each = rows[i];
    const double length = frame.style.longestArrow * roundValue(each.largest) / each.largest;
    const Vec2 tip(start + arrows, std::round(top + 0.5 * kPanelRow * em) + 0.5);
    shapes.emplace_back(Stroke{.from = tip - Vec2(length, 0),
                               .to = tip,
                               .width = frame.style.line,
                               .head = std::min(frame.style.head, length),
                               .ink = {each.kind->legend->color, 1}});
    shapes.emplace_back(panelText(frame, texts[i], Vec2(start + arrows + 0.8 * em, rowBaseline(frame, top))));
  }
}

// Where panels are, and what more has room: on the picture, clear of the others, within the share of all of
// them.
class PanelRoom {
 public:
  explicit PanelRoom(const Screen& screen) : size_(screen.width(), screen.height()) {}
  bool takes(const Plate& panel) {
    const double covered = covered_ + (panel.max - panel.min).prod();
    const bool isClear = std::none_of(taken_.begin(), taken_.end(), [&](const Plate& other) {
      return (panel.min.array() < other.max.array()).all() && (other.min.array() < panel.max.array()).all();
    });
    if (panel.min.minCoeff() < 0 || (panel.max.array() > size_.array()).any() || !isClear ||
        covered > kPanelsShare * size_.prod()) {
      return false;
    }
    covered_ = covered;
    taken_.push_back(panel);
    return true;
  }

 private:
  Vec2 size_;
  double covered_ = 0;  // [px²]
  std::vector<Plate> taken_;
};

}  // namespace

double rowBaseline(const OverlayFrame& frame, double top) {
  const double em = frame.style.text;
  return std::round(top + 0.5 * (kPanelRow * em + frame.fonts->plain.capitalHeight(em)));
}

Label panelText(const OverlayFrame& frame, const std::string& text, const Vec2& at) {
  return {.text = text, .at = at, .size = frame.style.text, .ink = {kIvory, 1}};
}

void addNote(OverlayShapes& shapes, const OverlayFrame& frame, const std::string& text, PanelCorner corner,
             Typeface typeface) {
  const double em = frame.style.text;
  const Font& font = typeface == Typeface::kMonospaced ? frame.fonts->monospaced : frame.fonts->plain;
  const double margin = std::round(kPanelMargin * em);
  const Vec2 size(font.width(text, em) + 2 * kPanelPadding * em, (kPanelRow + 0.5) * em);
  const Vec2 last(frame.screen.width() - margin, frame.screen.height() - margin);
  const Vec2 min = corner == PanelCorner::kUpperLeft ? Vec2::Constant(margin) : Vec2(last - size);
  const Plate plate = plateFor(frame.style, min, corner == PanelCorner::kUpperLeft ? min + size : last);
  shapes.emplace_back(plate);
  const double baseline = 0.5 * (plate.min.y() + plate.max.y() + font.capitalHeight(em));
  shapes.emplace_back(Label{.text = text,
                            .at = Vec2(plate.min.x() + std::round(kPanelPadding * em), std::round(baseline)),
                            .size = em,
                            .typeface = typeface,
                            .ink = {kIvory, 1}});
}

double roundValue(double largest) {
  const double power = std::pow(10.0, std::floor(std::log10(0.6 * largest)));
  const double times = 0.6 * largest / power;
  return (times >= 5 ? 5 : (times >= 2 ? 2 : 1)) * power;
}

void addPanels(OverlayShapes& shapes, const OverlayFrame& frame, std::span<const ShownOverlay> shown) {
  PanelRoom room(frame.screen);
  const auto addIfRoom = [&](const auto& add) {
    OverlayShapes panel;
    add(panel);
    if (!panel.empty() && room.takes(std::get<Plate>(panel.front()))) {
      shapes.insert(shapes.end(), panel.begin(), panel.end());
    }
  };
  for (const ShownOverlay& each : shown) {
    if (each.kind->layer == OverlayLayer::kPanels) {
      addIfRoom([&](OverlayShapes& panel) { each.kind->add(panel, frame, each); });
    }
  }
  addIfRoom([&](OverlayShapes& panel) { addLegend(panel, frame, shown); });
  if (frame.ghost != nullptr) {
    addIfRoom([&](OverlayShapes& panel) { addGhostPanel(panel, frame); });
  }
}

}  // namespace careen
