#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "support/oracle_runs.h"
#include "support/quad_scene.h"

namespace careen::study {

/// How the truth of one hard case is computed.
struct TruthCase {
  using Boxes = std::vector<oracle::QuadPoses>;  // of the movable boxes, in the scene's order
  using Oracle = std::function<Boxes(const oracle::QuadScene&, std::span<const double>)>;

  std::string name;
  std::string title;
  std::string whyHard;
  std::string source;
  std::string measure = "poses";
  std::string published = {};  // by whom, of a scene that others published with its answer
  int samples = 8;
  Oracle oracle = {};
};

/// The cases with persistent contact: sliding, rocking, tipping or standing boxes.
std::vector<TruthCase> contactCases();
/// The cases with joints.
std::vector<TruthCase> jointCases();
/// The scenes that others published with their answers.
std::vector<TruthCase> publishedCases();

}  // namespace careen::study
