#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "support/oracle_runs.h"
#include "support/quad_scene.h"

namespace careen::study {

/// One movable box of a case: its poses at the times of the case, rounded from quadruple precision.
struct TruthBox {
  std::string name;
  std::vector<std::array<double, 3>> positions;     // [m]
  std::vector<std::array<double, 4>> orientations;  // w x y z, first nonzero component positive
};

/// The content of a file in assets/truths.
struct Truth {
  std::string name;
  std::string title;
  std::string whyHard;
  std::string source;
  std::string measure;             // poses, energy, reversal or scaled
  std::string published = {};      // by whom; empty if by nobody
  std::vector<double> times = {};  // [s]
  std::vector<TruthBox> boxes = {};
  std::string of = {};  // scaled: the other case
  double lengths = 1;   // scaled: the factors
  double timesBy = 1;
};

std::vector<std::string> truthNames();
std::filesystem::path scenePath(const std::string& name);
std::filesystem::path truthPath(const std::string& name);
/// The times at which a case is evaluated: k · duration / n.
std::vector<double> timesOf(const std::string& name, const oracle::QuadScene& scene);

/// Computed from the case's scene file by the oracles, without any code of the engine; at most so many of its
/// times, the first.
Truth computeTruth(const std::string& name, std::size_t mostTimes = 1000);
/// The text of its file.
std::string toText(const Truth& truth);

}  // namespace careen::study
