#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

#include "physics/exact/bodies.h"
#include "physics/exact/changing_world.h"
#include "physics/exact/encounter.h"
#include "physics/exact/event_queue.h"
#include "physics/motion/recorder.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// Method `exact`. Every body is in one of three motions: Flight in closed form from impact to impact,
/// Contact in steps chosen by the tolerance, or Rest. Between events nothing is computed, and an event
/// affects only the bodies involved in it.
///
/// Bodies in contact are an Island, exact to the tolerance. Where that costs too much, or its equations are
/// not solved, they go on as a Crowd, which takes in what it meets and releases what nothing touches; the
/// others do not notice. RunFigures reports it.
class ExactWorld {
 public:
  ExactWorld(const World& world, const RunSettings& settings, Recorder& recorder);
  RunFigures run(const std::stop_token& stop);

 private:
  void begin();
  void happen(const Event& event);
  void changeJoints(double until);
  void jump(const Instant& time);
  void meet(const Event& event);
  void moveOn(Encounter& encounter);
  void end(const Instant& time);

  bool goesOnAsCrowd(const Encounter& encounter) const;
  bool costsTooMuch(const Encounter& encounter) const;

  std::optional<ChangingWorld> changing_;  // of worlds with joints, or in which something jumps
  Bodies bodies_;
  std::vector<std::size_t> articulationOf_;  // by body of the world; empty: there are no joints
};

}  // namespace careen
