#pragma once

#include "image/picture.h"

namespace careen {

/// A bar below the picture, not covering it, that shows the position in the film.
inline constexpr int kScrubBarHeight = 16;  ///< [px]

/// `part`: position in the film, 0 … 1.
Picture withScrubBar(const Picture& picture, double part);

/// The position in the film, 0 … 1, for `x` on the bar [px]; `width` of the picture [px].
double partOnScrubBar(double x, int width);

}  // namespace careen
