#pragma once

#include <stop_token>

#include "physics/motion/recorder.h"
#include "physics/world/method.h"
#include "physics/world/world.h"

namespace careen {

/// Moves the world by one of freeMethods(): every body turns in steps of dt, its centre of mass runs along
/// the parabola. Where a corner is behind a wall at the end of a step, the moment of contact is the root of
/// the gap over that step, cut short; the impact is that of method exact. So what such a method is wrong by
/// is its turning, and the contacts that begin and end within a step, which it does not see. Boxes do not
/// meet, and nothing rests: bounces that die out end in NumericalError.
RunFigures runStepped(const World& world, const RunSettings& settings, Recorder& recorder,
                      const std::stop_token& stop);

}  // namespace careen
