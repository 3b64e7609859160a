#pragma once

#include "image/picture.h"

namespace careen {

/// A bar below a film's picture that shows where in the film it is: of the picture itself it hides nothing.
inline constexpr int kScrubBarHeight = 16;  ///< [px]

/// `part` of the film is over, 0 … 1.
Picture withScrubBar(const Picture& picture, double part);

/// The part of the film that a place on the bar [px] of a picture so wide [px] stands for, 0 … 1.
double partOnScrubBar(double x, int width);

}  // namespace careen
