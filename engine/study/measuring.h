#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "study/case.h"
#include "study/contestant.h"

namespace careen {

/// The error of a contestant's answer to a case.
struct Judgement {
  double error = 0;  ///< [1] poses: largest over all times and boxes of distance / half diagonal and angle
                     ///< [rad]; overlap: deepest penetration of all times / half diagonal; energy: largest
                     ///< change of energy relative to the initial kinetic energy; of bodies that
                     ///< start at rest, to that of a fall by their half diagonals
  std::vector<double> energy = {};  ///< [1] the change of energy at every time of the case; empty if impacts
                                    ///< may dissipate energy
  /// [m] What a tolerance promises to bound: the largest distance of a point of a box from its truth; none
  /// where the case measures energy, or overlap, that of crowds, which have a tolerance of their own.
  std::optional<double> displacement = {};
  /// [m] How far any joint is open at any time of the case; none without joints.
  std::optional<double> jointGap = {};
};

/// States at every time of the case: [time][body].
using States = std::vector<std::vector<BodyState>>;

/// The runs of an answer: one, or two for reversal and scaling. All of them are timed.
struct Answer {
  States states;
  States second;  ///< the way back, or the original of a scaled copy
};
Answer answerOf(const Case& study, const Contestant& contestant, double fineness,
                const std::stop_token& stop);
/// The scene's own dt or tolerance, depending on the contestant.
double usualFineness(const Case& study, const Contestant& contestant);
Judgement judge(const Case& study, const Answer& answer);

/// One way to run a case: a contestant with a time step or a tolerance, and its result.
struct Attempt {
  std::string contestant;
  std::string settings;
  double dt = 0;         ///< [s] 0: no fixed time step
  double tolerance = 0;  ///< [m] 0: a fixed time step, or the answer depends on no tolerance
  double sameTo = 0;     ///< [m] the answer is the same, bit for bit, down to this tolerance
  std::string failure;   ///< why there is no answer; empty if there is one
  Judgement judgement;
  std::string audit;  ///< what the audit found, in words; empty if it could not look
  double cost = 0;    ///< [µs] of one core per simulated second; 0: not timed, or unknown
  double spread = 0;  ///< [1] relative excess of the median of the repeats over the shortest
  int repeats = 0;
};

/// Limits of the computing time, that of cores where one run is meant.
struct Effort {
  double longestRun = 0;      ///< [s] a run that takes longer is aborted, and shorter steps are skipped;
                              ///< contestants without a fixed time step get four times as long, for one run
  double longestStep = 0;     ///< [s] the time step is not halved further once a run takes longer
  double timing = 0;          ///< [s] for all timings of one case, at least two rounds
  int rounds = 7;             ///< of timings
  double shortest = 2e-3;     ///< [s] a timing repeats its run until it has taken this long
  std::vector<double> steps;  ///< in units of the scene's own dt
  std::vector<double> tolerances = {1};  ///< in units of the scene's own, for contestants without a fixed
                                         ///< time step; descending, 1 among them
};
Effort fullEffort();
Effort quickEffort();

/// Runs every contestant with every time step or tolerance: first all errors, then all timings in rotating
/// order. It skips a tolerance that changes no bit of the answer to the one before.
std::vector<Attempt> attemptAll(const Case& study, const Contestants& contestants, const Effort& effort,
                                const std::stop_token& stop);

/// Pins the calling thread to one core during its lifetime, so that timings are not disturbed by migration.
class Pinned {
 public:
  Pinned();
  ~Pinned();
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;
  Pinned(Pinned&&) = delete;
  Pinned& operator=(Pinned&&) = delete;

 private:
  std::vector<int> before_;  // cores it may use afterwards
};

}  // namespace careen
