#pragma once

#include <string>

#include "study/results.h"

namespace careen {

inline Attempt answered(const std::string& contestant, double dt, double error, double cost) {
  Attempt attempt;
  attempt.contestant = contestant;
  attempt.settings = "as it is";
  attempt.dt = dt;
  attempt.judgement = {.error = error, .energy = {error, -error}};
  attempt.cost = cost;
  attempt.spread = 0.1;
  attempt.repeats = 3;
  return attempt;
}

inline Attempt failed(const std::string& contestant, double dt) {
  Attempt attempt;
  attempt.contestant = contestant;
  attempt.dt = dt;
  attempt.failure = "fell over, \"quietly\"\nand lay there";
  return attempt;
}

/// Three contestants, of which one steps at two steps and one has no answer.
inline CaseResult someCase() {
  CaseResult result;
  result.name = "tumble";
  result.title = "A <tumble> & more";
  result.whyHard = "it tumbles";
  result.source = "closed form: none";
  result.measure = "energy";
  result.stamp = "0123456789abcdef";
  result.usualStep = 0.1;
  result.usualTolerance = 1e-6;
  result.times = {1, 2};
  result.attempts = {answered("exact", 0, 1e-15, 0.1), answered("strang", 0.2, 1e-2, 0.2),
                     answered("strang", 0.1, 1. / 300, 0.4), failed("ode", 0.1)};
  result.attempts[0].tolerance = 1e-6;
  return result;
}

}  // namespace careen
