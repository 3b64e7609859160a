#pragma once

#include "image/deep_picture.h"
#include "image/picture.h"

namespace careen {

/// By what to multiply a difference of two pictures of one size so that it can be seen: the largest power of
/// two, at least 1, at which no more than a hundredth of the pixels that differ are cut off at full.
int amplificationOf(const DeepPicture& expected, const DeepPicture& actual);

/// The absolute difference of red, green and blue, times `factor`, cut off at full: black where both are the
/// same. A difference of alpha is added to all three. InputError, naming both sizes, if they are not of one.
Picture differenceImage(const DeepPicture& expected, const DeepPicture& actual, int factor);

}  // namespace careen
