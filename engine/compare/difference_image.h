#pragma once

#include "image/deep_picture.h"
#include "image/picture.h"

namespace careen {

/// The factor that makes a difference of two pictures of one size visible: the largest power of two, at least
/// 1, at which at most a hundredth of the differing pixels are clipped.
int amplificationOf(const DeepPicture& expected, const DeepPicture& actual);

/// The absolute difference of red, green and blue, times `factor`, clipped: black where both are the same. A
/// difference of alpha is added to all three. InputError, naming both sizes, if they differ.
Picture differenceImage(const DeepPicture& expected, const DeepPicture& actual, int factor);

}  // namespace careen
