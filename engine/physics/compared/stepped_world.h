#pragma once

#include <stop_token>

#include "physics/motion/recorder.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// Simulates the world by one of freeMethods(): each body rotates in steps of dt, its centre of mass follows
/// the parabola. Where a corner is behind a wall at the end of a step, the time of impact is the root of the
/// gap over that shortened step; the impact is that of method exact. The error of such a method is thus that
/// of its rotation, plus contacts that begin and end within a step, which it misses. No box–box contact and
/// no resting contact: bounces that die out end in NumericalError.
RunFigures runStepped(const World& world, const RunSettings& settings, Recorder& recorder,
                      const std::stop_token& stop);

}  // namespace careen
