#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render/overlay/panels.h"

namespace careen {
namespace {

// In em squares.
constexpr double kBarWidth = 15;
constexpr double kBarHeight = 0.85;

Label panelTextUpTo(const OverlayFrame& frame, const std::string& text, const Vec2& end) {
  return panelText(frame, text, end - Vec2(frame.fonts->plain.width(text, frame.style.text), 0));
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
                             {"potential", shares.gravity, kSand}};
  if (frame.energy->hasSprings()) {
    list.push_back({"springs", shares.springs + shares.jointSprings, kRose});
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

void addEnergy(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& /*shown*/) {
  if (!(frame.energy->atStart() > 0 && std::isfinite(frame.energy->largest()))) {
    return;  // no finite, positive energy to show
  }
  const double em = frame.style.text;
  const EnergyShares energy = frame.energy->sharesOf(frame.states, frame.time);
  std::vector<Share> shares = sharesOf(frame, energy);
  const double rows = static_cast<double>(shares.size()) + 2;
  const Vec2 size((kBarWidth + 2 * kPanelPadding) * em,
                  (rows * kPanelRow + 2 * kPanelPadding + kBarHeight + 0.2) * em);
  const double margin = std::round(kPanelMargin * em);
  const Plate plate = plateFor(frame.style, Vec2(margin, frame.screen.height() - margin - size.y()),
                               Vec2(margin + size.x(), frame.screen.height() - margin));
  shapes.emplace_back(plate);

  const Vec2 min = plate.min + Vec2::Constant(std::round(kPanelPadding * em));
  const double right = plate.max.x() - std::round(kPanelPadding * em);
  const EnergyText text(frame.energy->largest());
  double top = min.y() + (kBarHeight + 0.4) * em;
  const auto addRow = [&](const char* name, double joules) {
    const double baseline = rowBaseline(frame, top);
    shapes.emplace_back(panelText(frame, name, Vec2(min.x() + 1.1 * em, baseline)));
    shapes.emplace_back(panelTextUpTo(frame, text(joules), Vec2(right, baseline)));
    top += kPanelRow * em;
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

}  // namespace

constexpr OverlayKind kEnergyOverlay = {
    .shows =
        "a stacked bar of kinetic, rotational, potential (from the lowest point that each box's centre "
        "reaches) and spring energy, up to the energy at the start; the hatched part is what impacts, "
        "friction and drag dissipated",
    .layer = OverlayLayer::kPanels,
    .needs = OverlayNeeds::kEnergy,
    .add = addEnergy};

}  // namespace careen
