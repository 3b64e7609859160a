#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "study/case.h"
#include "study/contestant.h"

namespace careen {

/// How wrong a contestant's answer to a case is.
struct Judgement {
  double error = 0;  ///< [1] poses: largest over all moments and boxes of distance / half diagonal and angle
                     ///< [rad]; overlap: the deepest of all moments / half diagonal; energy: largest change
                     ///< of energy relative to the kinetic energy at the start
  std::vector<double> energy;  ///< [1] that change of energy at every moment of the case; empty where impacts
                               ///< may take energy out
};

/// States at every moment asked for: [moment][body].
using States = std::vector<std::vector<BodyState>>;

/// What a contestant is asked: one run, or the two that reversal and scaling take. This is what is timed.
struct Answer {
  States states;
  States second;  ///< the way back, or the original of a scaled copy
};
Answer answerOf(const Case& study, const Contestant& contestant, double fineness,
                const std::stop_token& stop);
/// The scene's own dt or tolerance, whichever the contestant is asked for.
double usualFineness(const Case& study, const Contestant& contestant);
Judgement judge(const Case& study, const Answer& answer);

/// One way to run a case: a contestant at a step or a tolerance, and what came of it.
struct Attempt {
  std::string contestant;
  std::string settings;
  double dt = 0;         ///< [s] 0: it takes no steps
  double tolerance = 0;  ///< [m] 0: it takes steps, or nothing in its answer depends on a tolerance
  std::string failure;   ///< why there is no answer; empty if there is one
  Judgement judgement;
  double cost = 0;    ///< [µs] of one core per simulated second; 0: not timed
  double spread = 0;  ///< [1] how much longer the median of the repeats took than the shortest
  int repeats = 0;
};

/// How much is asked of a machine.
struct Effort {
  double longestRun = 0;   ///< [s] a run that takes longer is given up, and so are shorter steps; who takes
                           ///< no steps has four times as long, for one run
  double longestStep = 0;  ///< [s] no further halvings of the step once a run takes longer
  double timing = 0;       ///< [s] for all timings of one case, at least two rounds
  int rounds = 7;          ///< of timings
  double shortest = 2e-3;  ///< [s] a timing repeats its run until it has taken so long
  std::vector<double> steps;  ///< in units of the scene's own
  std::vector<double> tolerances = {
      1};  ///< in units of the scene's own, for who takes no steps; the first is 1
};
Effort fullEffort();
Effort quickEffort();

/// Every contestant at every step or tolerance: first all errors, then all timings in rotating order. A
/// tolerance that changes no bit of the answer is left out, and so are those after it.
std::vector<Attempt> attemptAll(const Case& study, const Contestants& contestants, const Effort& effort,
                                const std::stop_token& stop);

/// Keeps the calling thread on one core while it lives, so that timings do not hop.
class Pinned {
 public:
  Pinned();
  ~Pinned();
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;
  Pinned(Pinned&&) = delete;
  Pinned& operator=(Pinned&&) = delete;

 private:
  std::vector<int> before_;  // cores it may use again
};

}  // namespace careen
