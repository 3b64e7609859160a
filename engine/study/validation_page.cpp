#include "study/validation_page.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "core/brief.h"
#include "core/characters.h"
#include "core/math/to_integer.h"
#include "core/table.h"
#include "study/plot_files.h"
#include "study/plots.h"
#include "study/study.h"

namespace careen {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

std::string percent(double part) { return brief(100 * part, 3) + " %"; }
std::string degrees(double angle) { return brief(kDegrees * angle, 3) + "°"; }

std::size_t facesRight(const Validation& validation) {
  return static_cast<std::size_t>(
      std::count_if(validation.tosses.begin(), validation.tosses.end(),
                    [](const Toss& toss) { return toss.measuredFace == toss.simulatedFace; }));
}

const char* nameOf(Parameter parameter) {
  return kParameterNames.at(static_cast<std::size_t>(parameter)).data();
}

// The mean of all tosses at moments a hundredth of a second apart, as long as half of them last.
std::string meanOverTime(const Validation& validation) {
  constexpr double kStep = 0.01;  // [s]
  std::map<int, std::pair<double, int>> sums;
  for (const Toss& toss : validation.tosses) {
    std::map<int, std::pair<double, int>> own;
    for (std::size_t k = 0; k < toss.times.size(); ++k) {
      auto& [sum, count] = own[toInteger<int>(toss.times[k] / kStep, 0)];
      sum += toss.place[k];
      ++count;
    }
    for (const auto& [moment, each] : own) {
      auto& [sum, count] = sums[moment];
      sum += each.first / each.second;
      ++count;
    }
  }
  std::string data;
  for (const auto& [moment, each] : sums) {
    if (2 * each.second >= static_cast<int>(validation.tosses.size())) {
      data += "0\t" + brief(moment * kStep, 6) + "\t" +
              brief(100 * each.first / each.second / validation.size, 6) + "\n";
    }
  }
  return data;
}

Plot errorsPlot(const Validation& validation) {
  Plot plot{.script = "validation.gp",
            .texts = {"Place: measured against simulated", "error of place [% of the size]"},
            .data = meanOverTime(validation)};
  std::size_t number = 0;
  for (const Toss& toss : validation.tosses) {
    ++number;
    for (std::size_t k = 0; k < toss.times.size(); ++k) {
      plot.data += std::to_string(number) + "\t" + inFull(toss.times[k]) + "\t" +
                   brief(100 * toss.place[k] / validation.size, 6) + "\n";
    }
  }
  return plot;
}

// The error at a value, between the points of a sweep.
double errorAt(const std::vector<SweepPoint>& sweep, double value) {
  const auto after = std::find_if(sweep.begin(), sweep.end(),
                                  [value](const SweepPoint& point) { return point.value >= value; });
  if (after == sweep.begin() || after == sweep.end()) {
    return after == sweep.end() ? sweep.back().place : after->place;
  }
  const auto before = std::prev(after);
  return before->place +
         (after->place - before->place) * (value - before->value) / (after->value - before->value);
}

Plot sweepPlot(const Validation& validation) {
  Plot plot{.script = "sweep.gp",
            .texts = {std::string("Error against ") + nameOf(*validation.swept), nameOf(*validation.swept),
                      "mean error of place [% of the size]"},
            .data = {}};
  for (const SweepPoint& point : validation.sweep) {
    plot.data += "0\t" + inFull(point.value) + "\t" + brief(100 * point.place / validation.size, 6) + "\n";
  }
  if (validation.sceneValue) {
    plot.data += "1\t" + inFull(*validation.sceneValue) + "\t" +
                 brief(100 * errorAt(validation.sweep, *validation.sceneValue) / validation.size, 6) + "\n";
  }
  return plot;
}

std::string tossTable(const Validation& validation) {
  Table table{.head = {"toss", "rows", "fitted", "impacts", "place, mean", "largest", "attitude, mean",
                       "largest", "floor", "face measured", "simulated"}};
  for (const Toss& toss : validation.tosses) {
    table.rows.push_back({toss.name, std::to_string(toss.times.size()), std::to_string(toss.fitted),
                          std::to_string(toss.impacts), percent(toss.meanPlace / validation.size),
                          percent(toss.largestPlace / validation.size), degrees(toss.meanAttitude),
                          degrees(toss.largestAttitude), percent(toss.floorPlace / validation.size),
                          toss.measuredFace, toss.simulatedFace});
  }
  return table.html();
}

}  // namespace

std::vector<std::string> summaryOf(const Validation& validation) {
  const auto both = [&](double Toss::*figure, double unit, const char* name) {
    const Spread spread = spreadOf(validation.tosses, figure);
    return brief(spread.mean * unit, 3) + " ± " + brief(spread.deviation * unit, 3) + name;
  };
  const double size = validation.size;
  std::vector<std::string> lines = {
      "place        mean " + both(&Toss::meanPlace, 100 / size, " %") + " of the size, " + brief(size, 4) +
          " m; largest " + both(&Toss::largestPlace, 100 / size, " %"),
      "attitude     mean " + both(&Toss::meanAttitude, kDegrees, "°") + "; largest " +
          both(&Toss::largestAttitude, kDegrees, "°"),
      "floor        " + both(&Toss::floorPlace, 100 / size, " %") + ", " +
          both(&Toss::floorAttitude, kDegrees, "°") + ": what the noise of the start makes",
      "noise        " + both(&Toss::positionNoise, 1e6, " µm") + ", " +
          both(&Toss::attitudeNoise, 1e3, " mrad") + " of the rows in flight",
      "faces        " + std::to_string(facesRight(validation)) + " of " +
          std::to_string(validation.tosses.size()) + " right"};
  if (validation.swept && !validation.sweep.empty()) {
    const SweepPoint& least = leastOf(validation.sweep);
    lines.push_back(std::string("sweep        the least error of place, ") + percent(least.place / size) +
                    ", is at " + nameOf(*validation.swept) + " " + brief(least.value, 3) +
                    "; the parabola there has its minimum at " + brief(minimumOf(validation.sweep), 3) +
                    (validation.sceneValue
                         ? "; the scene's " + brief(*validation.sceneValue, 3) + " has " +
                               percent(errorAt(validation.sweep, *validation.sceneValue) / size)
                         : ""));
  }
  return lines;
}

std::string validationJson(const Validation& validation) {
  using Json = nlohmann::ordered_json;
  Json tosses = Json::array();
  for (const Toss& toss : validation.tosses) {
    tosses.push_back({{"toss", toss.name},
                      {"rows", toss.times.size()},
                      {"fitted", toss.fitted},
                      {"impacts", toss.impacts},
                      {"mean_place", toss.meanPlace},
                      {"largest_place", toss.largestPlace},
                      {"mean_attitude", toss.meanAttitude},
                      {"largest_attitude", toss.largestAttitude},
                      {"floor_place", toss.floorPlace},
                      {"floor_attitude", toss.floorAttitude},
                      {"position_noise", toss.positionNoise},
                      {"attitude_noise", toss.attitudeNoise},
                      {"measured_face", toss.measuredFace},
                      {"simulated_face", toss.simulatedFace},
                      {"seconds", toss.seconds}});
  }
  const auto spread = [&](double Toss::*figure) -> Json {
    const Spread found = spreadOf(validation.tosses, figure);
    return {{"mean", found.mean}, {"deviation", found.deviation}};
  };
  Json report = {{"program", validation.program},
                 {"scene", validation.scene},
                 {"size", validation.size},
                 {"place", spread(&Toss::meanPlace)},
                 {"attitude", spread(&Toss::meanAttitude)},
                 {"floor_place", spread(&Toss::floorPlace)},
                 {"faces_right", facesRight(validation)},
                 {"tosses", tosses}};
  if (validation.swept) {
    Json points = Json::array();
    for (const SweepPoint& point : validation.sweep) {
      points.push_back({{"value", point.value}, {"place", point.place}, {"attitude", point.attitude}});
    }
    report["sweep"] = {{"parameter", nameOf(*validation.swept)},
                       {"minimum", minimumOf(validation.sweep)},
                       {"points", points}};
    if (validation.sceneValue) {
      report["sweep"]["scene"] = *validation.sceneValue;
    }
  }
  return report.dump(2) + "\n";
}

std::vector<std::string> drawValidation(const Validation& validation, const std::filesystem::path& folder) {
  makeFolder(folder);
  std::vector<std::string> plots = {drawPlot(errorsPlot(validation), folder / "errors")};
  if (validation.swept) {
    plots.push_back(drawPlot(sweepPlot(validation), folder / "sweep"));
  }
  return plots;
}

std::string validationPage(const Validation& validation, const std::vector<std::string>& plots) {
  std::string page = plotFile("validation.html");
  std::string summary;
  for (const std::string& line : summaryOf(validation)) {
    summary += escapedForMarkup(line) + "<br>\n";
  }
  std::string drawn;
  for (const std::string& plot : plots) {
    drawn += plot.substr(std::min(plot.find("<svg"), plot.size())) + "\n";
  }
  summary += "made by      " + escapedForMarkup(validation.program) + "<br>\n";
  for (const auto& [mark, text] : {std::pair<std::string, std::string>{"{{summary}}", summary},
                                   {"{{plots}}", drawn},
                                   {"{{tosses}}", tossTable(validation)}}) {
    if (const std::size_t at = page.find(mark); at != std::string::npos) {
      page.replace(at, mark.size(), text);
    }
  }
  return page;
}

}  // namespace careen
