// Panels at the picture's edges: time, energy, and the legend of the arrows.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render/overlay/frame.h"

namespace careen {
namespace {

// In em squares.
constexpr double kMargin = 0.9;
constexpr double kPadding = 0.7;
constexpr double kRow = 1.45;
constexpr double kBarWidth = 15;
constexpr double kBarHeight = 0.85;

double rowBaseline(const OverlayFrame& frame, double top) {
  const double em = frame.style.text;
  return std::round(top + 0.5 * (kRow * em + frame.fonts->plain.capitalHeight(em)));
}

Label write(const OverlayFrame& frame, const std::string& text, const Vec2& at, double alpha = 1) {
  return {.text = text, .at = at, .size = frame.style.text, .ink = {kIvory, alpha}};
}

Label writeUpTo(const OverlayFrame& frame, const std::string& text, const Vec2& end) {
  return write(frame, text, end - Vec2(frame.fonts->plain.width(text, frame.style.text), 0));
}

std::string formatted(const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

// Formats energies with the unit and decimals that suit the largest: four digits of it, kJ above 1000 J.
class EnergyText {
 public:
  explicit EnergyText(double largest) {
    constexpr std::array<const char*, 9> kPrefixes = {"p", "n", "µ", "m", "", "k", "M", "G", "T"};
    const int thousands =
        largest > 0 ? static_cast<int>(std::clamp(std::floor(std::log10(largest) / 3), -4.0, 4.0)) : 0;
    unit_ = std::pow(10.0, 3 * thousands);
    const double inUnit = largest / unit_;
    digits_ = inUnit >= 100 ? 1 : (inUnit >= 10 ? 2 : 3);
    name_ = std::string(" ") + *(kPrefixes.begin() + 4 + thousands) + "J";
  }
  std::string operator()(double energy) const {
    std::array<char, 64> text{};
    const double steps = std::pow(10.0, digits_);
    const double rounded = std::round(energy / unit_ * steps) / steps + 0.0;  // + 0.0 turns −0 into 0
    std::snprintf(text.data(), text.size(), "%.*f", digits_, rounded);
    return text.data() + name_;
  }

 private:
  double unit_ = 1;
  int digits_ = 0;
  std::string name_;
};

struct Share {
  const char* name;
  double energy;  // [J]
  Color color;
  bool hatched = false;
};

std::vector<Share> sharesOf(const OverlayFrame& frame, const EnergyShares& shares) {
  std::vector<Share> list = {{"kinetic", shares.translation, kTeal},
                             {"rotation", shares.rotation, kViolet},
                             {"potential", shares.potential, kSand}};
  if (frame.energy->hasSprings()) {
    list.push_back({"springs", shares.springs, kRose});
  }
  return list;
}

Plate filled(const OverlayFrame& frame, const Vec2& min, const Vec2& max, const Share& share) {
  return {.min = min,
          .max = max,
          .hatching = share.hatched ? 0.36 * frame.style.text : 0,
          .ink = {share.color, share.hatched ? 0.9 : 1}};
}

// Shares end to end. Each is drawn from the bar's start, last one first, to avoid seams between them.
void addBar(OverlayShapes& shapes, const OverlayFrame& frame, const Vec2& min, const Vec2& size,
            const std::vector<Share>& shares) {
  const double perJoule = size.x() / frame.energy->largest();
  double end = 0;
  std::vector<double> ends;
  for (const Share& share : shares) {
    end += std::max(0.0, share.energy);
    ends.push_back(std::min(size.x(), end * perJoule));
  }
  for (std::size_t i = shares.size(); i-- > 0;) {
    shapes.emplace_back(filled(frame, min, min + Vec2(ends[i], size.y()), shares[i]));
  }
  // Mark for the energy at the start.
  const double mark = frame.energy->atStart() * perJoule;
  const double reach = 0.18 * frame.style.text;
  shapes.emplace_back(Stroke{.from = min + Vec2(mark, -reach),
                             .to = min + Vec2(mark, size.y() + reach),
                             .width = 0.6 * frame.style.line,
                             .ink = {kIvory, 1}});
}

struct ArrowMeaning {
  Overlay overlay;
  const char* name;
  const char* unit;
  double largest;
  Color color;
};

std::vector<ArrowMeaning> meaningsOf(const OverlayFrame& frame, const OverlaySet& shown) {
  std::vector<ArrowMeaning> meanings = {
      {Overlay::kVelocity, "velocity", "m/s", frame.scales.speed, kTeal},
      {Overlay::kAngularMomentum, "angular momentum", "kg m²/s", frame.scales.angularMomentum, kViolet},
      {Overlay::kSpinAxis, "spin", "rad/s", frame.scales.angularSpeed, kMoss},
      {Overlay::kImpulses, "impulse", "N s", frame.scales.impulse, kAmber}};
  std::erase_if(meanings,
                [&](const ArrowMeaning& each) { return !shown.has(each.overlay) || !(each.largest > 0); });
  return meanings;
}

void addTimeCode(OverlayShapes& shapes, const OverlayFrame& frame) {
  const double em = frame.style.text;
  const std::string text = timeCode(frame.time);
  const Font& font = frame.fonts->monospaced;
  const Vec2 min = Vec2::Constant(std::round(kMargin * em));
  const Vec2 size(font.width(text, em) + 2 * kPadding * em, (kRow + 0.5) * em);
  const Plate plate = plateFor(frame.style, min, min + size);
  shapes.emplace_back(plate);
  const double baseline = 0.5 * (plate.min.y() + plate.max.y() + font.capitalHeight(em));
  shapes.emplace_back(Label{.text = text,
                            .at = Vec2(min.x() + std::round(kPadding * em), std::round(baseline)),
                            .size = em,
                            .typeface = Typeface::kMonospaced,
                            .ink = {kIvory, 1}});
}

void addEnergy(OverlayShapes& shapes, const OverlayFrame& frame) {
  if (!(frame.energy->atStart() > 0 && std::isfinite(frame.energy->largest()))) {
    return;  // no finite, positive energy to show
  }
  const double em = frame.style.text;
  const EnergyShares energy = frame.energy->sharesOf(frame.states);
  std::vector<Share> shares = sharesOf(frame, energy);
  const double rows = static_cast<double>(shares.size()) + 2;
  const Vec2 size((kBarWidth + 2 * kPadding) * em, (rows * kRow + 2 * kPadding + kBarHeight + 0.2) * em);
  const double margin = std::round(kMargin * em);
  const Plate plate = plateFor(frame.style, Vec2(margin, frame.screen.height() - margin - size.y()),
                               Vec2(margin + size.x(), frame.screen.height() - margin));
  shapes.emplace_back(plate);

  const Vec2 min = plate.min + Vec2::Constant(std::round(kPadding * em));
  const double right = plate.max.x() - std::round(kPadding * em);
  const EnergyText text(frame.energy->largest());
  double top = min.y() + (kBarHeight + 0.4) * em;
  const auto addRow = [&](const char* name, double joules) {
    const double baseline = rowBaseline(frame, top);
    shapes.emplace_back(write(frame, name, Vec2(min.x() + 1.1 * em, baseline)));
    shapes.emplace_back(writeUpTo(frame, text(joules), Vec2(right, baseline)));
    top += kRow * em;
  };
  const auto addShare = [&](const Share& share) {
    const Vec2 chip(min.x(), std::round(top + 0.42 * em));
    shapes.emplace_back(filled(frame, chip, chip + Vec2::Constant(std::round(0.62 * em)), share));
    addRow(share.name, share.energy);
  };

  const double lost = frame.energy->atStart() - energy.sum();
  const Share rest = {"lost", lost, kGrey, true};
  shares.push_back(rest);
  addBar(shapes, frame, min, Vec2(right - min.x(), std::round(kBarHeight * em)), shares);
  shares.pop_back();
  for (const Share& share : shares) {
    addShare(share);
  }
  shapes.emplace_back(Stroke{.from = Vec2(min.x(), std::round(top) + 0.5),
                             .to = Vec2(right, std::round(top) + 0.5),
                             .width = 0.4 * frame.style.line,
                             .ink = {kIvory, 0.5}});
  addRow("sum", energy.sum());
  if (text(lost).starts_with("-")) {
    addRow("gained", -lost);  // by numerical errors
  } else {
    addShare(rest);
  }
}

// The meaning of the arrows of `shown`, with an arrow of a round value as scale.
void addLegend(OverlayShapes& shapes, const OverlayFrame& frame, const OverlaySet& shown) {
  const std::vector<ArrowMeaning> meanings = meaningsOf(frame, shown);
  if (meanings.empty()) {
    return;
  }
  const double em = frame.style.text;
  std::vector<std::string> texts;
  double widest = 0;
  for (const ArrowMeaning& each : meanings) {
    texts.push_back(std::string(each.name) + "  " + formatted("%g", roundValue(each.largest)) + " " +
                    each.unit);
    widest = std::max(widest, frame.fonts->plain.width(texts.back(), em));
  }
  const double arrows = 0.6 * frame.style.longestArrow;
  const double margin = std::round(kMargin * em);
  const Vec2 size(arrows + widest + (2 * kPadding + 0.8) * em,
                  (kRow * static_cast<double>(texts.size()) + 0.5) * em);
  const double left = frame.screen.width() - margin - size.x();
  const Plate plate = plateFor(frame.style, Vec2(left, margin), Vec2(left, margin) + size);
  shapes.emplace_back(plate);
  double top = plate.min.y() + 0.25 * em;
  const double start = plate.min.x() + std::round(kPadding * em);
  for (std::size_t i = 0; i < texts.size(); ++i, top += kRow * em) {
    const ArrowMeaning& each = meanings[i];
    const double length = frame.style.longestArrow * roundValue(each.largest) / each.largest;
    const Vec2 tip(start + arrows, std::round(top + 0.5 * kRow * em) + 0.5);
    shapes.emplace_back(Stroke{.from = tip - Vec2(length, 0),
                               .to = tip,
                               .width = frame.style.line,
                               .head = std::min(frame.style.head, length),
                               .ink = {each.color, 1}});
    shapes.emplace_back(write(frame, texts[i], Vec2(start + arrows + 0.8 * em, rowBaseline(frame, top))));
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

std::string timeCode(double seconds) {
  const long long milliseconds = std::llround(1000 * seconds);
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%02lld:%02lld:%02lld.%03lld", milliseconds / 3600000,
                milliseconds / 60000 % 60, milliseconds / 1000 % 60, milliseconds % 1000);
  return text.data();
}

double roundValue(double largest) {
  const double power = std::pow(10.0, std::floor(std::log10(0.6 * largest)));
  const double times = 0.6 * largest / power;
  return (times >= 5 ? 5 : (times >= 2 ? 2 : 1)) * power;
}

void addPanels(OverlayShapes& shapes, const OverlayFrame& frame, const OverlaySet& shown) {
  PanelRoom room(frame.screen);
  const auto addIf = [&](bool isShown, const auto& add) {
    OverlayShapes panel;
    if (isShown) {
      add(panel);
    }
    if (!panel.empty() && room.takes(std::get<Plate>(panel.front()))) {
      shapes.insert(shapes.end(), panel.begin(), panel.end());
    }
  };
  addIf(shown.has(Overlay::kTime), [&](OverlayShapes& panel) { addTimeCode(panel, frame); });
  addIf(shown.has(Overlay::kEnergy), [&](OverlayShapes& panel) { addEnergy(panel, frame); });
  addIf(true, [&](OverlayShapes& panel) { addLegend(panel, frame, shown); });
  addIf(frame.ghost != nullptr, [&](OverlayShapes& panel) { addGhostPanel(panel, frame); });
}

}  // namespace careen
