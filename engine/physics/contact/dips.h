#pragma once

#include <functional>

namespace careen {

// Functions that fall below zero within a step and are above it at the step's end.

/// Time of the minimum of the cubic with these values and rates at both ends of a step of `h` [s], if the
/// minimum is below zero; else 0.
double lowestOfCubic(double h, double valueFrom, double rateFrom, double valueTo, double rateTo);

/// A gap [m] by the time within a step.
using GapAt = std::function<double(double)>;

/// Where a function with one minimum between two times is lowest, to 1/300 of the way.
double lowestBetween(double from, double to, const GapAt& valueAt);

/// The first of a few sampled times within a step of `h` [s] at which a gap is deeper than the tolerance [m],
/// or than it was at the start: no step, however short, would be without that. Around a lowest sample it is
/// searched more closely: an edge that passes below an edge may do so between two of them. 0 if there is
/// none.
double deepMoment(const GapAt& gapAt, double h, double tolerance);

}  // namespace careen
