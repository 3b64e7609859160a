#pragma once

#include <vector>

#include "image/deep_picture.h"

namespace careen {

/// [px/°] Seen from 0.7 m on a display of 3840 px and 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67.0206432765823;

struct Flip {
  double mean = 0;            ///< [1] 0: none sees a difference, 1: the largest
  double largest = 0;         ///< [1]
  std::vector<float> values;  ///< [1] of every pixel, rows from the top
};

/// How different two pictures of one size look to one who flips between them: P. Andersson, J. Nilsson,
/// T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "ꟻLIP: A Difference Evaluator for Alternating
/// Images", Proc. ACM Comput. Graph. Interact. Tech. 3 (HPG 2020), for low dynamic range, with the constants
/// of the paper. Beyond the border the nearest pixel goes on. Alpha shows middle grey, as in differenceOf().
/// InputError if they are not of one size.
Flip flipOf(const DeepPicture& expected, const DeepPicture& actual,
            double pixelsPerDegree = kPixelsPerDegree);

}  // namespace careen
