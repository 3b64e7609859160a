#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace careen {

/// What gnuplot draws: a script of assets/plots, its texts.txt and its data.txt.
struct Plot {
  const char* script;
  std::vector<std::string> texts;
  std::string data;
};

/// Draws a plot as `out`.png and `out`.svg and returns the latter. MachineError if gnuplot fails.
std::string drawPlot(const Plot& plot, const std::filesystem::path& out);

}  // namespace careen
