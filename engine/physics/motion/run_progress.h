#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/system/clock.h"
#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// How far a run has come.
struct RunMark {
  double wallSeconds = 0;     ///< [s] since it began
  double time = 0;            ///< [s] simulated
  std::uint64_t records = 0;  ///< pieces of motion and impacts
};

/// What is to come of a run if it goes on as of late: as in its last half, about, for a run is quick while
/// boxes fly and slow while they touch.
class RunForecast {
 public:
  void add(const RunMark& mark);
  /// [s] of wall time until that much is simulated; none before anything is known.
  std::optional<double> secondsUntil(double time) const;
  /// How many there will be then.
  double recordsAt(double time) const;
  /// [s] simulated when there will be so many; infinity if never.
  double timeOf(double records) const;
  /// Whether there will be more than `most` until that time, by half of the rate of late too. Not known
  /// before there is a tenth of them: many a run is busy only at first.
  bool exceeds(std::uint64_t most, double time) const;

 private:
  double perSimulated(double amount) const;

  RunMark from_;
  RunMark middle_;
  RunMark now_;
};

/// What is told of a run while it goes on.
struct RunProgress {
  RunMark now;
  double duration = 0;  ///< [s] to simulate
  std::uint64_t impacts = 0;
  std::uint64_t flying = 0;  ///< boxes that can move, by what they are doing
  std::uint64_t touching = 0;
  std::uint64_t resting = 0;
  RunForecast forecast;
  bool isOver = false;
};
using RunCallback = std::function<void(const RunProgress&)>;

/// Hands on what is recorded, and tells how far the run has come, every tenth of a second and at its end.
class ProgressRecorder : public Recorder {
 public:
  /// All must outlive this object.
  ProgressRecorder(const World& world, double duration, Recorder& next, const RunCallback& tell);

  void moves(BodyIndex body, double time, const Motion& motion) override;
  void strikes(const Impact& impact) override;
  void passes(const JointImpulse& impulse) override { next_.passes(impulse); }
  void drives(const JointEffort& effort) override { next_.drives(effort); }
  void reaches(double time) override;
  bool hasEnough() const override { return next_.hasEnough(); }
  void finish();

 private:
  void look(double time);

  Recorder& next_;
  const RunCallback& tell_;
  RunProgress progress_;
  std::vector<char> fixed_;
  std::vector<std::uint64_t RunProgress::*> countedIn_;  // null: nowhere
  Clock::time_point begun_ = Clock::now();
  double lookedAt_ = 0;  // [s]
  double toldAt_ = 0;    // [s]
  int calls_ = 0;        // of reaches() since the last look
  int callsOfLook_ = 1;
};

}  // namespace careen
