#pragma once

#include <string>
#include <vector>

#include "study/dice.h"
#include "study/plots.h"

namespace careen {

/// A plot and what it is of, as its file is named: "restitution", "friction", "height", "speed" or "spin".
struct DicePlot {
  std::string of;
  Plot plot;
};

/// For each quantity of the throw that takes several values in the results: part of the throws with a square
/// face up over x/y, measured and with each of these values. If none does, one plot of the first, "usual".
/// Bands as bandOf().
std::vector<DicePlot> dicePlots(const std::vector<DiceResult>& results);

}  // namespace careen
