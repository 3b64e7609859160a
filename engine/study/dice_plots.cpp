#include "study/dice_plots.h"

#include <array>
#include <cstddef>
#include <sstream>

#include "core/brief.h"

namespace careen {
namespace {

struct Quantity {
  const char* name;
  double ThrowSettings::*value;
  const char* unit;
};
constexpr std::array<Quantity, 5> kQuantities{{{"restitution", &ThrowSettings::restitution, ""},
                                               {"friction", &ThrowSettings::friction, ""},
                                               {"height", &ThrowSettings::height, " m"},
                                               {"speed", &ThrowSettings::speed, " m/s"},
                                               {"spin", &ThrowSettings::spin, " rad/s"}}};

void addPoint(std::ostringstream& data, int series, double ratio, double part, const Band& band) {
  data << series << '\t' << inFull(ratio) << '\t' << inFull(part) << '\t' << inFull(band.low) << '\t'
       << inFull(band.high) << '\n';
}

std::string dataOf(const std::vector<const DiceResult*>& results) {
  std::ostringstream data;
  for (const MeasuredDie& die : kMeasuredDice) {
    addPoint(data, 0, die.ratio, die.square, bandOf(die.square, die.rolls));
  }
  int series = 0;
  for (const DiceResult* const result : results) {
    ++series;
    for (std::size_t i = 0; i < result->faces.size(); ++i) {
      const Faces& faces = result->faces[i];
      addPoint(data, series, kMeasuredDice.at(i).ratio, faces.probability(),
               bandOf(faces.probability(), faces.square + faces.other));
    }
  }
  return data.str();
}

}  // namespace

std::vector<DicePlot> dicePlots(const std::vector<DiceResult>& results) {
  std::vector<DicePlot> plots;
  if (results.empty()) {
    return plots;
  }
  const DiceResult& first = results.front();
  const std::string title = "Cuboid dice, " + brief(first.settings.throws) + " throws of each";
  for (const Quantity& quantity : kQuantities) {
    const auto labelOf = [&](const DiceResult& result) {
      return std::string(quantity.name) + " " + brief(result.settings.*quantity.value) + quantity.unit;
    };
    std::vector<const DiceResult*> shown = {&first};
    std::vector<std::string> texts = {title, "measured", labelOf(first)};
    for (const DiceResult& result : results) {
      if (result.settings.*quantity.value != first.settings.*quantity.value) {
        shown.push_back(&result);
        texts.push_back(labelOf(result));
      }
    }
    if (shown.size() > 1) {
      plots.push_back({quantity.name, {.script = "dice.gp", .texts = texts, .data = dataOf(shown)}});
    }
  }
  if (plots.empty()) {
    plots.push_back(
        {"usual", {.script = "dice.gp", .texts = {title, "measured", "thrown"}, .data = dataOf({&first})}});
  }
  return plots;
}

}  // namespace careen
